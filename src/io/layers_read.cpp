// Reads EXR files with all of their layers, through OpenImageIO (io/image_codecs.h).
#include "io/image_codecs.h"
#include "io/image_limits.h"
#include "io/image_write.h"

namespace etd {
namespace {

// Returns why no layers can be read there, or an empty string.
std::string problem_of(const std::filesystem::path& path) {
  if (!is_layered_path(path)) return "layers are read from .exr files only";
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return "the file does not exist";
  if (std::string error = image_header_problem(path, {}); !error.empty()) return error;
  return {};
}

// Returns what `read` gives, or a result with the error.
template <class F>
auto read_exr(const std::filesystem::path& path, F&& read) -> decltype(read(image_codecs())) {
  decltype(read(image_codecs())) failed;
  failed.error = problem_of(path);
  if (!failed.error.empty()) return failed;
  try {
    return read(image_codecs());
  } catch (const std::exception& error) {
    failed.error = error.what();
    return failed;
  }
}

}  // namespace

bool ImagePart::covers_same_pixels(const ImageHeader& other) const {
  return width == other.width && height == other.height && x == other.x && y == other.y &&
         full_width == other.full_width && full_height == other.full_height;
}

PartsResult read_parts(const std::filesystem::path& path) {
  return read_exr(path, [&](const ImageCodecs& codecs) { return codecs.read_parts(path); });
}

LayersResult read_layers(const std::filesystem::path& path, size_t part, bool with_others) {
  return read_exr(path, [&](const ImageCodecs& codecs) { return codecs.read_layers(path, part, with_others); });
}

}  // namespace etd
