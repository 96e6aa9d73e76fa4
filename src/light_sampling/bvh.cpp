#include "light_sampling/bvh.h"

#include <tbb/parallel_for.h>

#include "light_sampling/power.h"

namespace etd {

namespace {

// Where lights move, the time is cut into so many parts with a tree for each, as long as the trees have no more lights
// than this together.
constexpr size_t kMostTimes = 8, kMostLightsOfTimes = size_t{1} << 20;

std::vector<LightTree> make_trees(std::span<const Light> lights, const std::vector<uint32_t>& finite) {
  const bool moves = std::any_of(finite.begin(), finite.end(), [&](uint32_t i) { return lights[i].moves(); });
  const size_t times = moves ? std::clamp<size_t>(kMostLightsOfTimes / finite.size(), 1, kMostTimes) : 1;
  std::vector<LightTree> trees;
  for (size_t t = 0; t < times; ++t) {
    const float start = static_cast<float>(t) / static_cast<float>(times);
    const float end = static_cast<float>(t + 1) / static_cast<float>(times);
    std::vector<LightTree::Item> items(finite.size());
    tbb::parallel_for(size_t{0}, finite.size(), [&](size_t i) {
      items[i] = {*lights[finite[i]].bounds(start, end), finite[i]};
    });
    trees.emplace_back(std::move(items), lights.size());
  }
  return trees;
}

}  // namespace

BvhLightSampler BvhLightSampler::create(const LightSamplerContext& context, LightSamplerData& data) {
  LightForest forest;
  forest.anywhere = PowerLightSampler::create(context, data).table;
  if (!forest.anywhere) return {};
  std::vector<uint32_t> finite;
  std::vector<double> infinite;
  for (uint32_t i = 0; i < context.lights.size(); ++i) {
    const double power = power_of(context.lights[i]);
    const bool is_infinite = context.lights[i].is_infinite();
    forest.is_infinite.push_back(is_infinite);
    infinite.push_back(is_infinite ? power : 0.0);
    if (!is_infinite && power > 0.0) finite.push_back(i);
  }
  forest.infinite = LightTable::make(infinite, data);
  forest.infinite_share = !forest.infinite ? 0.0f : finite.empty() ? 1.0f : kInfiniteShare;
  forest.trees = make_trees(context.lights, finite);
  return {&data.forests.emplace_back(std::move(forest))};
}

namespace {

// The share of infinite lights at the receiver.
float infinite_share(const LightForest& forest, const LightTree& tree, const LightReceiver& receiver) {
  const bool mixed = forest.infinite_share > 0.0f && forest.infinite_share < 1.0f;
  return mixed && !tree.may_reach(receiver) ? 1.0f : forest.infinite_share;
}

}  // namespace

std::optional<LightChoice> BvhLightSampler::choose(double u, const LightReceiver* receiver) const {
  if (!forest) return {};
  if (!receiver) return LightTable{forest->anywhere}.choose(u, nullptr);
  const LightTree& tree = forest->at(receiver->time);
  const float infinite = infinite_share(*forest, tree, *receiver);
  if (infinite == 0.0f) return tree.choose(u, *receiver);
  const auto share = static_cast<double>(infinite);
  std::optional<LightChoice> choice;
  if (u < share) {
    choice = LightTable{forest->infinite}.choose(u / share, nullptr);
    choice->probability *= infinite;
  } else {
    choice = tree.choose((u - share) / (1.0 - share), *receiver);
    if (choice) choice->probability *= 1.0f - infinite;
  }
  return choice;
}

float BvhLightSampler::probability(uint32_t light, const LightReceiver* receiver) const {
  if (!forest) return 0.0f;
  if (!receiver) return forest->anywhere->probability(light);
  const LightTree& tree = forest->at(receiver->time);
  if (forest->infinite_share == 0.0f) return tree.probability(light, *receiver);
  const float infinite = infinite_share(*forest, tree, *receiver);
  return forest->is_infinite[light] ? forest->infinite->probability(light) * infinite
                                    : tree.probability(light, *receiver) * (1.0f - infinite);
}

}  // namespace etd
