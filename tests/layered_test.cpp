// Layered closures against what they must become in limits, and against a path tracer through real layers.
#include "bsdfs/layered.h"

#include <gtest/gtest.h>

#include "bsdfs/conductor.h"
#include "bsdfs/dielectric.h"
#include "bsdfs/lambert.h"
#include "bsdfs/rough_dielectric.h"
#include "render_helper.h"

namespace etd {
namespace {

template <class Closure>
RunningStats mean_weight(const Closure& c, Vec3 wo, int samples, uint64_t seed) {
  HashStream numbers(seed), rng(seed + 1);
  RunningStats stats;
  for (int i = 0; i < samples; ++i) {
    const float x = numbers.next_float(), y = numbers.next_float(), z = numbers.next_float();
    const auto s = c.sample(wo, {x, y, z}, TransportMode::kRadiance, rng, kBothSides);
    stats.add(s ? static_cast<double>(s->weight[0]) : 0.0);
  }
  return stats;
}

// A coat of the index of air and no thickness is not there.
TEST(Layered, CoatOfAirIsTheBottom) {
  LayerSettings none;
  none.thickness = 1e-20f;
  const Lambert paint{Spectrum(0.6f)};
  const Layered<SmoothDielectric, Lambert> coated{{1.0f}, paint, none};
  HashStream rng(1);
  for (const Vec3 wi : {Vec3{0, 0, 1}, Vec3{0.6f, 0, 0.8f}, Vec3{0, -0.8f, 0.6f}}) {
    const Vec3 wo{0.28f, 0, 0.96f};
    const float expected = paint.eval_cos(wo, wi, TransportMode::kRadiance, rng)[0];
    EXPECT_NEAR(coated.eval_cos(wo, wi, TransportMode::kRadiance, rng)[0], expected, 1e-5f * expected);
  }
  EXPECT_NEAR(mean_weight(coated, {0.28f, 0, 0.96f}, 1000, 3).mean(), 0.6, 1e-5);
}

// Smooth coat over Lambert without absorption: the light that enters is reflected between the layers in a geometric
// series. With F the reflectance at wo and Fi the mean (cosine-weighted) internal reflectance of the coat,
// R = F + (1 - F) rho (1 - Fi) / (1 - rho Fi) (Saunderson 1942). For index 1.5: Fi = 0.5963 (Walsh 1926).
TEST(Layered, SmoothCoatOverDiffuseIsSaundersons) {
  LayerSettings clear;
  clear.thickness = 1e-20f;
  clear.max_depth = 400;
  for (float rho : {0.2f, 0.8f, 1.0f}) {
    const Layered<SmoothDielectric, Lambert> coated{{1.5f}, {Spectrum(rho)}, clear};
    const double f = 0.04, fi = 0.59633;
    const double expected = f + (1 - f) * rho * (1 - fi) / (1 - rho * fi);
    const RunningStats r = mean_weight(coated, {0, 0, 1}, 200000, 5);
    EXPECT_NEAR(r.mean(), expected, 5 * std::sqrt(r.variance_of_mean()) + 2e-4) << rho;
  }
}

// Smooth over smooth is a mirror: F + (1 - F)^2 R T^2 / (1 - F R T^2), T the transmittance of one crossing.
TEST(Layered, MirrorUnderACoatIsAGeometricSeries) {
  LayerSettings clear;
  clear.thickness = 0.1f;
  clear.max_depth = 100;
  const SmoothConductor metal{Spectrum(0.2f), Spectrum(3.0f)};
  const Layered<SmoothDielectric, SmoothConductor> coated{{1.5f}, metal, clear};
  const Vec3 wo{0.6f, 0, 0.8f};
  const auto [f, cos_t] = fresnel_dielectric(wo.z, 1.5f);
  const double r = metal.albedo({std::sqrt(1 - cos_t * cos_t), 0, cos_t})[0], t2 = std::exp(-2 * 0.1 / cos_t);
  const double expected = f + (1 - f) * (1 - f) * r * t2 / (1 - f * r * t2);
  const RunningStats m = mean_weight(coated, wo, 200000, 7);
  EXPECT_NEAR(m.mean(), expected, 5 * std::sqrt(m.variance_of_mean()) + 1e-5);
}

// A rough plane just above a diffuse one is the same thing to the path tracer.
TEST(Layered, RealLayersReflectTheSame) {
  const auto render = [](const std::string& surfaces, uint64_t seed) {
    RenderOverrides o;
    o.spp = 131072;
    o.replicates = 32;
    o.seed = seed;
    o.features = false;
    o.set = {{"integrator.mode", "naive"}};
    return image_mean(render_text(R"(
LookAt 0 -3 4  0 0 0  0 0 1
Camera "perspective" "float fov" 1
Film "rgb" "integer xresolution" 2 "integer yresolution" 2
Integrator "path" "integer maxdepth" 200
WorldBegin
LightSource "infinite" "rgb L" [ 1 1 1 ]
)" + surfaces,
                                  "tests/scenes", o));
  };
  const RunningStats model = render(R"(
Material "coateddiffuse" "rgb reflectance" [ 0.8 0.8 0.8 ] "float roughness" 0.3 "float thickness" 0
  "bool remaproughness" false "integer maxdepth" 200
Shape "trianglemesh" "point3 P" [ -9 -9 0  9 -9 0  9 9 0  -9 9 0 ] "integer indices" [ 0 1 2 0 2 3 ]
)",
                                    1);
  const RunningStats layers = render(R"(
Material "dielectric" "float roughness" 0.3 "bool remaproughness" false
Shape "trianglemesh" "point3 P" [ -9 -9 0  9 -9 0  9 9 0  -9 9 0 ] "integer indices" [ 0 1 2 0 2 3 ]
Translate 0 0 -0.001
Material "diffuse" "rgb reflectance" [ 0.8 0.8 0.8 ]
Shape "trianglemesh" "point3 P" [ -9 -9 0  9 -9 0  9 9 0  -9 9 0 ] "integer indices" [ 0 1 2 0 2 3 ]
)",
                                     2);
  EXPECT_GT(welch_test(model, layers).p_value, 1e-4) << model.mean() << " and " << layers.mean();
  EXPECT_LT(std::sqrt(model.variance_of_mean() + layers.variance_of_mean()), 0.003 * layers.mean());
}

}  // namespace
}  // namespace etd
