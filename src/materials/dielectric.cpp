#include "materials/dielectric.h"

#include <fmt/format.h>

#include "spectrum/named.h"

namespace etd {

const ModelDecl& DielectricMaterial::decl() {
  static const ModelDecl d{Family::kMaterial,
                           "dielectric",
                           "Smooth glass: reflects and refracts as Fresnel says.",
                           {{.name = "eta",
                             .type = ParamType::kSpectrum,
                             .default_value = 1.5,
                             .min = 0,
                             .above_min = true,
                             .doc = "Index of refraction inside over outside: a number, or a named glass at 587.6 nm."},
                            {.name = "remaproughness",
                             .type = ParamType::kBool,
                             .default_value = true,
                             .doc = "How roughness is read; has no effect on a smooth surface."}}};
  return d;
}

DielectricMaterial DielectricMaterial::create(const ParamReader& p, TextureBuilder&) {
  const Param* eta = p.given("eta");
  if (eta && eta->kind == ParamKind::kSpectrum && !eta->strings.empty()) {
    if (const auto glass = named_glass(eta->strings[0])) return {*glass};
    p.diagnostics().error(eta->value_loc, fmt::format("there is no glass \"{}\"", eta->strings[0]),
                          fmt::format("valid: a number, or one of {}", named_glasses()));
    return {};
  }
  const Spectrum value = spectrum_value(p, "eta");
  if (value[0] != value[1] || value[1] != value[2])
    p.diagnostics().unsupported(eta->value_loc, "an index of refraction that differs between colours",
                                "the mean of the three");
  return {mean_value(value)};
}

}  // namespace etd
