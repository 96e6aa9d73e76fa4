// Samplers and integrators that users know by name from elsewhere, whose pictures are those of one of ours.
#pragma once

#include <span>
#include <string_view>

#include "params/declaration.h"

namespace etd {

// Returns the names of samplers or integrators; other families have none.
std::span<const std::string_view> other_names(Family family);
// The name that ours has, for one of other_names().
std::string_view our_name(Family family, std::string_view other);

// Makes a use of such a name one of ours that keeps what ours takes, with a note that says what is used and what is
// left out. Other uses stay as they are.
void take_other_name(Family family, ModelUse& use, Diagnostics& diagnostics);

}  // namespace etd
