// What a render takes of memory: measured of the process as it is, and foreseen of what it will do.
#pragma once

#include <cstddef>
#include <cstdint>

namespace etd {

struct PreparedRender;
struct ImageHeader;

// What the process holds in memory now, and the most it has held so far, in bytes; 0 where the system does not tell.
uint64_t memory_bytes();
uint64_t peak_memory_bytes();

// Forecasts the memory of a render that has been prepared and not begun, in bytes.
struct MemoryForecast {
  size_t film = 0;
  size_t integrator = 0;  // such as photons
  size_t textures = 0;    // that the cache of textures may yet load
  size_t writing = 0;     // of a few rows of the image, encoded
  size_t peak = 0;        // the most that the process will have held, with all that it holds now
};
MemoryForecast forecast_memory(const PreparedRender& prepared);

// Room for the rows of such an image while it is encoded, and for what else happens then.
size_t writing_bytes(const ImageHeader& image);

// Keeps addresses for later: where memory is limited (`ulimit -v`), what is needed at the end can then be had. Throws
// std::bad_alloc when there is no room.
class AddressReserve {
 public:
  explicit AddressReserve(size_t bytes);
  ~AddressReserve();
  AddressReserve(const AddressReserve&) = delete;
  AddressReserve& operator=(const AddressReserve&) = delete;

 private:
  void* address_;
  size_t bytes_;
};

}  // namespace etd
