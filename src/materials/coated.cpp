#include "materials/coated.h"

#include "bsdfs/coated_lambert.h"
#include "bsdfs/coated_mirror.h"
#include "bsdfs/conductor.h"
#include "bsdfs/dielectric.h"
#include "bsdfs/lambert.h"
#include "bsdfs/layered.h"
#include "bsdfs/rough_dielectric.h"
#include "bsdfs/roughness.h"
#include "materials/conductor.h"
#include "materials/material_data.h"

namespace etd {

namespace {
// At 1 all light goes straight on, and no density says so.
constexpr double kMaxMeanCosine = 0.999;

float coat_thickness(float given) { return std::max(given, 1e-20f); }
}  // namespace

std::vector<ParamDecl> CoatSource::params(const std::string& prefix) {
  std::vector<ParamDecl> list = RoughnessSource::params(prefix, 0.0, "of the coat");
  list.push_back({.name = prefix + "thickness",
                  .type = ParamType::kFloatTexture,
                  .default_value = 0.01,
                  .min = 0,
                  .unit = "mean free paths",
                  .doc = "Thickness of the coat, whose medium has extinction 1."});
  list.push_back(clear_index_param(prefix + "eta", "Index of refraction of the coat"));
  list.push_back({.name = "albedo",
                  .type = ParamType::kSpectrumTexture,
                  .default_value = 0.0,
                  .min = 0,
                  .max = 1,
                  .clamp = true,
                  .doc = "Share that the coat's medium scatters of what it takes out; 0 only absorbs."});
  list.push_back(
      {.name = "g",
       .type = ParamType::kFloatTexture,
       .default_value = 0.0,
       .min = -kMaxMeanCosine,
       .max = kMaxMeanCosine,
       .doc = "Mean cosine of that scattering; positive goes on forwards. Values of a texture are clamped."});
  list.push_back({.name = "maxdepth",
                  .type = ParamType::kInteger,
                  .default_value = 10,
                  .min = 1,
                  .max = 10000,
                  .doc = "Events between the layers after which light is given up, which darkens a little."});
  list.push_back(
      {.name = "nsamples",
       .type = ParamType::kInteger,
       .default_value = 1,
       .min = 1,
       .max = 10000,
       .doc = "Random walks between the layers for one value, where there is no closed form; more is slower and "
              "less noisy."});
  return list;
}

CoatSource CoatSource::create(const ParamReader& p, TextureBuilder& b, const std::string& prefix) {
  CoatSource c;
  c.roughness = RoughnessSource::create(p, b, prefix);
  c.thickness = b.number(p, prefix + "thickness");
  c.g = b.number(p, "g");
  c.albedo = b.spectrum(p, "albedo");
  c.eta = clear_index(p, prefix + "eta");
  c.max_depth = p.integer("maxdepth");
  c.samples = p.integer("nsamples");
  return c;
}

namespace {

// The closure of this bottom under the coat.
template <class Bottom>
Bsdf under_coat(const CoatSource& coat, bool remap, const Bottom& bottom, const TexCoord& at,
                const TextureTable& textures, const ShadingContext& context) {
  constexpr auto max_g = static_cast<float>(kMaxMeanCosine);
  const LayerSettings layer{clamp(textures.eval(coat.albedo, at, context), 0.0f, 1.0f),
                            coat_thickness(textures.eval(coat.thickness, at, context)),
                            clamp(textures.eval(coat.g, at, context), -max_g, max_g), coat.max_depth, coat.samples};
  const auto alpha = microfacet_alpha(textures.eval(coat.roughness.u, at, context),
                                      textures.eval(coat.roughness.v, at, context), remap);
  if (!alpha || coat.eta == 1.0f) {
    if constexpr (std::is_same_v<Bottom, SmoothConductor>)
      if (is_black(layer.albedo))
        return Bsdf(CoatedMirror{SmoothDielectric{coat.eta}, bottom, layer.thickness, layer.max_depth});
    return Bsdf(Layered<SmoothDielectric, Bottom>{SmoothDielectric{coat.eta}, bottom, layer});
  }
  return Bsdf(Layered<RoughDielectric, Bottom>{RoughDielectric{coat.eta, {alpha->x, alpha->y}}, bottom, layer});
}

}  // namespace

const ModelDecl& CoatedDiffuseMaterial::decl() {
  static const ModelDecl d = [] {
    ModelDecl m{Family::kMaterial,
                "coateddiffuse",
                "A diffuse surface under a dielectric coat: plastic, varnish, glazed tiles.",
                {{.name = "reflectance",
                  .type = ParamType::kSpectrumTexture,
                  .default_value = 0.5,
                  .min = 0,
                  .max = 1,
                  .clamp = true,
                  .doc = "Share of the light that the diffuse surface reflects."}}};
    return with_detail(with_params(m, {CoatSource::params(""), {remap_param()}}));
  }();
  return d;
}

CoatedDiffuseMaterial CoatedDiffuseMaterial::create(const ParamReader& p, TextureBuilder& b, MaterialData& data) {
  CoatedDiffuseMaterial m{b.spectrum(p, "reflectance"), CoatSource::create(p, b, ""), p.boolean("remaproughness"), {}};
  const CoatSource& c = m.coat;
  const bool constant = c.thickness.texture < 0 && c.roughness.u.texture < 0 && c.roughness.v.texture < 0;
  constexpr float kLeastIndex = 0.1f;  // below, 1 / eta^2 can overflow
  if (!constant || !c.only_absorbs() || c.eta < kLeastIndex) return m;
  const float thickness = coat_thickness(c.thickness.value);
  const auto alpha = microfacet_alpha(c.roughness.u.value, c.roughness.v.value, m.remap);
  if (!alpha || c.eta == 1.0f)
    m.smooth = smooth_coat_means(c.eta, thickness);
  else if (alpha->x == alpha->y && CoatTable::covers(c.eta, alpha->x))
    m.rough = data.coats.find(c.eta, alpha->x, thickness);
  return m;
}

Bsdf CoatedDiffuseMaterial::closure(const TexCoord& at, const TextureTable& textures,
                                    const ShadingContext& context) const {
  const Spectrum paint = clamp(textures.eval(reflectance, at, context), 0.0f, 1.0f);
  if (smooth) {
    const SmoothCoat smooth_coat{{coat.eta}, coat_thickness(coat.thickness.value), *smooth};
    return Bsdf(CoatedLambert(smooth_coat, paint, coat.max_depth));
  }
  if (rough) return Bsdf(CoatedLambert(RoughCoat{rough->boundary(), rough}, paint, coat.max_depth));
  return under_coat(coat, remap, Lambert{paint}, at, textures, context);
}

const ModelDecl& CoatedConductorMaterial::decl() {
  static const ModelDecl d = [] {
    const ModelDecl& metal = ConductorMaterial::decl();
    ModelDecl m{Family::kMaterial, "coatedconductor", "Metal under a dielectric coat: lacquer, car paint.", {}};
    for (const char* name : {"eta", "k"}) {
      ParamDecl p = *metal.find(name);
      p.name = std::string("conductor.") + name;
      m.params.push_back(p);
    }
    m.params.push_back(*metal.find("reflectance"));
    return with_detail(with_params(m, {RoughnessSource::params("conductor.", 0.0, "of the metal"),
                                       CoatSource::params("interface."),
                                       {remap_param()}}));
  }();
  return d;
}

CoatedConductorMaterial CoatedConductorMaterial::create(const ParamReader& p, TextureBuilder& b) {
  CoatedConductorMaterial m;
  m.by_reflectance = p.given("reflectance") != nullptr;
  if (m.by_reflectance) {
    for (const char* other : {"conductor.eta", "conductor.k"})
      if (const Param* given = p.given(other))
        p.diagnostics().error(given->loc,
                              "a conductor has either \"reflectance\" or \"conductor.eta\" and \"conductor.k\"",
                              "leave out one of them");
    m.reflectance = b.spectrum(p, "reflectance");
  } else {
    m.eta = b.spectrum(p, "conductor.eta");
    m.k = b.spectrum(p, "conductor.k");
  }
  m.roughness = RoughnessSource::create(p, b, "conductor.");
  m.coat = CoatSource::create(p, b, "interface.");
  m.remap = p.boolean("remaproughness");
  return m;
}

Bsdf CoatedConductorMaterial::closure(const TexCoord& at, const TextureTable& textures,
                                      const ShadingContext& context) const {
  Spectrum n(1.0f), kappa;
  if (by_reflectance) {
    kappa = absorption_of_reflectance(textures.eval(reflectance, at, context));
  } else {
    // The metal's indices are given against the outside; under the coat they are against the coat.
    n = textures.eval(eta, at, context) / coat.eta;
    kappa = textures.eval(k, at, context) / coat.eta;
  }
  const auto alpha =
      microfacet_alpha(textures.eval(roughness.u, at, context), textures.eval(roughness.v, at, context), remap);
  if (!alpha) return under_coat(coat, remap, SmoothConductor{n, kappa}, at, textures, context);
  return under_coat(coat, remap, RoughConductor{n, kappa, {alpha->x, alpha->y}}, at, textures, context);
}

}  // namespace etd
