#include "formats/pbrt/names.h"

#include <fmt/format.h>

namespace etd::pbrt {

namespace {

std::string place(const Diagnostics& diagnostics, const SourceLoc& loc) {
  return fmt::format("{}:{}", diagnostics.sources().name(loc.file), loc.line);
}

void report_redefined(std::string_view what, const std::string& name, const SourceLoc& loc, const SourceLoc& first,
                      Diagnostics& diagnostics) {
  diagnostics.error(loc, fmt::format("{} \"{}\" is defined twice", what, name),
                    "first defined at " + place(diagnostics, first));
}

template <class Map>
void report_undefined(std::string_view what, const std::string& name, const SourceLoc& loc, const Map& defined,
                      Diagnostics& diagnostics) {
  diagnostics.error(loc, fmt::format("{} \"{}\" is not defined", what, name), [&] {
    std::vector<std::string_view> names;
    for (const auto& entry : defined) names.push_back(entry.first);
    const std::string_view near = nearest_name(name, names);
    return near.empty() ? std::string() : fmt::format("did you mean \"{}\"?", near);
  });
}

}  // namespace

int Names::use_material(const std::string& name, const SourceLoc& loc, SceneDescription& scene) {
  Material& m = materials_[name];
  if (m.index < 0) {
    m.index = static_cast<int>(scene.materials.size());
    m.used = loc;
    scene.materials.push_back({name, {"diffuse", {}, loc}});
  }
  return m.index;
}

void Names::define_material(const std::string& name, ModelUse use, const SourceLoc& loc, SceneDescription& scene,
                            Diagnostics& diagnostics) {
  const int index = use_material(name, loc, scene);
  Material& m = materials_[name];
  if (m.defined.file >= 0) return report_redefined("material", name, loc, m.defined, diagnostics);
  m.defined = loc;
  scene.materials[static_cast<size_t>(index)].use = std::move(use);
}

bool Names::define_texture(const std::string& name, bool is_float, const SourceLoc& loc, Diagnostics& diagnostics) {
  const auto [entry, is_new] = textures_[is_float].emplace(name, loc);
  if (!is_new) report_redefined(is_float ? "float texture" : "spectrum texture", name, loc, entry->second, diagnostics);
  return is_new;
}

bool Names::define_object(const std::string& name, int index, const SourceLoc& loc, Diagnostics& diagnostics) {
  const auto [entry, is_new] = objects_.emplace(name, Object{index, loc});
  if (!is_new) report_redefined("object", name, loc, entry->second.defined, diagnostics);
  return is_new;
}

void Names::use_object(const std::string& name, const SourceLoc& loc, const TransformPair& to_world,
                       int inside_object) {
  object_uses_.push_back({name, loc, to_world, inside_object});
}

void Names::define_medium(const std::string& name, const SourceLoc& loc, Diagnostics& diagnostics) {
  const auto [entry, is_new] = media_.emplace(name, loc);
  if (!is_new) report_redefined("medium", name, loc, entry->second, diagnostics);
}

void Names::resolve(SceneDescription& scene, Diagnostics& diagnostics) const {
  resolve_materials(diagnostics);
  resolve_objects(scene, diagnostics);
  for (const Use& use : medium_uses_)
    if (!media_.count(use.name)) report_undefined("medium", use.name, use.loc, media_, diagnostics);
}

void Names::resolve_materials(Diagnostics& diagnostics) const {
  std::map<std::string, SourceLoc> defined;
  for (const auto& [name, m] : materials_)
    if (m.defined.file >= 0) defined.emplace(name, m.defined);
  for (const auto& [name, m] : materials_)
    if (m.defined.file < 0) report_undefined("material", name, m.used, defined, diagnostics);
}

void Names::resolve_objects(SceneDescription& scene, Diagnostics& diagnostics) const {
  for (const ObjectUse& use : object_uses_) {
    const auto object = objects_.find(use.name);
    if (object == objects_.end()) {
      report_undefined("object", use.name, use.loc, objects_, diagnostics);
      continue;
    }
    const InstanceDesc instance{object->second.index, use.to_world, use.loc};
    if (use.inside_object < 0) {
      scene.instances.push_back(instance);
    } else if (instance.object < use.inside_object) {
      scene.objects[static_cast<size_t>(use.inside_object)].instances.push_back(instance);
    } else {
      diagnostics.error(use.loc, fmt::format("object \"{}\" is not complete here", use.name),
                        "an object can only contain instances of objects that end before it begins");
    }
  }
}

}  // namespace etd::pbrt
