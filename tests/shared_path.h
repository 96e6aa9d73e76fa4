// Finds the material that lies beside the project (scenes, meshes, references). Tests that need it skip when it is
// absent.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "places.h"

namespace etd {

// A path in the shared folder: $ETENDUE_SHARED, or ../shared seen from the project. Empty when it is not there.
inline std::filesystem::path shared_path(const std::string& relative) {
  const char* chosen = std::getenv("ETENDUE_SHARED");
  const std::filesystem::path root = chosen != nullptr ? std::filesystem::path(chosen) : source_path("../shared");
  std::error_code ignored;
  return std::filesystem::exists(root / relative, ignored) ? root / relative : std::filesystem::path();
}

}  // namespace etd
