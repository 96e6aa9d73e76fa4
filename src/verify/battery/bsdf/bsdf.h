// The battery over closures: what a closure says about itself (density, weight, reciprocity, energy) is compared with
// what it does. It works on anything with the closures' functions, so that its own tests can feed it faulty ones.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bsdfs/examples.h"
#include "verify/battery/check.h"

namespace etd {

// A closure with its type erased, or a closure on a surface whose shading normal is tilted. Directions are in the frame
// of the geometric normal.
struct ScatterModel {
  std::string name;
  BsdfTraits traits;
  Lobe lobes = kNoLobe;
  bool lossless = false;  // these two: see BsdfExample
  float min_cos = 0;
  Vec3 ns{0, 0, 1};  // the shading normal
  std::function<Spectrum(Vec3, Vec3, TransportMode, HashStream&)> eval_cos;
  std::function<float(Vec3, Vec3, TransportMode, Lobe)> pdf;
  std::function<std::optional<BsdfSample>(Vec3, Vec3, TransportMode, HashStream&, Lobe)> sample;

  bool has_delta() const { return (lobes & kDelta) != 0; }
  bool has_smooth() const { return (lobes & (kDiffuse | kGlossy)) != 0; }
  bool is_tilted() const { return ns.z != 1.0f; }
  // |cos| between w and the normal that it is nearer to grazing.
  float grazing_cos(Vec3 w) const { return std::min(std::abs(w.z), std::abs(dot(w, ns))); }
};

// Makes the model of a closure or of a Bsdf.
template <class Closure>
ScatterModel scatter_model(std::string name, const Closure& c, BsdfTraits traits, bool lossless = false,
                           float min_cos = 0.0f) {
  ScatterModel m{std::move(name), traits, c.lobes(), lossless, min_cos, {0, 0, 1}, {}, {}, {}};
  m.eval_cos = [c](Vec3 wo, Vec3 wi, TransportMode mode, HashStream& rng) { return c.eval_cos(wo, wi, mode, rng); };
  m.pdf = [c](Vec3 wo, Vec3 wi, TransportMode mode, Lobe sides) { return c.pdf(wo, wi, mode, sides); };
  m.sample = [c](Vec3 wo, Vec3 u, TransportMode mode, HashStream& rng, Lobe sides) {
    return c.sample(wo, u, mode, rng, sides);
  };
  return m;
}
inline ScatterModel scatter_model(const BsdfExample& e) {
  return scatter_model(e.name, e.bsdf, e.bsdf.traits(), e.lossless, e.min_cos);
}
// The closure under the rule of materials/surface_scatter.h, its shading normal `degrees` away from the geometric one.
ScatterModel tilted_model(const BsdfExample& example, double degrees);

struct BsdfBatteryOptions {
  size_t samples = 100000;     // per direction, mode and choice of sides
  uint64_t seed = 1;           // of the random numbers; every seed must pass
  double family_level = 1e-5;  // probability of any false alarm among the checks of one model
};

// All checks that the model's lobes and traits call for, judged.
std::vector<CheckResult> check_bsdf(const ScatterModel& model, const BsdfBatteryOptions& options);

}  // namespace etd
