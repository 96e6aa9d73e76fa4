#include "render/memory.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <new>
#include <string>

#include "core/freed_memory.h"
#include "render/output.h"
#include "render/session.h"
#include "render/workers.h"
#include "scene/scene.h"

namespace etd {
namespace {

// A row of /proc/self/status, which tells of this program alone: getrusage() remembers what the one before it held that
// became this one.
uint64_t status_bytes(const std::string& wanted) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (uint64_t kib = 0; word == wanted && status >> kib) return kib * 1024;
  return 0;
}

constexpr size_t kMiB = size_t{1} << 20;

// The rows that are encoded together.
size_t strip_bytes(const ImageHeader& image) {
  constexpr size_t kRows = 16;
  return kRows * static_cast<size_t>(image.width) * image.channels.size() * sizeof(float);
}

}  // namespace

uint64_t memory_bytes() { return status_bytes("VmRSS:"); }

uint64_t peak_memory_bytes() { return status_bytes("VmHWM:"); }

size_t writing_bytes(const ImageHeader& image) {
  constexpr size_t kCopies = 5;  // as floats, as what is stored, and in the encoder while it compresses them
  return kCopies * strip_bytes(image) + 16 * kMiB;
}

MemoryForecast forecast_memory(const PreparedRender& prepared) {
  const FilmSettings& film = prepared.settings.film;
  MemoryForecast forecast;
  forecast.film = Film::bytes_for(film);
  forecast.integrator = prepared.integrator->bytes();
  if (prepared.compiled.scene->textures.cache) {
    const size_t most = prepared.compiled.scene->textures.cache_limit,
                 now = prepared.compiled.scene->textures.image_bytes();
    forecast.textures = most - std::min(most, now);
  }
  // Measured: copies of the rows that are there at once, the code of the encoders, a thread's stack and what its
  // allocator keeps.
  constexpr size_t kCopies = 3, kEncoders = 9 * kMiB, kOfThread = kMiB / 2;
  forecast.writing = kCopies * strip_bytes(layers_header(film, false)) + kEncoders;
  const size_t threads = static_cast<size_t>(thread_count(prepared.settings.driver.threads));
  return_freed_memory();
  const size_t added = forecast.film + forecast.integrator + forecast.textures + forecast.writing + threads * kOfThread;
  forecast.peak = std::max<size_t>(peak_memory_bytes(), memory_bytes() + added);
  return forecast;
}

AddressReserve::AddressReserve(size_t bytes)
    : address_(::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0)),
      bytes_(bytes) {
  if (address_ == MAP_FAILED) throw std::bad_alloc();
}

AddressReserve::~AddressReserve() { ::munmap(address_, bytes_); }

}  // namespace etd
