// How fast files are read, and nothing else done with them: MB per processor second for each file that is named, the
// most of three times.
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <filesystem>

#include "formats/pbrt/reader.h"
#include "io/mesh.h"

namespace {

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Returns the processor seconds that one reading took, and 0 where the file cannot be read.
double read_once(const std::filesystem::path& file) {
  const double start = processor_seconds();
  if (file.extension() == ".pbrt") {
    etd::Diagnostics diagnostics;
    const etd::SceneDescription scene = etd::read_pbrt(file, diagnostics);
    if (diagnostics.has_errors()) return 0;
    return processor_seconds() - start;
  }
  const etd::MeshResult result = etd::read_ply(file);
  return result.mesh ? processor_seconds() - start : 0;
}

}  // namespace

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    double seconds = read_once(argv[i]);
    for (int k = 1; k < 3; ++k) seconds = std::min(seconds, read_once(argv[i]));
    if (seconds <= 0) return fmt::print(stderr, "{}: cannot be read\n", argv[i]), 2;
    const double megabytes = 1e-6 * static_cast<double>(std::filesystem::file_size(argv[i]));
    fmt::print("{:7.1f} MB {:7.1f} MB/s  {}\n", megabytes, megabytes / seconds, argv[i]);
  }
  return 0;
}
