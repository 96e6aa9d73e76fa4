#include "light_sampling/light_sampler.h"

#include "light_sampling/light_sampler_list.h"
#include "params/model_list.h"

namespace etd {

LightSampler::LightSampler() : LightSampler(PowerLightSampler(), nullptr) {}

std::optional<LightChoice> LightSampler::sample(double u, const LightReceiver* receiver) const {
  return dispatch<std::optional<LightChoice>, LightSamplers>(storage_,
                                                             [&](const auto& s) { return s.choose(u, receiver); });
}

float LightSampler::probability(uint32_t light, const LightReceiver* receiver) const {
  return dispatch<float, LightSamplers>(storage_, [&](const auto& s) { return s.probability(light, receiver); });
}

std::string_view LightSampler::name() const {
  return dispatch<std::string_view, LightSamplers>(storage_, [](const auto& s) { return s.kName; });
}

namespace {
template <class... Ts>
std::vector<LightSamplerModel> models_of(TypeList<Ts...>) {
  return {{Ts::kName, Ts::kDoc}...};
}
}  // namespace

ParamDecl light_sampler_param() {
  return choice_param<PowerLightSampler>(LightSamplers{}, "lightsampler", "How lights are chosen: ",
                                         "; never changes the mean. Of the paths that start at lights a "
                                         "quarter are begun so, the others by flux.");
}

std::vector<LightSamplerModel> light_sampler_models() { return models_of(LightSamplers{}); }

LightSampler make_light_sampler(std::string_view name, const LightSamplerContext& context) {
  const auto data = std::make_shared<LightSamplerData>();
  LightSampler sampler;
  const auto make = [&]<class T>(std::type_identity<T>) { sampler = LightSampler(T::create(context, *data), data); };
  if (!with_named(LightSamplers{}, name, make)) make(std::type_identity<PowerLightSampler>());
  return sampler;
}

}  // namespace etd
