// The list of integrators.
#pragma once

#include <memory>
#include <span>

#include "integrators/pixel_integrator.h"
#include "params/declaration.h"
#include "scene/scene.h"

namespace etd {

std::span<const ModelDecl* const> integrator_models();
// Makes the integrator of a use whose parameters have been checked. The scene must outlive the integrator.
std::unique_ptr<Integrator> make_integrator(const ModelUse& use, const Scene& scene, const IntegratorContext& context,
                                            Diagnostics& diagnostics);

}  // namespace etd
