// The list of light samplers. To add one: its header, and its name in the list. A type T of it
// has T::kName and T::kDoc; T::create(context, data); choose(u, receiver) and probability(light, receiver), which say
// what LightSampler says; and, where its probabilities have a closed form, T::law(context), which the battery holds
// them against.
#pragma once

#include "light_sampling/bvh.h"
#include "light_sampling/power.h"
#include "light_sampling/uniform.h"

namespace etd {

using LightSamplers = TypeList<BvhLightSampler, PowerLightSampler, UniformLightSampler>;

template <class T>
LightSampler::LightSampler(const T& sampler, std::shared_ptr<const LightSamplerData> data) : data_(std::move(data)) {
  storage_.store<LightSamplers>(sampler);
}

}  // namespace etd
