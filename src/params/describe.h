// Declarations as text, for messages, "etendue describe" and the manuals.
#pragma once

#include <string>

#include "params/declaration.h"

namespace etd {

// The default as it would be written: "0.5", "1 1 1", "true", "\"copper\""; "required"; or "-" when there is none.
std::string default_text(const ParamDecl& decl);
// What values are allowed: ">= 0", "0 to 1", "> 0, clamped", "\"bilinear\", \"point\""; empty when any.
std::string range_text(const ParamDecl& decl);

}  // namespace etd
