// Every model that a scene file or a command line can name, of all families: those of the scene's registry, and the
// algorithms, which stand on a higher floor.
#pragma once

#include <span>
#include <string_view>

#include "params/declaration.h"

namespace etd {

inline constexpr Family kAllFamilies[] = {Family::kShape,     Family::kMaterial,  Family::kTexture, Family::kLight,
                                          Family::kAreaLight, Family::kCamera,    Family::kFilter,  Family::kFilm,
                                          Family::kSampler,   Family::kIntegrator};

// The models of one family in the order in which they are listed to users.
std::span<const ModelDecl* const> all_models(Family family);
// Null when the family has no model of this name.
const ModelDecl* find_any_model(Family family, std::string_view name);
// Does as find_any_model(); an unknown name is reported at the use, with the names that would be valid.
const ModelDecl* require_model(Family family, const ModelUse& use, Diagnostics& diagnostics);

}  // namespace etd
