// The list of every model: the one place that knows all of them by name. Readers, compile(), `describe`, the manuals
// and the test battery ask here.
#pragma once

#include <span>
#include <string_view>

#include "params/declaration.h"

namespace etd {

// All models of a family, in the order in which they are listed to users.
std::span<const ModelDecl* const> models(Family family);
// The model of that name, null when there is none.
const ModelDecl* find_model(Family family, std::string_view name);

}  // namespace etd
