// Settings of a model made from its declaration alone, so that a new model is tested at the ends and in the middle of
// its parameters' ranges without anyone listing them.
#pragma once

#include <string>
#include <vector>

#include "params/declaration.h"

namespace etd {

// The first has no parameters but the required ones. Then come settings in which every parameter that has a default
// takes each of a few values of its range at least once, all changing together; then the same of those that have none.
// Parameters that are files get `image`; those of no known meaning are left out.
std::vector<ModelUse> parameter_grid(const ModelDecl& decl, const std::string& image = {});

// "conductor(roughness 0.25, k 2)".
std::string setting_name(const ModelUse& use);

}  // namespace etd
