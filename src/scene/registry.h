// The list of every model: the one place that knows all of them by name. Readers, compile(), `describe`, the manuals
// and the test battery ask here.
#pragma once

#include <span>
#include <string_view>

#include "params/declaration.h"
#include "scene/names.h"

namespace etd {

// All models of a family, in the order in which they are listed to users.
std::span<const ModelDecl* const> models(Family family);
// The model of that name, null when there is none.
const ModelDecl* find_model(Family family, std::string_view name);
// The name of the model of a use, for as long as the program runs, and where it stands.
SceneNames::Item name_item(Family family, const ModelUse& use);

}  // namespace etd
