#include "integrators/make_integrator.h"

#include "integrators/path.h"

namespace etd {

std::span<const ModelDecl* const> integrator_models() {
  static const ModelDecl* const all[] = {&PathIntegrator::decl()};
  return all;
}

std::unique_ptr<Integrator> make_integrator(const ModelUse& use, const Scene& scene, const IntegratorContext& context,
                                            Diagnostics& diagnostics) {
  const PathSettings settings = PathIntegrator::settings({PathIntegrator::decl(), use, diagnostics});
  return std::make_unique<PathIntegrator>(scene, settings, context);
}

}  // namespace etd
