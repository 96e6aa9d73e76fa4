// The list of integrators.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "integrators/integrator.h"
#include "integrators/variant.h"
#include "params/declaration.h"
#include "scene/scene.h"

namespace etd {

std::span<const ModelDecl* const> integrator_models();
// Those of the default integrator, path, for an unknown name.
const IntegratorTraits& integrator_traits(std::string_view name);
// All ways to estimate the image of a scene with paths of this many scattering events at most. The first, of path, is
// what the others are compared with.
std::vector<Variant> integrator_variants(const Scene& scene, int max_depth);
// Makes the integrator of a use whose parameters have been checked. The scene must outlive it. What does not go
// together with the scene is reported.
std::unique_ptr<Integrator> make_integrator(const ModelUse& use, const Scene& scene, const IntegratorContext& context,
                                            Diagnostics& diagnostics);

}  // namespace etd
