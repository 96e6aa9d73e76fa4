// The battery over the smaller families, each check over a model with its type erased, so that its own tests can feed
// it faulty ones. A check is in the file of its family; the results are judged.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/hash.h"
#include "core/vec.h"
#include "filters/filter.h"
#include "light_sampling/light_sampler.h"
#include "params/declaration.h"
#include "spectrum/spectrum.h"
#include "verify/battery/battery.h"

namespace etd {

// samplers/sampler.h says what the functions of a sampler do.
struct SamplerFunctions {
  std::function<void(uint64_t stream, uint32_t replicate, uint32_t index)> start;
  std::function<void(uint32_t dimension)> set_dimension, fetch;
  std::function<float()> get_1d;
  std::function<Vec2()> get_2d;
  std::function<Vec3()> get_3d;
  std::function<double()> get_choice;
  std::function<uint64_t()> key;
};
struct SamplerModel {
  std::string name;
  bool stratified = false;  // in elementary intervals
  std::function<SamplerFunctions(uint64_t seed)> make;
};
SamplerModel sampler_model(const std::string& name);
std::vector<CheckResult> check_sampler(const SamplerModel& model, const BatteryOptions& options);

struct FilterModel {
  std::string name;
  Vec2 radius;
  std::function<float(Vec2 offset)> eval;
  std::function<FilterSample(Vec2 u)> sample;
};
FilterModel filter_model(const std::string& name, const Filter& filter);
std::vector<CheckResult> check_filter(const FilterModel& model, const BatteryOptions& options);

struct PhaseModel {
  std::string name;
  double mean_cosine = 0;  // of going on straight ahead
  std::function<float(Vec3 wo, Vec3 wi)> p;
  std::function<Vec3(Vec3 wo, Vec2 u)> sample;
};
PhaseModel henyey_greenstein_model(float g);
std::vector<CheckResult> check_phase(const PhaseModel& model, const BatteryOptions& options);

// A map from the unit square.
struct WarpModel {
  std::string model;    // the function, as core/ names it
  std::string setting;  // what else it depends on
  std::function<Vec3d(Vec2)> map;
  std::function<double(Vec2)> pdf;                               // per area (or solid angle) where u is sent to
  std::function<bool(Vec2)> smooth = [](Vec2) { return true; };  // no kink and not too steep near u
  float step = 0.004f;                                           // of the differences
  std::string name() const { return setting.empty() ? model : model + "(" + setting + ")"; }
};
std::vector<CheckResult> check_warp(const WarpModel& model);

// The choice among the lights of the example list.
struct LightChoiceModel {
  std::string name;
  std::vector<double> law;  // that the probabilities follow whatever the receiver; empty: none that is known
  std::function<std::optional<LightChoice>(double u, const LightReceiver* receiver)> sample;
  std::function<float(uint32_t light, const LightReceiver* receiver)> probability;
};
LightChoiceModel light_choice_model(const std::string& name);
std::vector<CheckResult> check_light_choice(const LightChoiceModel& model);

struct TextureModel {
  std::string name;
  bool is_number = false;  // rather than a colour
  std::function<Spectrum(Vec2 uv)> eval;
};
std::vector<CheckResult> check_texture(const TextureModel& model);

// The material made of its declaration, then as the closures are (verify/battery/bsdf/bsdf.h).
std::vector<CheckResult> check_material(const std::string& name, const ModelUse& use, const BatteryOptions& options);
// Draws 1 for the second material of a mix and 0 for the first, which must happen with the probability `amount`.
using MixChoice = std::function<double(HashStream&)>;
std::vector<CheckResult> check_mix(const std::string& name, double amount, const MixChoice& choose,
                                   const BatteryOptions& options);

}  // namespace etd
