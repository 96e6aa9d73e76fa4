// The family of closures: how one point of a surface scatters light, in the local shading frame (z is the shading
// normal; wo and wi point away from the surface). Directions on both sides are valid; a closure that only reflects
// answers 0 for the rest.
#pragma once

#include <optional>

#include "core/frame.h"
#include "core/hash.h"
#include "core/tagged.h"
#include "spectrum/spectrum.h"

namespace etd {

// What is transported along the path that is being built: radiance (paths from the camera) or importance (from lights).
// Refraction scales only radiance (Veach 1997, section 5.2).
enum class TransportMode : uint8_t { kRadiance, kImportance };

// What a closure's lobes are, as bits. As an argument it selects sides of the surface (kReflection, kTransmission);
// as part of a sample it says which lobe was taken.
enum Lobe : uint8_t {
  kNoLobe = 0,
  kReflection = 1,
  kTransmission = 2,
  kDiffuse = 4,
  kGlossy = 8,
  kDelta = 16,
  kBothSides = kReflection | kTransmission,
};
constexpr Lobe operator|(Lobe a, Lobe b) { return static_cast<Lobe>(static_cast<int>(a) | static_cast<int>(b)); }

// What a closure's type promises, as `static constexpr BsdfTraits kTraits`; verify/battery/bsdf/bsdf.h tests exactly
// that.
struct BsdfTraits {
  bool delta = false;              // only delta lobes: eval_cos() and pdf() are 0
  bool stochastic = false;         // eval_cos() is random, pdf() an approximation that serves as a MIS weight
  bool reciprocal = false;         // f(wi, wo) = eta^2 f(wo, wi) for radiance, eta as in BsdfSample
  bool energy_conserving = false;  // no more importance leaves than arrives
};

struct BsdfSample {
  Vec3 wi;
  Spectrum weight;  // f(wo, wi) |cos wi| / pdf, per the density that generated wi
  float pdf = 0;    // per solid angle; of a delta lobe: its discrete probability
  Lobe lobe = kNoLobe;
  float eta = 1;  // index on the side of wi over that on the side of wo; 1 for reflection

  bool is_delta() const { return (lobe & kDelta) != 0; }
  bool is_transmission() const { return (lobe & kTransmission) != 0; }
};

struct BsdfValue {
  Spectrum f_cos;
  float pdf = 0;
};

class Bsdf {
 public:
  Bsdf() {}  // leaves its bytes as they are
  // Holds a closure of a type in the list (bsdfs/bsdf_list.h).
  template <class T>
  explicit Bsdf(const T& closure);

  // f(wo, wi) |cos wi|; delta lobes are 0. `rng` serves stochastic closures only.
  Spectrum eval_cos(Vec3 wo, Vec3 wi, TransportMode mode, HashStream& rng) const;
  // Solid-angle density with which sample() makes wi among the allowed sides; delta lobes are 0.
  float pdf(Vec3 wo, Vec3 wi, TransportMode mode, Lobe sides = kBothSides) const;
  // Returns both at once, for radiance and all sides.
  BsdfValue eval_pdf(Vec3 wo, Vec3 wi, HashStream& rng) const;
  // u.x, u.y place the direction, u.z chooses among lobes. Nothing when the sample fails (below the surface, absorbed,
  // or no lobe on the allowed sides): that is an estimate of 0.
  std::optional<BsdfSample> sample(Vec3 wo, Vec3 u, TransportMode mode, HashStream& rng, Lobe sides = kBothSides) const;
  // Union of the lobes that the closure has. Every vertex asks for it several times, so it is kept.
  Lobe lobes() const { return lobes_; }
  // How wide the widest lobe is that is no delta: 1 where one is diffuse, of a microfacet lobe the greater alpha, and 0
  // where all are deltas.
  float widest_alpha() const;
  // Whether it looks the same when it turns about the normal, so that any tangent serves.
  bool is_isotropic() const;
  // Hemispherical-directional reflectance towards wo, or an estimate of it where none is closed: the albedo feature.
  Spectrum albedo(Vec3 wo) const;

  BsdfTraits traits() const;
  // Which closure of the list this is, below kind_count(): tells whether every one of them is tested.
  uint32_t kind() const { return storage_.tag; }
  static uint32_t kind_count();

  // Whether any lobe has a finite density, so that eval_cos() can be other than 0.
  bool has_smooth_lobe() const { return (lobes_ & (kDiffuse | kGlossy)) != 0; }

 private:
  TaggedStorage<128> storage_;
  Lobe lobes_ = kNoLobe;
};

}  // namespace etd
