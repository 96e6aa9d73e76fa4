// Reads image files: formats that are simple here, all others through OpenImageIO (io/image_codecs.h).
#include <fstream>
#include <new>

#include "io/file.h"
#include "io/image.h"
#include "io/image_codecs.h"
#include "io/image_limits.h"
#include "io/pfm.h"
#include "io/radiance.h"

namespace etd {
namespace {

ImageResult fail(std::string error) { return {std::nullopt, std::move(error), {}, {}, false}; }

std::string first_bytes(const std::filesystem::path& path, size_t count) {
  std::string bytes(count, '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(bytes.data(), static_cast<std::streamsize>(count));
  bytes.resize(static_cast<size_t>(in.gcount()));
  return bytes;
}

bool is_pfm(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  for (char& c : ending) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return ending == ".pfm";
}

}  // namespace

ImageResult read_image(const std::filesystem::path& path, const ImageOptions& options) {
  std::error_code failed;
  const std::filesystem::file_status status = std::filesystem::status(path, failed);
  if (!std::filesystem::exists(status)) return fail("the file does not exist");
  if (!std::filesystem::is_regular_file(status)) return fail("not a regular file");
  try {
    if (is_pfm(path) || is_radiance(first_bytes(path, 2))) {
      const FileBytes file = read_file(path);
      if (!file.error.empty()) return fail(file.error);
      return is_pfm(path) ? decode_pfm(file.bytes) : decode_radiance(file.bytes, options.limits);
    }
    if (std::string error = image_header_problem(path, options.limits); !error.empty()) return fail(error);
    return image_codecs().read_image(path, options);
  } catch (const std::bad_alloc&) {
    return fail("there is not enough memory for it");
  } catch (const std::exception& error) {
    return fail(error.what());
  }
}

size_t image_bytes(const std::filesystem::path& path, const ImageOptions& options) {
  std::error_code failed;
  if (!std::filesystem::is_regular_file(path, failed)) return 0;
  if (is_pfm(path)) {
    const auto size = std::filesystem::file_size(path, failed);
    return failed ? 0 : static_cast<size_t>(size);
  }
  try {
    constexpr size_t kLongestHeader = 1 << 16;
    if (const std::string start = first_bytes(path, kLongestHeader); is_radiance(start)) return radiance_bytes(start);
    if (!image_header_problem(path, options.limits).empty()) return 0;
    return image_codecs().image_bytes(path, options.layer);
  } catch (const std::exception&) {
    return 0;
  }
}

}  // namespace etd
