#include "materials/parameters.h"

#include <fmt/format.h>

#include "materials/surface_detail.h"
#include "spectrum/named.h"

namespace etd {

std::vector<ParamDecl> RoughnessSource::params(const std::string& prefix, double default_value, const std::string& of) {
  const auto one = [&](const char* name, const std::string& doc) {
    return ParamDecl{.name = prefix + name, .type = ParamType::kFloatTexture, .min = 0, .doc = doc};
  };
  ParamDecl both = one("roughness", fmt::format("Width of the lobe {} along both directions; 0 is smooth.", of));
  both.default_value = default_value;
  return {both, one("uroughness", fmt::format("Width along u, when it differs from \"{}roughness\".", prefix)),
          one("vroughness", fmt::format("Width along v, when it differs from \"{}roughness\".", prefix))};
}

RoughnessSource RoughnessSource::create(const ParamReader& p, TextureBuilder& b, const std::string& prefix) {
  const auto name = [&](const char* direction) {
    return prefix + (p.given(prefix + direction) ? direction : "roughness");
  };
  return {b.number(p, name("uroughness")), b.number(p, name("vroughness"))};
}

ParamDecl remap_param() {
  return {.name = "remaproughness",
          .type = ParamType::kBool,
          .default_value = true,
          .doc = "Take the microfacet alpha as the square root of the roughness, otherwise as the roughness itself."};
}

ParamDecl energy_param() {
  return {.name = "energycompensation",
          .type = ParamType::kBool,
          .default_value = false,
          .doc =
              "Add the light that rough surfaces scatter more than once, which is lost otherwise (Turquin 2019). Not "
              "in pbrt-v4."};
}

ParamDecl clear_index_param(const std::string& name, const std::string& doc) {
  return {.name = name,
          .type = ParamType::kSpectrum,
          .default_value = 1.5,
          .min = 0,
          .above_min = true,
          .doc = doc + ": a number, or a named glass at 587.6 nm."};
}

float clear_index(const ParamReader& p, std::string_view name) {
  const Param* eta = p.given(name);
  if (eta && eta->kind == ParamKind::kSpectrum && !eta->strings.empty()) {
    if (const auto glass = named_glass(eta->strings[0])) return *glass;
    p.diagnostics().error(eta->value_loc, fmt::format("there is no glass \"{}\"", eta->strings[0]),
                          fmt::format("valid: a number, or one of {}", named_glasses()));
    return 1.5f;
  }
  const Spectrum value = spectrum_value(p, name);
  if (std::abs(value[0] - value[1]) > 1e-5f * value[0] || std::abs(value[1] - value[2]) > 1e-5f * value[1])
    p.diagnostics().unsupported(eta->value_loc, "an index of refraction that differs between colours",
                                "the mean of the three");
  return mean_value(value);
}

ModelDecl with_detail(ModelDecl decl) { return with_params(std::move(decl), {SurfaceDetail::params()}); }

}  // namespace etd
