#include "render/path_names.h"

#include <fmt/format.h>

namespace etd {
namespace {

PathItem item_at(const ReplayedScene& in, const std::vector<SceneNames::Item>& items, size_t index,
                 std::string_view otherwise) {
  PathItem item{std::string(otherwise), {}, {}};
  if (index >= items.size()) return item;
  const auto& [model, loc] = items[index];
  if (!model.empty()) item.model = model;
  if (loc.file >= 0) item.place = fmt::format("{}:{}", in.sources.name(loc.file), loc.line);
  return item;
}

}  // namespace

const char* component_name(int depth) { return depth == 0 ? "emission" : depth == 1 ? "direct" : "indirect"; }

const char* end_text(PathEnd end) {
  switch (end) {
    case PathEnd::kEscaped:
      return "it met no surface";
    case PathEnd::kDepth:
      return "no more scattering events are allowed";
    case PathEnd::kAbsorbed:
      return "the surface scattered it nowhere";
    case PathEnd::kRoulette:
      return "Russian roulette";
    case PathEnd::kLeftOut:
      return "what it would have found is not to be rendered";
  }
  return "";
}

std::string lobe_text(Lobe lobe) {
  return fmt::format("{} {}",
                     (lobe & kDelta)    ? "delta"
                     : (lobe & kGlossy) ? "glossy"
                                        : "diffuse",
                     (lobe & kTransmission) ? "transmission" : "reflection");
}

PathItem shape_item(const ReplayedScene& in, const Hit& hit) {
  return item_at(in, in.names.shapes, in.scene.binding_of(hit).shape, "surface");
}

PathItem light_item(const ReplayedScene& in, uint32_t light) { return item_at(in, in.names.lights, light, "light"); }

PathItem material_item(const ReplayedScene& in, const Material* material) {
  if (!material) return {"material", {}, {}};
  const auto index = static_cast<size_t>(material - in.scene.materials.data());
  PathItem item = item_at(in, in.names.materials, index, "material");
  if (index < in.names.material_names.size()) item.name = in.names.material_names[index];
  return item;
}

Point3d file_position(const ReplayedScene& in, Point3 p) { return to_double(p) + in.scene.origin; }

}  // namespace etd
