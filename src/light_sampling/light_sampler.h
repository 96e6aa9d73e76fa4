// The family of light samplers: each chooses one light, for next-event estimation or for a path that starts there. Any
// choice gives the same mean, as long as every light that may reach the receiver can be chosen.
#pragma once

#include <deque>
#include <memory>
#include <string_view>
#include <vector>

#include "core/distribution.h"
#include "core/tagged.h"
#include "light_sampling/light_forest.h"
#include "lights/light.h"

namespace etd {

// The point that asks for light, by which a sampler may choose.
struct LightReceiver {
  LightReceiver() = default;
  LightReceiver(const SurfacePoint& s, float time_of_path) : p(s.p), n(s.ng), time(time_of_path) {}
  // One that is seen along wo: where the surface only reflects, light from the other side is of no use.
  LightReceiver(const SurfacePoint& s, Vec3 wo, bool transmits, float time_of_path)
      : p(s.p), n(dot(s.ng, wo) < 0.0f ? -s.ng : s.ng), time(time_of_path), both_sides(transmits) {}

  Point3 p;
  Vec3 n;  // unit geometric normal
  float time = 0;
  bool both_sides = true;  // light may come from behind n too
};

struct LightChoice {
  uint32_t light;
  float probability;
};

// What a light sampler is made from.
struct LightSamplerContext {
  std::span<const Light> lights;
  Point3 viewer = {};  // where the camera is, about
};

// What light samplers are too small to hold themselves. Nothing in it moves.
struct LightSamplerData {
  std::deque<AliasTable> tables;
  std::deque<LightForest> forests;
};

class LightSampler {
 public:
  // The default, which chooses no light.
  LightSampler();
  template <class T>
  LightSampler(const T& sampler, std::shared_ptr<const LightSamplerData> data);

  // Takes u in [0, 1) with all the bits of a double. `receiver` is null when the light is to start a path, whoever may
  // receive it. Nothing when no light emits.
  std::optional<LightChoice> sample(double u, const LightReceiver* receiver) const;
  // The probability with which sample() gives the light to this receiver.
  float probability(uint32_t light, const LightReceiver* receiver) const;
  std::string_view name() const;

 private:
  TaggedStorage<16> storage_;
  std::shared_ptr<const LightSamplerData> data_;  // that the stored value refers to
};

// A light sampler's name and what it says of itself, behind "lights are chosen".
struct LightSamplerModel {
  std::string name, doc;
};
std::vector<LightSamplerModel> light_sampler_models();
// The parameter "lightsampler" of integrators.
ParamDecl light_sampler_param();
// Makes the sampler of that name; the default, power, for an unknown one.
LightSampler make_light_sampler(std::string_view name, const LightSamplerContext& context);

}  // namespace etd
