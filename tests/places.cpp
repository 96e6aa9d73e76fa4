#include "places.h"

namespace etd {

std::filesystem::path source_path(const std::string& relative) {
  return std::filesystem::path(ETENDUE_SOURCE_DIR) / relative;
}

std::filesystem::path program_path() { return ETENDUE_BINARY; }

}  // namespace etd
