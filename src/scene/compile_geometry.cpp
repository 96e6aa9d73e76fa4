#include "scene/compile_geometry.h"

#include <fmt/format.h>

#include <map>
#include <set>

#include "scene/check_transform.h"
#include "scene/compile_lights.h"
#include "scene/place.h"
#include "scene/place_vertices.h"
#include "scene/registry.h"
#include "shapes/cut_triangles.h"
#include "shapes/shape.h"
#include "shapes/triangle.h"

namespace etd {

namespace {

constexpr int kMoments = 17;  // at which bounds of what moves are taken
// Edges that much longer than the distance are met two thousandths of it off (shapes/cut_triangles.h): pixels.
constexpr double kLongestUncut = 4096;

// A shape that is a light.
struct Emitter {
  enum class Kind { kMesh, kPatches, kQuadric };
  const ShapeDesc* shape;
  Kind kind;
  uint32_t index;                             // of the mesh, patch mesh or quadric
  const AnimatedTransform* motion = nullptr;  // of its space; null: that is the world
};

// A space of which rays meet the shapes, as its coordinates are in the description.
struct Space {
  Vec3d origin;    // that becomes 0, before coordinates round to float
  Point3d viewer;  // where the camera is
};

class GeometryCompiler {
 public:
  GeometryCompiler(const SceneDescription& description, const Viewpoint& view, const std::vector<uint32_t>& material_of,
                   const TextureBuilder& textures, SceneFiles& files, Scene& scene, SceneInfo& info,
                   Diagnostics& diagnostics, const LoadMonitor& monitor)
      : description_(description),
        view_(view),
        material_of_(material_of),
        textures_(textures),
        loaded_(files.shapes),
        mesh_files_(files.meshes),
        scene_(scene),
        info_(info),
        diagnostics_(diagnostics),
        monitor_(monitor) {}

  void run() {
    check_shapes();
    load();
    if (diagnostics_.has_errors()) return;
    placed_ = place_shapes(description_, diagnostics_);
    if (diagnostics_.has_errors()) return;
    measure();
    if (diagnostics_.has_errors()) return;
    scene_.origin = info_.summary.bounds.nearest(view_.position) - Point3d{};
    info_.names.objects = std::move(placed_.objects);
    add_all(placed_.world, {scene_.origin, view_.position}, scene_.geometry.groups[0], true);
    add_groups();
    add_lights();  // which point into the arrays of shapes: these are complete now
  }

 private:
  // Every shape once, whether it is used or not: a mistake in an unused object is a mistake too.
  void check_shapes() {
    const auto check = [&](const ShapeDesc& s) {
      const ModelDecl* decl = s.mesh ? &read_mesh_decl() : find_model(Family::kShape, s.use.model);
      if (decl) check_params(*decl, s.use, diagnostics_);
      check_transform(s.to_world, s.use.loc, s.use.model, diagnostics_);
      if (s.area_light >= 0 && is_interface(s))
        diagnostics_.error(s.use.loc, "a shape of material \"interface\" can't be an area light",
                           "give it a material, such as a black diffuse one");
    };
    const auto check_instance = [&](const InstanceDesc& i) {
      check_transform(i.to_world, i.loc, "instance", diagnostics_);
    };
    for (const ShapeDesc& s : description_.shapes) check(s);
    for (const InstanceDesc& i : description_.instances) check_instance(i);
    for (const ObjectDesc& o : description_.objects) {
      for (const ShapeDesc& s : o.shapes) check(s);
      for (const InstanceDesc& i : o.instances) check_instance(i);
    }
  }

  bool is_interface(const ShapeDesc& s) const { return material_of_[static_cast<size_t>(s.material + 1)] == kNoId; }

  void load() {
    const auto for_each = [&](const auto& f) {
      const auto visit = [&](const ShapeDesc& s) {
        if (find_model(Family::kShape, s.use.model) && !is_interface(s)) f(s);
      };
      for (const ShapeDesc& s : description_.shapes) visit(s);
      for (const ObjectDesc& o : description_.objects)
        for (const ShapeDesc& s : o.shapes) visit(s);
    };
    // All threads read files; what is said of them comes in the order of the shapes.
    std::vector<const ModelUse*> uses;
    for_each([&](const ShapeDesc& s) {
      if (!s.mesh && loaded_.count(&s) == 0) uses.push_back(&s.use);
    });
    mesh_files_.read(uses, description_.folder, diagnostics_.limits(), monitor_);
    for_each([&](const ShapeDesc& s) {
      if (loaded_.count(&s) == 0) read(s);
      if (s.use.find("alpha")) load_alpha(s);
    });
  }

  void read(const ShapeDesc& s) {
    if (s.mesh) {
      loaded_[&s].mesh = s.mesh;
      return;
    }
    auto geometry = make_shape(s.use, description_.folder, mesh_files_, diagnostics_);
    if (!geometry) return;
    if (s.area_light >= 0 && geometry->mesh && geometry->mesh->motion_steps > 1)
      diagnostics_.error(s.use.loc, "an area light can't be on a mesh that deforms",
                         "\"motionsteps\" is for meshes that do not emit; ActiveTransform moves any shape");
    loaded_[&s] = std::move(*geometry);
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
    for (const PlacedShape& s : placed_.world) {
      Bounds3 b;
      extend(b, s);
      add_bounds(info_.summary.bounds, b, s.shape->use.loc, s.shape->use.model);
    }
    for (const ShapeGroup& group : placed_.groups) {
      Bounds3& local = group_bounds_.emplace_back();
      for (const PlacedShape& s : group.shapes) {
        Bounds3 b;
        extend(b, s);
        add_bounds(local, b, s.shape->use.loc, s.shape->use.model);
      }
      for (const PlacedGroup& i : group.instances)
        add_bounds(info_.summary.bounds, instance_bounds(i.to_world, local), i.loc, "instance");
    }
  }

  // What moves is bounded at some moments.
  static Bounds3 instance_bounds(const TransformPath& path, const Bounds3& local) {
    Bounds3 b;
    const int moments = path.moves() ? kMoments : 1;
    for (int i = 0; i < moments && !local.empty(); ++i) {
      const Transform t = path.at(moments > 1 ? static_cast<double>(i) / (moments - 1) : 0.0);
      for (int corner = 0; corner < 8; ++corner)
        b.extend(t.point({corner & 1 ? local.hi.x : local.lo.x, corner & 2 ? local.hi.y : local.lo.y,
                          corner & 4 ? local.hi.z : local.lo.z}));
    }
    return b;
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

  // `may_emit`: the group is in one place alone. Surfaces of invisible lights are there for sampling, in a group that
  // nothing refers to; they come last, because a group's quadrics stand in a row.
  void add_all(const std::vector<PlacedShape>& shapes, const Space& space, GeometryGroup& group, bool may_emit) {
    GeometryGroup unseen;
    for (const PlacedShape& s : shapes)
      if (!is_invisible(s)) add(s, space, group, may_emit);
    for (const PlacedShape& s : shapes)
      if (is_invisible(s)) add(s, space, unseen, may_emit);
  }

  void add(const PlacedShape& placed, const Space& space, GeometryGroup& group, bool may_emit) {
    const auto it = loaded_.find(placed.shape);
    if (it == loaded_.end()) return;
    const Transform to_space = Transform::translate(-space.origin) * placed.to_space;
    const Point3d viewer = space.viewer - space.origin;
    SurfaceBinding binding;
    binding.material = material_of_[static_cast<size_t>(placed.shape->material + 1)];
    binding.shape = static_cast<uint32_t>(info_.names.shapes.size());
    info_.names.shapes.push_back(name_item(Family::kShape, placed.shape->use));
    if (placed.object >= 0) binding.object = static_cast<uint32_t>(placed.object);
    if (const auto alpha = alpha_.find(placed.shape); alpha != alpha_.end()) {
      scene_.has_holes = binding.has_holes = true;
      binding.alpha = alpha->second;
    }
    ++info_.summary.shapes[placed.shape->use.model];
    const bool reverse = placed.shape->reverse_orientation;
    Emitter emitter{placed.shape, Emitter::Kind::kQuadric, 0};
    if (it->second.mesh) {
      emitter = {placed.shape, Emitter::Kind::kMesh, static_cast<uint32_t>(scene_.geometry.meshes.size())};
      group.meshes.push_back(emitter.index);
      scene_.geometry.meshes.push_back(place_mesh(*it->second.mesh, to_space, reverse, viewer));
      prepare_faces(scene_.geometry.meshes.back());
      scene_.moves |= it->second.mesh->motion_steps > 1;
      warn_if_coarse(*placed.shape, scene_.geometry.meshes.back(), viewer);
      scene_.mesh_bindings.push_back(binding);
      info_.summary.triangles += scene_.geometry.meshes.back().triangles.size();
    } else if (it->second.patches) {
      emitter = {placed.shape, Emitter::Kind::kPatches, static_cast<uint32_t>(scene_.geometry.patch_meshes.size())};
      group.patch_meshes.push_back(emitter.index);
      scene_.geometry.patch_meshes.push_back(place_patches(*it->second.patches, to_space, reverse, viewer));
      scene_.patch_bindings.push_back(binding);
    } else {
      emitter.index = static_cast<uint32_t>(scene_.geometry.quadrics.size());
      const QuadricShape& quadric = *it->second.quadric;
      scene_.geometry.quadrics.emplace_back(to_space * quadric.unit_to_object, reverse, quadric.part);
      scene_.quadric_bindings.push_back(binding);
      ++group.quadric_end;
    }
    if (may_emit && placed.shape->area_light >= 0) emitters_.push_back(emitter);
  }

  // Meshes that deform are not cut into smaller faces where these come much too near to the camera.
  void warn_if_coarse(const ShapeDesc& shape, const Mesh& mesh, Point3d viewer) {
    if (mesh.motion_steps > 1 && has_coarse_triangles(mesh, viewer, kLongestUncut))
      diagnostics_.warning(shape.use.loc,
                           fmt::format("a face of this {} is over {:g} times larger than its distance from the camera, "
                                       "and what is seen of it may be in the wrong place",
                                       shape.use.model, kLongestUncut),
                           "make it of smaller faces near the camera");
  }

  void add_groups() {
    size_t triangles_seen = info_.summary.triangles;
    const TransformPath recentre = TransformPath().then(Transform::translate(-scene_.origin));
    for (size_t g = 0; g < placed_.groups.size(); ++g) {
      const ShapeGroup& shapes = placed_.groups[g];
      const Bounds3& local = group_bounds_[g];
      const Space space = group_space(shapes, local);
      GeometryGroup group;
      group.quadric_begin = group.quadric_end = static_cast<uint32_t>(scene_.geometry.quadrics.size());
      const size_t before = info_.summary.triangles, first_emitter = emitters_.size();
      add_all(shapes.shapes, space, group, !shapes.is_shared);
      triangles_seen += (info_.summary.triangles - before) * shapes.instances.size();
      const auto index = static_cast<uint32_t>(scene_.geometry.groups.size());
      scene_.geometry.groups.push_back(std::move(group));
      const double size = local.empty() ? 0.0 : length(local.diagonal());
      for (const PlacedGroup& i : shapes.instances) add_instance(index, recentre.then(i.to_world), space.origin, size);
      for (const PlacedGroup& i : shapes.instances) scene_.instance_objects.push_back(static_cast<uint32_t>(i.object));
      for (size_t e = first_emitter; e < emitters_.size(); ++e)
        emitters_[e].motion = scene_.geometry.instances.back().motion;
    }
    info_.summary.instanced_triangles = triangles_seen;
  }

  // As for the world, the origin is the point nearest to the viewer; among several instances, as the nearest of them
  // has it.
  Space group_space(const ShapeGroup& group, const Bounds3& local) const {
    Space space;
    double least = std::numeric_limits<double>::infinity();
    for (const PlacedGroup& i : group.instances) {
      const Point3d viewer = i.to_world.at(view_.time).inverse().point(view_.position), nearest = local.nearest(viewer);
      const double distance = length(nearest - viewer);
      if (distance < least) least = distance, space = {nearest - Point3d{}, viewer};
    }
    return space;
  }

  // Shapes of the group are given from `origin`, from which they are at most `size` away.
  void add_instance(uint32_t group, const TransformPath& path, Vec3d origin, double size) {
    GeometryInstance& instance = scene_.geometry.instances.emplace_back();
    instance.group = group;
    if (!path.moves()) {
      const Transform t = path.at(0) * Transform::translate(origin);
      instance.to_world = Affine(t.matrix()), instance.to_object = Affine(t.inverse_matrix());
      return;
    }
    scene_.moves = true;
    instance.motion = &scene_.geometry.motions.emplace_back(path, origin, size);
    static_cast<Placement&>(instance) = placement_at(*instance.motion, 0);
  }

  void add_lights() {
    AreaLightCompiler lights(description_.image_source(), scene_, info_, diagnostics_);
    for (const Emitter& e : emitters_) {
      const ModelUse& use = description_.area_lights[static_cast<size_t>(e.shape->area_light)];
      const size_t first = scene_.lights.size();
      const bool invisible = invisible_.count(e.shape) > 0;
      if (e.kind == Emitter::Kind::kMesh) lights.add_mesh(use, e.index, invisible);
      if (e.kind == Emitter::Kind::kPatches) lights.add_patches(use, e.index, invisible);
      if (e.kind == Emitter::Kind::kQuadric) lights.add_quadric(use, e.index, invisible);
      for (size_t i = first; e.motion && i < scene_.lights.size(); ++i)
        scene_.lights[i] = scene_.lights[i].moving(*e.motion);
      info_.names.lights.resize(scene_.lights.size(), {"area light", use.loc});
      const auto alpha = alpha_.find(e.shape);
      if (alpha == alpha_.end()) continue;
      scene_.light_alphas.resize(first, {1.0f, -1});
      scene_.light_alphas.resize(scene_.lights.size(), alpha->second);
    }
  }

  const SceneDescription& description_;
  const Viewpoint view_;
  const std::vector<uint32_t>& material_of_;
  const TextureBuilder& textures_;
  std::map<const ShapeDesc*, ShapeGeometry>& loaded_;
  MeshFiles& mesh_files_;
  Scene& scene_;
  SceneInfo& info_;
  Diagnostics& diagnostics_;
  const LoadMonitor& monitor_;
  PlacedShapes placed_;
  std::vector<Bounds3> group_bounds_;              // of placed_.groups, in their own space
  std::map<const ShapeDesc*, FloatSource> alpha_;  // of those that have holes
  std::set<const ShapeDesc*> invisible_;           // lights of alpha 0
  std::vector<Emitter> emitters_;
};

}  // namespace

void compile_geometry(const SceneDescription& description, const Viewpoint& view,
                      const std::vector<uint32_t>& material_of, const TextureBuilder& textures, SceneFiles& files,
                      Scene& scene, SceneInfo& info, Diagnostics& diagnostics, const LoadMonitor& monitor) {
  GeometryCompiler(description, view, material_of, textures, files, scene, info, diagnostics, monitor).run();
}

}  // namespace etd
