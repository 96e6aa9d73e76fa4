#include "scene/place_lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace etd {

namespace {

class LightPlacer {
 public:
  explicit LightPlacer(const SceneDescription& description)
      : description_(description), lights_in_(description.objects.size()), first_(description.objects.size()) {
    for (const LightDesc& light : description.lights) placed_.push_back({&light, {TransformPath()}});
    // Objects only contain earlier ones.
    for (size_t o = 0; o < description.objects.size(); ++o) {
      const ObjectDesc& object = description.objects[o];
      first_[o] = placed_.size();
      for (const LightDesc& light : object.lights) placed_.push_back({&light, {}});
      lights_in_[o] = static_cast<double>(object.lights.size()) + lights_of(object.instances);
    }
  }

  std::vector<PlacedLight> run(Diagnostics& diagnostics) {
    // Instances within instances multiply, so that a short text can ask for any number of lights.
    const double most =
        static_cast<double>(diagnostics.limits().copies) + static_cast<double>(description_.instances.size());
    if (const double count = lights_of(description_.instances); count > most) {
      const auto largest = std::max_element(description_.instances.begin(), description_.instances.end(),
                                            [&](const auto& a, const auto& b) { return lights_of(a) < lights_of(b); });
      diagnostics.error(largest->loc, fmt::format("instances place {:.3g} lights", count),
                        "lights that the scene does not list: " + limit_text(diagnostics.limits(), &Limits::copies));
    } else {
      for (const InstanceDesc& i : description_.instances) add(i);
    }
    return std::move(placed_);
  }

 private:
  double lights_of(const InstanceDesc& i) const { return lights_in_[static_cast<size_t>(i.object)]; }
  double lights_of(const std::vector<InstanceDesc>& instances) const {
    double sum = 0;
    for (const InstanceDesc& i : instances) sum += lights_of(i);
    return sum;
  }

  // All lights of an instance and of those in it; without recursion, because nothing limits how deep they go.
  void add(const InstanceDesc& root) {
    std::vector<std::pair<const InstanceDesc*, TransformPath>> open = {{&root, {}}};
    while (!open.empty()) {
      const auto [instance, outside] = std::move(open.back());
      open.pop_back();
      // What has no inverse is reported with the geometry.
      const TransformPair& t = instance->to_world;
      if (lights_of(*instance) == 0 || t.start.is_singular() || t.end.is_singular()) continue;
      const auto index = static_cast<size_t>(instance->object);
      const ObjectDesc& object = description_.objects[index];
      const TransformPath to_world = outside.then(t);
      for (size_t i = 0; i < object.lights.size(); ++i) placed_[first_[index] + i].places.push_back(to_world);
      for (auto i = object.instances.rbegin(); i != object.instances.rend(); ++i) open.emplace_back(&*i, to_world);
    }
  }

  const SceneDescription& description_;
  std::vector<double> lights_in_;  // of an object and all that it contains
  std::vector<size_t> first_;      // of the object's own lights in placed_
  std::vector<PlacedLight> placed_;
};

}  // namespace

std::vector<PlacedLight> place_lights(const SceneDescription& description, Diagnostics& diagnostics) {
  return LightPlacer(description).run(diagnostics);
}

}  // namespace etd
