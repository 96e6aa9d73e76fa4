#include "scene/compile_lights.h"

#include <fmt/format.h>

#include <algorithm>

#include "lights/area_light.h"
#include "scene/check_transform.h"
#include "scene/place_lights.h"
#include "scene/registry.h"

namespace etd {

namespace {

// The surfaces of an emitting mesh, and which of them each triangle belongs to.
struct MeshSurfaces {
  ShapeSurfaces all;
  std::vector<uint32_t> of_triangle;

  MeshSurfaces(const Mesh& mesh, LightData& data) {
    const auto count = static_cast<uint32_t>(mesh.triangles.size());
    std::vector<bool> in_rectangle;
    for (uint32_t t = 0; t < count; ++t) {
      if (const auto r = LightRectangle::find(mesh, t)) {
        of_triangle.insert(of_triangle.end(), 2, static_cast<uint32_t>(all.rectangles.size()));
        in_rectangle.insert(in_rectangle.end(), 2, true);
        all.rectangles.emplace_back(data.rectangles.emplace_back(*r));
        ++t;
      } else {
        of_triangle.push_back(static_cast<uint32_t>(all.triangles.size()));
        in_rectangle.push_back(false);
        all.triangles.emplace_back(mesh, t);
      }
    }
    for (uint32_t t = 0; t < count; ++t)
      if (!in_rectangle[t]) of_triangle[t] += static_cast<uint32_t>(all.rectangles.size());
  }
  bool has_area() const {
    return !all.rectangles.empty() ||
           std::any_of(all.triangles.begin(), all.triangles.end(), [](const auto& t) { return t.area() > 0; });
  }
};

// A light of infinite power could not be chosen by its power, and would be dark.
void check_power(const Spectrum& power, const ModelUse& use, Diagnostics& diagnostics) {
  if (is_finite(power)) return;
  diagnostics.error(use.loc,
                    fmt::format("the power of this {} light is beyond the largest number, 3.4e38 W", use.model),
                    "scale the light of the scene down; \"iso\" of the film can scale the picture up again");
}

}  // namespace

uint32_t AreaLightCompiler::add(const ModelUse& use, const ShapeSurfaces& surfaces, bool invisible) {
  const auto first = static_cast<uint32_t>(scene_.lights.size());
  const AreaLights made = make_area_lights(use, {surfaces, images_, scene_.light_data, invisible}, diagnostics_);
  check_power(made.power, use, diagnostics_);
  scene_.lights.insert(scene_.lights.end(), made.lights.begin(), made.lights.end());
  ++info_.summary.lights[use.model + " area light"];
  return first;
}

void AreaLightCompiler::add_mesh(const ModelUse& use, uint32_t index, bool invisible) {
  const MeshSurfaces surfaces(scene_.geometry.meshes[index], scene_.light_data);
  if (!surfaces.has_area())
    diagnostics_.warning(use.loc, "an area light on a mesh without an area gives no light",
                         "its triangles are missing, or flat as lines");
  const uint32_t first = add(use, surfaces.all, invisible);
  scene_.mesh_bindings[index].first_light = static_cast<uint32_t>(scene_.face_lights.size());
  for (const uint32_t surface : surfaces.of_triangle) scene_.face_lights.push_back(first + surface);
}

void AreaLightCompiler::add_patches(const ModelUse& use, uint32_t index, bool invisible) {
  const PatchMesh& mesh = scene_.geometry.patch_meshes[index];
  const auto count = static_cast<uint32_t>(mesh.patches.size());
  ShapeSurfaces surfaces;
  for (uint32_t i = 0; i < count; ++i) surfaces.patches.emplace_back(mesh, i);
  const uint32_t first = add(use, surfaces, invisible);
  scene_.patch_bindings[index].first_light = static_cast<uint32_t>(scene_.face_lights.size());
  for (uint32_t i = 0; i < count; ++i) scene_.face_lights.push_back(first + i);
}

void AreaLightCompiler::add_quadric(const ModelUse& use, uint32_t index, bool invisible) {
  const ShapeSurfaces surfaces{.quadrics = {QuadricSurface(scene_.geometry.quadrics[index])}};
  scene_.quadric_bindings[index].first_light = add(use, surfaces, invisible);
}

namespace {

// A light that moves is made in a space of its own, which turns and translates.
std::optional<Light> make_moving_light(const ModelUse& use, const TransformPath& to_world, const ImageSource& images,
                                       Scene& scene, Diagnostics& diagnostics) {
  const Transform size = TransformParts::of(to_world.at(0).matrix()).rest();
  const TransformPath path = TransformPath().then(Transform::translate(-scene.origin)).then(to_world);
  const AnimatedTransform& motion = scene.light_data.motions.emplace_back(path.then(size.inverse()), Vec3d{}, 1.0);
  if (!motion.is_rigid())
    diagnostics.error(use.loc, fmt::format("this {} light changes its size while it moves", use.model),
                      "lights that are no shapes can only be translated and turned");
  if (const Param* portal = use.find("portal")) {
    diagnostics.error(portal->loc, "a light behind a portal can't move",
                      "the portal is in the world, not on the light");
    return {};
  }
  const auto light = make_light(use, {size, images, scene.light_data, {}}, diagnostics);
  scene.moves = true;
  return light ? std::optional(light->moving(motion)) : std::nullopt;
}

// The light in one of its places.
void add_light(const LightDesc& desc, const TransformPath& place, const ImageSource& images, Scene& scene,
               SceneInfo& info, Diagnostics& diagnostics) {
  const TransformPath to_world = place.then(desc.to_world);
  const Transform from_world = Transform::translate(-scene.origin) * place.at(0);
  const auto light =
      to_world.moves()
          ? make_moving_light(desc.use, to_world, images, scene, diagnostics)
          : make_light(desc.use, {from_world * desc.to_world.start, images, scene.light_data, from_world}, diagnostics);
  if (!light) return;
  check_power(light->power(), desc.use, diagnostics);
  if (light->is_infinite() && !light->is_delta())
    scene.infinite_lights.push_back(static_cast<uint32_t>(scene.lights.size()));
  scene.lights.push_back(*light);
  info.names.lights.push_back(name_item(Family::kLight, desc.use));
  ++info.summary.lights[desc.use.model];
}

// What users of pbrt-v4 may not expect of lights in objects.
void explain_places(const PlacedLight& placed, const Light* light, Diagnostics& diagnostics) {
  const ModelUse& use = placed.light->use;
  if (placed.places.empty())
    diagnostics.note(use.loc, fmt::format("a {} light shines nowhere, because its object has no instance", use.model));
  else if (light && light->is_infinite() && placed.places.size() > 1)
    diagnostics.note(use.loc, fmt::format("a light from infinitely far away shines {} times, once for each instance of "
                                          "its object",
                                          placed.places.size()));
}

}  // namespace

void compile_lights(const SceneDescription& description, Scene& scene, SceneInfo& info, Diagnostics& diagnostics) {
  for (const PlacedLight& placed : place_lights(description, diagnostics)) {
    const LightDesc& desc = *placed.light;
    if (const ModelDecl* decl = find_model(Family::kLight, desc.use.model)) check_params(*decl, desc.use, diagnostics);
    if (!check_transform(desc.to_world, desc.use.loc, "light", diagnostics)) continue;
    const size_t first = scene.lights.size();
    for (const TransformPath& place : placed.places)
      add_light(desc, place, description.image_source(), scene, info, diagnostics);
    explain_places(placed, first < scene.lights.size() ? &scene.lights[first] : nullptr, diagnostics);
    if (!placed.places.empty()) continue;
    LightData unused;  // a mistake in an object without an instance is a mistake too
    make_light(desc.use, {desc.to_world.start, description.image_source(), unused, {}}, diagnostics);
  }
}

}  // namespace etd
