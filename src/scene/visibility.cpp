#include "scene/visibility.h"

#include <algorithm>
#include <set>

#include "core/hash.h"

namespace etd {

namespace {

// Whether `is(closure)` holds at some of the places where the surface is looked at: textures may differ from one to the
// next.
template <class F>
bool somewhere(const Material& material, const Scene& scene, F&& is) {
  constexpr int kPlaces = 64;
  HashStream rng(1);
  for (int i = 0; i < kPlaces; ++i) {
    TexCoord at;
    const float range = i % 2 == 0 ? 1.0f : 16.0f;  // within a texture, and over repeated ones
    at.uv = {range * rng.next_float(), range * rng.next_float()};
    at.p = {range * rng.next_float(), range * rng.next_float(), range * rng.next_float()};
    at.n = {0, 0, 1};
    if (is(material.closure(at, scene.textures, {}))) return true;
  }
  return false;
}

// Every material of a surface, with those that mixes choose from.
std::set<uint32_t> used_materials(const Scene& scene) {
  std::set<uint32_t> used;
  for (const auto* bindings : {&scene.mesh_bindings, &scene.patch_bindings, &scene.quadric_bindings})
    for (const SurfaceBinding& b : *bindings) used.insert(b.material);
  std::vector<uint32_t> open(used.begin(), used.end());
  while (!open.empty()) {
    const uint32_t material = open.back();
    open.pop_back();
    for (const uint32_t child : scene.materials[material].children())
      if (used.insert(child).second) open.push_back(child);
  }
  return used;
}

}  // namespace

bool has_mirrors(const Scene& scene) {
  for (const uint32_t material : used_materials(scene))
    if (scene.materials[material].children().empty() &&
        somewhere(scene.materials[material], scene, [](const Bsdf& bsdf) { return (bsdf.lobes() & kDelta) != 0; }))
      return true;
  return false;
}

void warn_if_nothing_shows(const Scene& scene, const SceneNames& names, Diagnostics& diagnostics) {
  const auto is_point = [](const Light& light) { return light.is_delta(); };
  if (scene.lights.empty() || !std::all_of(scene.lights.begin(), scene.lights.end(), is_point)) return;
  const std::set<uint32_t> used = used_materials(scene);
  if (used.empty()) return;
  for (const uint32_t material : used)
    if (scene.materials[material].children().empty() &&
        somewhere(scene.materials[material], scene, [](const Bsdf& bsdf) { return bsdf.has_smooth_lobe(); }))
      return;
  diagnostics.warning(
      names.materials[*used.begin()].loc,
      "nothing can be seen: every surface is perfectly smooth, and all light comes from points or single "
      "directions, which no mirror shows",
      "a \"roughness\" above 0 shows highlights, and area lights or an infinite light show mirrors");
}

}  // namespace etd
