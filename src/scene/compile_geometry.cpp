#include "scene/compile_geometry.h"

#include <fmt/format.h>

#include <map>
#include <set>

#include "scene/compile_lights.h"
#include "scene/registry.h"
#include "shapes/shape.h"

namespace etd {

namespace {

// A shape of the description under the transform to the space in which rays will meet it.
struct PlacedShape {
  const ShapeDesc* shape;
  Transform to_space;
};

// A shape of the world that is a light.
struct Emitter {
  enum class Kind { kMesh, kPatches, kQuadric };
  const ShapeDesc* shape;
  Kind kind;
  uint32_t index;  // of the mesh, patch mesh or quadric
};

class GeometryCompiler {
 public:
  GeometryCompiler(const SceneDescription& description, const std::vector<uint32_t>& material_of,
                   const TextureBuilder& textures, Scene& scene, Diagnostics& diagnostics)
      : description_(description),
        material_of_(material_of),
        textures_(textures),
        scene_(scene),
        diagnostics_(diagnostics) {}

  void run() {
    check_shapes();
    place();
    load();
    if (diagnostics_.has_errors()) return;
    measure();
    if (diagnostics_.has_errors()) return;
    const Point3d center = scene_.summary.bounds.empty() ? Point3d{} : scene_.summary.bounds.center();
    scene_.origin = {center.x, center.y, center.z};
    reserve();
    // Surfaces of invisible lights are there for sampling, in a group that nothing refers to. They come last, because a
    // group's quadrics stand in a row.
    GeometryGroup unseen;
    for (const PlacedShape& s : world_)
      if (!is_invisible(s)) add(s, scene_.origin, scene_.geometry.groups[0], true);
    for (const PlacedShape& s : world_)
      if (is_invisible(s)) add(s, scene_.origin, unseen, true);
    add_groups();
    add_lights();
  }

 private:
  // Every shape once, whether it is used or not: a mistake in an unused object is a mistake too.
  void check_shapes() {
    const auto check = [&](const ShapeDesc& s) {
      if (const ModelDecl* decl = find_model(Family::kShape, s.use.model)) check_params(*decl, s.use, diagnostics_);
      if (s.to_world.is_singular())
        diagnostics_.error(s.use.loc, fmt::format("the transform of this {} is singular", s.use.model));
      if (s.area_light >= 0 && is_interface(s))
        diagnostics_.error(s.use.loc, "a shape of material \"interface\" can't be an area light",
                           "give it a material, such as a black diffuse one");
    };
    const auto check_instance = [&](const InstanceDesc& i) {
      if (i.to_world.is_singular()) diagnostics_.error(i.loc, "the transform of this instance is singular");
    };
    for (const ShapeDesc& s : description_.shapes) check(s);
    for (const InstanceDesc& i : description_.instances) check_instance(i);
    for (const ObjectDesc& o : description_.objects) {
      for (const ShapeDesc& s : o.shapes) check(s);
      for (const InstanceDesc& i : o.instances) check_instance(i);
    }
  }

  bool is_interface(const ShapeDesc& s) const { return material_of_[static_cast<size_t>(s.material + 1)] == kNoId; }

  // Flattens: an object that one instance uses, or that holds lights, becomes world shapes; others are shared.
  void place() {
    for (const ShapeDesc& s : description_.shapes) world_.push_back({&s, s.to_world});
    std::vector<std::vector<InstanceDesc>> placed(description_.objects.size());
    for (const InstanceDesc& i : description_.instances) placed[static_cast<size_t>(i.object)].push_back(i);
    // Objects only contain earlier ones, so going backwards every placement is known before its object is reached.
    for (size_t o = description_.objects.size(); o-- > 0;) {
      const ObjectDesc& object = description_.objects[o];
      if (placed[o].size() > 1 && !emits(object)) {
        shared_.insert(shared_.end(), placed[o].begin(), placed[o].end());
        expand(object, Transform(), objects_[static_cast<int>(o)]);
        continue;
      }
      for (const InstanceDesc& outer : placed[o]) {
        for (const ShapeDesc& s : object.shapes) world_.push_back({&s, outer.to_world * s.to_world});
        for (const InstanceDesc& i : object.instances)
          placed[static_cast<size_t>(i.object)].push_back({i.object, outer.to_world * i.to_world, i.loc});
      }
    }
  }

  bool emits(const ObjectDesc& object) const {
    for (const ShapeDesc& s : object.shapes)
      if (s.area_light >= 0) return true;
    for (const InstanceDesc& i : object.instances)
      if (emits(description_.objects[static_cast<size_t>(i.object)])) return true;
    return false;
  }

  // All shapes of an object and of the objects in it.
  void expand(const ObjectDesc& object, const Transform& t, std::vector<PlacedShape>& out) const {
    for (const ShapeDesc& s : object.shapes) out.push_back({&s, t * s.to_world});
    for (const InstanceDesc& i : object.instances)
      expand(description_.objects[static_cast<size_t>(i.object)], t * i.to_world, out);
  }

  void load() {
    const auto load_one = [&](const ShapeDesc& s) {
      if (!find_model(Family::kShape, s.use.model) || is_interface(s)) return;
      if (auto geometry = make_shape(s.use, description_.folder, diagnostics_)) loaded_[&s] = std::move(*geometry);
      if (s.use.find("alpha")) load_alpha(s);
    };
    for (const ShapeDesc& s : description_.shapes) load_one(s);
    for (const ObjectDesc& o : description_.objects)
      for (const ShapeDesc& s : o.shapes) load_one(s);
  }

  void load_alpha(const ShapeDesc& s) {
    const ParamReader p(*find_model(Family::kShape, s.use.model), s.use, diagnostics_);
    const FloatSource alpha = textures_.number(p, "alpha");
    if (alpha.texture >= 0 || (alpha.value > 0 && alpha.value < 1)) alpha_[&s] = alpha;
    if (alpha.texture >= 0 || alpha.value > 0) return;
    // An area light shines all the same, but nothing meets it.
    if (s.area_light >= 0)
      invisible_.insert(&s);
    else
      loaded_.erase(&s);
  }

  bool is_invisible(const PlacedShape& s) const { return invisible_.count(s.shape) > 0; }

  // Corners of the shape in its space: vertices of meshes, or of the box around a quadric.
  void extend(Bounds3& bounds, const PlacedShape& placed) const {
    const auto it = loaded_.find(placed.shape);
    if (it == loaded_.end()) return;
    if (it->second.mesh) {
      for (const Point3d& p : it->second.mesh->positions) bounds.extend(placed.to_space.point(p));
      return;
    }
    if (it->second.patches) {
      for (const Point3d& p : it->second.patches->vertices.positions) bounds.extend(placed.to_space.point(p));
      return;
    }
    const QuadricShape& quadric = *it->second.quadric;
    const Bounds3 box = quadric_bounds(quadric.part, placed.to_space * quadric.unit_to_object);
    bounds.extend(box.lo);
    bounds.extend(box.hi);
  }

  // Bounds of the objects in their own space and of the world, not recentred. Reports what is too large for the
  // accelerator, which leaves out without a word what lies beyond 1.8e18.
  void measure() {
    for (const PlacedShape& s : world_) {
      Bounds3 b;
      extend(b, s);
      add_bounds(scene_.summary.bounds, b, s.shape->use.loc, s.shape->use.model);
    }
    for (const auto& [object, shapes] : objects_) {
      Bounds3& local = local_bounds_[object];
      for (const PlacedShape& s : shapes) {
        Bounds3 b;
        extend(b, s);
        add_bounds(local, b, s.shape->use.loc, s.shape->use.model);
      }
    }
    for (const InstanceDesc& i : shared_) {
      const Bounds3& local = local_bounds_[i.object];
      Bounds3 b;
      for (int corner = 0; !local.empty() && corner < 8; ++corner)
        b.extend(i.to_world.point({corner & 1 ? local.hi.x : local.lo.x, corner & 2 ? local.hi.y : local.lo.y,
                                   corner & 4 ? local.hi.z : local.lo.z}));
      add_bounds(scene_.summary.bounds, b, i.loc, "instance");
    }
  }

  void add_bounds(Bounds3& all, const Bounds3& b, SourceLoc loc, std::string_view what) {
    constexpr double kLimit = 1e18;
    if (b.empty()) return;
    const Vec3d lo = b.lo - Point3d{}, hi = b.hi - Point3d{};
    if (!(std::max(max_component(-lo), max_component(hi)) < kLimit))
      diagnostics_.error(loc, fmt::format("this {} is too large or too far away", what),
                         "coordinates must stay below 1e18");
    all.extend(b.lo);
    all.extend(b.hi);
  }

  // Lights and the accelerator keep pointers into these arrays, so they must not grow later.
  void reserve() {
    size_t count = world_.size();
    for (const auto& [object, shapes] : objects_) count += shapes.size();
    scene_.geometry.meshes.reserve(count);
    scene_.geometry.patch_meshes.reserve(count);
    scene_.geometry.quadrics.reserve(count);
  }

  void add(const PlacedShape& placed, Vec3d origin, GeometryGroup& group, bool in_world) {
    const auto it = loaded_.find(placed.shape);
    if (it == loaded_.end()) return;
    const Transform to_space = Transform::translate(-origin) * placed.to_space;
    SurfaceBinding binding;
    binding.material = material_of_[static_cast<size_t>(placed.shape->material + 1)];
    binding.shape = static_cast<uint32_t>(scene_.names.shapes.size());
    scene_.names.shapes.push_back(name_item(Family::kShape, placed.shape->use));
    if (const auto alpha = alpha_.find(placed.shape); alpha != alpha_.end()) {
      scene_.has_holes = binding.has_holes = true;
      binding.alpha = alpha->second;
    }
    ++scene_.summary.shapes[placed.shape->use.model];
    const bool reverse = placed.shape->reverse_orientation;
    Emitter emitter{placed.shape, Emitter::Kind::kQuadric, 0};
    if (it->second.mesh) {
      emitter = {placed.shape, Emitter::Kind::kMesh, static_cast<uint32_t>(scene_.geometry.meshes.size())};
      group.meshes.push_back(emitter.index);
      scene_.geometry.meshes.push_back(place_vertices<Mesh>(*it->second.mesh, to_space, reverse));
      scene_.geometry.meshes.back().triangles = it->second.mesh->triangles;
      scene_.mesh_bindings.push_back(binding);
      scene_.summary.triangles += scene_.geometry.meshes.back().triangles.size();
    } else if (it->second.patches) {
      emitter = {placed.shape, Emitter::Kind::kPatches, static_cast<uint32_t>(scene_.geometry.patch_meshes.size())};
      group.patch_meshes.push_back(emitter.index);
      scene_.geometry.patch_meshes.push_back(
          place_vertices<PatchMesh>(it->second.patches->vertices, to_space, reverse));
      scene_.geometry.patch_meshes.back().patches = it->second.patches->patches;
      scene_.patch_bindings.push_back(binding);
    } else {
      emitter.index = static_cast<uint32_t>(scene_.geometry.quadrics.size());
      const QuadricShape& quadric = *it->second.quadric;
      scene_.geometry.quadrics.emplace_back(to_space * quadric.unit_to_object, reverse, quadric.part);
      scene_.quadric_bindings.push_back(binding);
      ++group.quadric_end;
    }
    if (in_world && placed.shape->area_light >= 0) emitters_.push_back(emitter);
  }

  // A Mesh or PatchMesh with everything but its faces.
  template <class M>
  static M place_vertices(const MeshData& data, const Transform& t, bool reverse) {
    M mesh;
    mesh.positions.reserve(data.positions.size() + 1);  // the accelerator may read a little beyond the last vertex
    for (const Point3d& p : data.positions) mesh.positions.push_back(to_float(t.point(p)));
    mesh.normals.reserve(data.normals.size());
    for (const Vec3& n : data.normals) {
      const Vec3d m = t.normal(to_double(reverse ? -n : n));
      const double l = length(m);
      mesh.normals.push_back(l > 0 && std::isfinite(l) ? to_float(m * (1.0 / l)) : Vec3{});
    }
    mesh.uvs = data.uvs;
    mesh.flip_ng = reverse != (t.determinant3() < 0);
    return mesh;
  }

  void add_groups() {
    struct Group {
      uint32_t index;
      Transform from_group;  // to the object's space
      size_t triangles;
    };
    std::map<int, Group> group_of;
    size_t triangles_seen = scene_.summary.triangles;
    for (const auto& [object, shapes] : objects_) {
      const Bounds3& local = local_bounds_[object];
      const Vec3d origin = (local.empty() ? Point3d{} : local.center()) - Point3d{};
      GeometryGroup group;
      group.quadric_begin = group.quadric_end = static_cast<uint32_t>(scene_.geometry.quadrics.size());
      const size_t before = scene_.summary.triangles;
      for (const PlacedShape& s : shapes) add(s, origin, group, false);
      group_of[object] = {static_cast<uint32_t>(scene_.geometry.groups.size()), Transform::translate(origin),
                          scene_.summary.triangles - before};
      scene_.geometry.groups.push_back(std::move(group));
    }
    for (const InstanceDesc& i : shared_) {
      const Group& group = group_of[i.object];
      const Transform t = Transform::translate(-scene_.origin) * i.to_world * group.from_group;
      scene_.geometry.instances.push_back({group.index, Affine(t.matrix()), Affine(t.inverse_matrix())});
      triangles_seen += group.triangles;
    }
    scene_.summary.instanced_triangles = triangles_seen;
  }

  void add_lights() {
    AreaLightCompiler lights(description_.folder, scene_, diagnostics_);
    for (const Emitter& e : emitters_) {
      const ModelUse& use = description_.area_lights[static_cast<size_t>(e.shape->area_light)];
      const size_t first = scene_.lights.size();
      const bool invisible = invisible_.count(e.shape) > 0;
      if (e.kind == Emitter::Kind::kMesh) lights.add_mesh(use, e.index, invisible);
      if (e.kind == Emitter::Kind::kPatches) lights.add_patches(use, e.index, invisible);
      if (e.kind == Emitter::Kind::kQuadric) lights.add_quadric(use, e.index, invisible);
      scene_.names.lights.resize(scene_.lights.size(), {"area light", use.loc});
      const auto alpha = alpha_.find(e.shape);
      if (alpha == alpha_.end()) continue;
      scene_.light_alphas.resize(first, {1.0f, -1});
      scene_.light_alphas.resize(scene_.lights.size(), alpha->second);
    }
  }

  const SceneDescription& description_;
  const std::vector<uint32_t>& material_of_;
  const TextureBuilder& textures_;
  Scene& scene_;
  Diagnostics& diagnostics_;
  std::vector<PlacedShape> world_;
  std::vector<InstanceDesc> shared_;                 // all that stay instances
  std::map<int, std::vector<PlacedShape>> objects_;  // the objects of those, expanded
  std::map<int, Bounds3> local_bounds_;
  std::map<const ShapeDesc*, ShapeGeometry> loaded_;
  std::map<const ShapeDesc*, FloatSource> alpha_;  // of those that have holes
  std::set<const ShapeDesc*> invisible_;           // lights of alpha 0
  std::vector<Emitter> emitters_;
};

}  // namespace

void compile_geometry(const SceneDescription& description, const std::vector<uint32_t>& material_of,
                      const TextureBuilder& textures, Scene& scene, Diagnostics& diagnostics) {
  GeometryCompiler(description, material_of, textures, scene, diagnostics).run();
}

}  // namespace etd
