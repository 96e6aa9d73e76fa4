#include "io/image_codecs.h"

#include <dlfcn.h>

#include <stdexcept>

#include <fmt/format.h>

namespace etd {
namespace {

constexpr const char* kModule = "libetendue_images.so";

std::string cannot_load(std::string_view why) {
  return fmt::format("images need {}, which is a part of this program: {}", kModule, why);
}

// The module is beside the program, as it is built, or in lib/etendue, as it is installed. Empty if it is missing.
std::filesystem::path module_path() {
  std::error_code failed;
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", failed).parent_path();
  for (std::filesystem::path path : {folder / kModule, folder / "../lib/etendue" / kModule})
    if (std::filesystem::exists(path, failed)) return path;
  return {};
}

const ImageCodecs* load_module() {
  const std::filesystem::path path = module_path();
  if (path.empty()) throw std::runtime_error(cannot_load("it is neither beside the program nor in ../lib/etendue"));
  using Codecs = const ImageCodecs* (*)();
  void* module = ::dlopen(path.c_str(), RTLD_LAZY | RTLD_LOCAL);
  const auto codecs = module ? reinterpret_cast<Codecs>(::dlsym(module, "etendue_image_codecs")) : nullptr;
  if (codecs) return codecs();
  const char* error = ::dlerror();
  throw std::runtime_error(cannot_load(error ? error : "it has no codecs"));
}

}  // namespace

const ImageCodecs& image_codecs() {
  static const ImageCodecs* codecs = load_module();
  return *codecs;
}

}  // namespace etd
