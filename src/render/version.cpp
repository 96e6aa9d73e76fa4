#include "render/version.h"

namespace etd {

const char* version() { return ETENDUE_VERSION; }

}  // namespace etd
