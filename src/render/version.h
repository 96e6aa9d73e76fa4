// The version of the library, for metadata and for people.
#pragma once

namespace etd {

const char* version();  // "1.2.3"

}  // namespace etd
