#include "scene/compile.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "cameras/shutter.h"
#include "core/freed_memory.h"
#include "scene/check_precision.h"
#include "scene/check_transform.h"
#include "scene/compile_geometry.h"
#include "scene/compile_lights.h"
#include "scene/nesting.h"
#include "scene/registry.h"
#include "scene/seen.h"
#include "scene/visibility.h"

namespace etd {

namespace {

void check(Family family, const ModelUse& use, Diagnostics& diagnostics) {
  if (const ModelDecl* decl = find_model(family, use.model)) check_params(*decl, use, diagnostics);
}

// Builds textures after the textures they refer to, and rejects cycles and what would take too long to look up: two
// references to one texture, forty times in a row, are a million million lookups.
class TextureOrder {
 public:
  TextureOrder(const SceneDescription& description, TextureBuilder& builder, Diagnostics& diagnostics)
      : description_(description), builder_(builder), diagnostics_(diagnostics), built_(description.textures.size()) {
    for (size_t i = 0; i < description.textures.size(); ++i)
      names_[{description.textures[i].name, description.textures[i].is_float}] = i;
    for (size_t i = 0; i < description.textures.size(); ++i) build(i, 1);
  }

 private:
  enum class State { kNew, kBuilding, kBuilt };
  struct Built {
    State state = State::kNew;
    uint64_t levels = 1, lookups = 1;  // with those of the textures it refers to
  };

  // A texture that `depth` - 1 others wait for.
  void build(size_t i, uint64_t depth) {
    const TextureDesc& t = description_.textures[i];
    Built& built = built_[i];
    if (built.state == State::kBuilt) return;
    if (built.state == State::kBuilding) return replace(i, fmt::format("texture \"{}\" refers to itself", t.name), {});
    if (depth > diagnostics_.limits().nesting) return too_deep(i);
    built.state = State::kBuilding;
    check(Family::kTexture, t.use, diagnostics_);
    const ModelDecl* decl = find_model(Family::kTexture, t.use.model);
    for (const Param& p : t.use.params) {
      const ParamDecl* declared = decl ? decl->find(p.name) : nullptr;
      if (!declared || p.kind != ParamKind::kTexture || p.strings.empty()) continue;
      const bool is_float = t.is_float || declared->type == ParamType::kFloatTexture;
      const auto it = names_.find({p.strings[0], is_float});
      if (it == names_.end()) continue;
      build(it->second, depth + 1);
      built.levels = std::max(built.levels, built_[it->second].levels + 1);
      built.lookups += built_[it->second].lookups;
    }
    built.state = State::kBuilt;
    if (built.levels > diagnostics_.limits().nesting) return too_deep(i);
    if (built.lookups > diagnostics_.limits().lookups)
      return replace(i, fmt::format("a lookup of texture \"{}\" asks {} textures", t.name, built.lookups),
                     limit_text(diagnostics_.limits(), &Limits::lookups));
    builder_.add(t.name, t.is_float, t.use, t.to_world, diagnostics_);
  }

  void too_deep(size_t i) {
    const TextureDesc& t = description_.textures[i];
    report_nesting(t.use.loc, fmt::format("texture \"{}\"", t.name), diagnostics_);
    replace(i, {}, {});
  }

  // A stand-in after an error, so that it is not reported as missing too.
  void replace(size_t i, const std::string& problem, const std::string& hint) {
    const TextureDesc& t = description_.textures[i];
    if (!problem.empty()) diagnostics_.error(t.use.loc, problem, hint);
    builder_.add(t.name, t.is_float, {"constant", {}, t.use.loc}, t.to_world, diagnostics_);
    if (built_[i].state != State::kBuilding) built_[i] = {State::kBuilt, 1, 1};
  }

  const SceneDescription& description_;
  TextureBuilder& builder_;
  Diagnostics& diagnostics_;
  std::vector<Built> built_;
  std::map<std::pair<std::string, bool>, size_t> names_;
};

// Materials that are mixed of others.
class MaterialMixes {
 public:
  // `uses`: those of the scene's materials. Reports what is mixed of itself or of too many levels.
  MaterialMixes(const Scene& scene, const std::vector<const ModelUse*>& uses, Diagnostics& diagnostics)
      : scene_(scene), uses_(uses), diagnostics_(diagnostics), levels_(uses.size(), kNew) {
    for (uint32_t i = 0; i < uses.size(); ++i) visit(i, 1);
  }

 private:
  static constexpr uint64_t kNew = 0, kAbove = std::numeric_limits<uint64_t>::max();

  // A material that `depth` - 1 others wait for.
  void visit(uint32_t index, uint64_t depth) {
    if (levels_[index] != kNew) return;
    levels_[index] = kAbove;
    uint64_t levels = depth;
    if (depth <= diagnostics_.limits().nesting) {
      levels = 1;
      for (const uint32_t child : scene_.materials[index].children()) {
        if (levels_[child] == kAbove)
          diagnostics_.error(uses_[index]->loc, "a mix of materials refers to itself");
        else
          visit(child, depth + 1), levels = std::max(levels, levels_[child] + 1);
      }
    }
    const bool too_deep = levels > diagnostics_.limits().nesting;
    if (too_deep) report_nesting(uses_[index]->loc, "this mix of materials", diagnostics_);
    levels_[index] = too_deep ? 1 : levels;
  }

  const Scene& scene_;
  const std::vector<const ModelUse*>& uses_;
  Diagnostics& diagnostics_;
  std::vector<uint64_t> levels_;
};

// Indices of the description's materials in the scene; material 0 is the default one.
std::vector<uint32_t> compile_materials(const SceneDescription& description, TextureBuilder& textures, Scene& scene,
                                        SceneInfo& info, Diagnostics& diagnostics) {
  static const ModelUse kDefault{"diffuse", {}, {}};
  std::vector<uint32_t> material_of{0};
  std::vector<const ModelUse*> uses{&kDefault};
  info.names.material_names.emplace_back();
  MaterialNames names;
  for (const MaterialDesc& m : description.materials) {
    const bool is_surface = m.use.model != "interface";
    material_of.push_back(is_surface ? static_cast<uint32_t>(uses.size()) : kNoId);
    if (!m.name.empty()) names[m.name] = is_surface ? std::optional(material_of.back()) : std::nullopt;
    if (is_surface) {
      uses.push_back(&m.use);
      info.names.material_names.push_back(m.name);
    }
    check(Family::kMaterial, m.use, diagnostics);
    ++info.summary.materials[m.use.model];
  }
  for (const ModelUse* use : uses) {
    scene.materials.push_back(*make_material(*use, textures, scene.material_data, diagnostics, names));
    info.names.materials.push_back(name_item(Family::kMaterial, *use));
  }
  const MaterialMixes check_mixes(scene, uses, diagnostics);
  return material_of;
}

// A camera that moves is made in a space of its own, in which it has the size that it has at the start, and carried
// from there.
void compile_camera(const SceneDescription& description, const CompileOptions& options, Scene& scene,
                    Diagnostics& diagnostics) {
  const TransformPair& to_world = description.camera_to_world;
  const bool has_place = check_transform(to_world, description.camera.loc, "camera", diagnostics);
  const Transform recentre = Transform::translate(-scene.origin);
  const Transform size = TransformParts::of(to_world.start.matrix()).rest();
  const bool moves = to_world.is_moving();
  scene.camera =
      make_camera(description.camera,
                  {moves ? size : recentre * to_world.start, options.width, options.height, description.image_source()},
                  scene.camera_data, diagnostics);
  const ModelDecl* decl = find_model(Family::kCamera, description.camera.model);
  if (!decl || !has_place) return;
  const Shutter shutter = read_shutter({*decl, description.camera, diagnostics});
  std::optional<AnimatedTransform> motion;
  if (moves) motion.emplace(TransformPath().then(recentre).then(to_world).then(size.inverse()), Vec3d{}, 1.0);
  scene.moves |= moves;
  scene.camera.set_motion(shutter.within(description.motion_start, description.motion_end), std::move(motion));
}

// The images of textures, read now or before.
void load_images(const CompileOptions& options, TextureBuilder& textures, SceneFiles& files, Scene& scene,
                 Diagnostics& diagnostics) {
  TextureTable& table = scene.textures;
  if (files.images) {
    table.images = files.images->images;
    table.cache = files.images->cache;
    table.cache_limit = files.images->cache_limit;
    return;
  }
  textures.load_images(options.textures, diagnostics);
  if (!options.files || diagnostics.has_errors()) return;
  files.images.emplace();
  files.images->images = table.images;
  files.images->cache = table.cache;
  files.images->cache_limit = table.cache_limit;
}

// Around the box of the scene, recentred, with room for rounding.
BoundingSphere bounding_sphere(const Bounds3& box, Vec3d origin) {
  if (box.empty()) return {{}, 1.0f};
  constexpr double kRoom = 1.0 + 1e-5;
  const double radius = 0.5 * length(box.diagonal()) * kRoom;
  return {to_float(box.center() - origin), std::max(static_cast<float>(radius), 1e-30f)};
}

}  // namespace

CompiledScene compile(const SceneDescription& description, const CompileOptions& options, Diagnostics& diagnostics) {
  if (!check_object_nesting(description, diagnostics)) return {};
  const auto scene = std::make_shared<Scene>();
  const auto info = std::make_shared<SceneInfo>();
  SceneFiles own, &files = options.files ? *options.files : own;
  if (options.files) scene->light_data.kept = &files.light_images;
  TextureBuilder textures(scene->textures, description.folder, description.images);
  const TextureOrder build_textures(description, textures, diagnostics);
  for (const TextureDesc& t : description.textures) ++info->summary.textures[t.use.model];
  const std::vector<uint32_t> material_of = compile_materials(description, textures, *scene, *info, diagnostics);
  for (const ModelUse& use : description.area_lights) check(Family::kAreaLight, use, diagnostics);
  const Viewpoint view = viewpoint_of(description, options);
  compile_geometry(description, view, material_of, textures, files, *scene, *info, diagnostics, options.monitor);
  textures.recentre(scene->origin);
  load_images(options, textures, files, *scene, diagnostics);

  compile_lights(description, *scene, *info, diagnostics);

  check(Family::kCamera, description.camera, diagnostics);
  check(Family::kFilter, description.filter, diagnostics);
  compile_camera(description, options, *scene, diagnostics);
  scene->filter = make_filter(description.filter, diagnostics);
  if (description.filter_textures)
    scene->footprint =
        PixelFootprint(scene->camera, options.width, options.height, PixelFootprint::scale_for(options.spp));
  if (diagnostics.has_errors()) return {};

  warn_if_nothing_shows(*scene, info->names, diagnostics);
  scene->light_data.kept = nullptr;
  scene->viewer = to_float(view.position - scene->origin);
  scene->light_sampler = make_light_sampler(LightSampler().name(), {scene->lights, scene->viewer});
  own = {};  // the meshes of files are in the scene by now, and building takes memory
  return_freed_memory();
  scene->accelerator = std::make_unique<Accelerator>(scene->geometry, options.monitor);
  scene->seen = seen_by_camera(*scene, options.width, options.height);
  scene->emission_disks = EmissionDisks(bounding_sphere(info->summary.bounds, scene->origin), scene->seen);
  check_precision(*scene, info->names, options.width, options.height, diagnostics);
  return {scene, info};
}

}  // namespace etd
