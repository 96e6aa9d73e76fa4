// The Accelerator over Embree 3.13. Everything that knows Embree is in this file.
//
// One scene per used group: mesh i of the group has geometry id i, all its quadrics together the next id, its patch
// meshes those after that; the world's scene holds instance j at the id after those plus j. Scenes are robust
// (watertight along shared edges) and built at medium quality, whose parallel builder gives the same tree for any
// number of threads.
#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <atomic>
#include <deque>
#include <mutex>
#include <new>
#include <span>
#include <stdexcept>
#include <string>

#include "accel/accelerator.h"

namespace etd {
namespace {

// What the callbacks of a user geometry need: the quadrics of a group or the patches of a mesh.
struct UserShapes {
  const Quadric* quadrics = nullptr;  // the first of the group, or
  const PatchMesh* patches = nullptr;

  Bounds3 bounds(uint32_t i) const { return patches ? patch_bounds(*patches, i) : quadrics[i].bounds(); }
  // What becomes RTCHit: the offset on a quadric's unit shape travels in the place of Embree's normal.
  struct Found {
    float t;
    Vec3 offset;
    float u, v;
  };
  std::optional<Found> intersect(uint32_t i, const RTCRay& ray) const {
    const Point3 o{ray.org_x, ray.org_y, ray.org_z};
    const Vec3 d{ray.dir_x, ray.dir_y, ray.dir_z};
    const float t_max = next_up(ray.tfar), t_min = next_down(ray.tnear);
    if (patches) {
      const auto found = intersect_patch(*patches, i, o, d, t_max, t_min);
      return found ? std::optional<Found>({found->t, Vec3{}, found->u, found->v}) : std::nullopt;
    }
    const auto found = quadrics[i].intersect(o, d, t_max, t_min);
    return found ? std::optional<Found>({found->t, found->offset, 0.0f, 0.0f}) : std::nullopt;
  }
};

// Rounded outwards by more than maps and their inverses can disagree and than an edge is met beyond its place.
void user_bounds(const RTCBoundsFunctionArguments* args) {
  const Bounds3 box = static_cast<const UserShapes*>(args->geometryUserPtr)->bounds(args->primID);
  Point3 lower = to_float(box.lo), upper = to_float(box.hi);
  const Vec3 size = upper - lower;
  const float largest = std::max(size.x, std::max(size.y, size.z));
  for (int i = 0; i < 3; ++i) {
    const float slack = 0x1p-19f * (largest + std::max(std::abs(lower[i]), std::abs(upper[i])));
    lower[i] -= slack;
    upper[i] += slack;
  }
  *args->bounds_o = {lower.x, lower.y, lower.z, 0.0f, upper.x, upper.y, upper.z, 0.0f};
}

// Rays come one at a time (N=1).
void user_intersect(const RTCIntersectFunctionNArguments* args) {
  if (!args->valid[0]) return;
  auto& query = *reinterpret_cast<RTCRayHit*>(args->rayhit);
  const auto found = static_cast<const UserShapes*>(args->geometryUserPtr)->intersect(args->primID, query.ray);
  if (!found) return;
  const Vec3 q = found->offset;
  query.ray.tfar = found->t;
  query.hit = {q.x, q.y, q.z, found->u, found->v, args->primID, args->geomID, {args->context->instID[0]}};
}

void user_occluded(const RTCOccludedFunctionNArguments* args) {
  if (!args->valid[0]) return;
  auto& ray = *reinterpret_cast<RTCRay*>(args->ray);
  if (static_cast<const UserShapes*>(args->geometryUserPtr)->intersect(args->primID, ray)) ray.tfar = -kInfinity;
}

// The smallest distance Embree may report: it tests tnear <= t, we promise t_min < t, and work items flush denormals.
constexpr float kNearest = std::numeric_limits<float>::min();

RTCRay to_embree(const Ray& r) {
  return {r.o.x,
          r.o.y,
          r.o.z,
          r.t_min > 0.0f ? next_up(r.t_min) : kNearest,
          r.d.x,
          r.d.y,
          r.d.z,
          r.time,
          next_down(r.t_max),
          0xffffffffu,
          0,
          0};
}

}  // namespace

struct Accelerator::Impl {
  const Geometry& geometry;
  RTCDevice device = nullptr;
  std::vector<RTCScene> scenes;        // by group; null where nothing uses it or it is empty
  std::deque<UserShapes> user_shapes;  // of the user geometries, which point here
  uint32_t first_instance = 0;         // geometry id of instance 0
  std::atomic<int64_t> bytes{0};
  std::mutex error_mutex;  // builders report from their own threads
  std::string error;
  const LoadMonitor& monitor;  // only while it is built
  std::atomic<bool> stopped{false};

  Impl(const Geometry& g, const LoadMonitor& m) : geometry(g), scenes(g.groups.size()), monitor(m) {}
  ~Impl() {
    for (RTCScene scene : scenes)
      if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }

  static bool report_progress(void* self, double share);
  void open_device();
  void build();
  RTCScene new_scene(uint32_t group);
  void attach_mesh(RTCScene scene, uint32_t id, const Mesh& mesh);
  void attach_user(RTCScene scene, uint32_t id, const UserShapes& shapes, size_t count);
  void attach_instance(uint32_t index);
  bool is_empty(const GeometryGroup& group) const;
  void check() const {
    if (stopped) throw LoadingStopped();
    if (!error.empty()) throw std::runtime_error("cannot build the acceleration structure: " + error);
  }
};

void Accelerator::Impl::open_device() {
  device = rtcNewDevice(nullptr);
  if (!device) {
    const RTCError why = rtcGetDeviceError(nullptr);
    if (why == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
    throw std::runtime_error(fmt::format("cannot open Embree (error {})", static_cast<int>(why)));
  }
  rtcSetDeviceErrorFunction(
      device,
      [](void* self, RTCError code, const char* message) {
        auto& impl = *static_cast<Impl*>(self);
        const std::lock_guard lock(impl.error_mutex);
        if (impl.error.empty())
          impl.error = code == RTC_ERROR_OUT_OF_MEMORY
                           ? fmt::format("out of memory after {} MiB", impl.bytes.load() >> 20)
                           : fmt::format("{} (Embree error {})", message ? message : "", static_cast<int>(code));
      },
      this);
  rtcSetDeviceMemoryMonitorFunction(
      device,
      [](void* self, ssize_t change, bool) {
        static_cast<Impl*>(self)->bytes += change;
        return true;
      },
      this);
}

// Embree takes a false for an end of the building.
bool Accelerator::Impl::report_progress(void* self, double share) {
  auto& impl = *static_cast<Impl*>(self);
  if (!impl.monitor("building the acceleration structure", share)) impl.stopped = true;
  return !impl.stopped;
}

static void attach(RTCScene scene, RTCGeometry shape, uint32_t id) {
  rtcCommitGeometry(shape);
  rtcAttachGeometryByID(scene, shape, id);
  rtcReleaseGeometry(shape);
}

// Embree loads 16 bytes for every 12-byte vertex, so the last one needs 4 readable bytes behind it. A vector with spare
// capacity has them and is shared; otherwise Embree keeps a padded copy (counted in bytes()).
void Accelerator::Impl::attach_mesh(RTCScene scene, uint32_t id, const Mesh& mesh) {
  if (mesh.triangles.empty()) return;
  RTCGeometry shape = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  check();
  const auto& p = mesh.positions;
  const size_t count = mesh.vertex_count();
  constexpr RTCFormat kVertex = RTC_FORMAT_FLOAT3;
  constexpr size_t kStride = sizeof(Point3);
  rtcSetGeometryTimeStepCount(shape, mesh.motion_steps);
  for (uint32_t step = 0; step < mesh.motion_steps; ++step) {
    const size_t begin = step * count * kStride;
    if (p.capacity() > p.size()) {
      rtcSetSharedGeometryBuffer(shape, RTC_BUFFER_TYPE_VERTEX, step, kVertex, p.data(), begin, kStride, count);
    } else {
      void* copy = rtcSetNewGeometryBuffer(shape, RTC_BUFFER_TYPE_VERTEX, step, kVertex, kStride, count);
      if (copy) std::memcpy(copy, p.data() + step * count, count * kStride);
    }
  }
  rtcSetSharedGeometryBuffer(shape, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(), 0,
                             sizeof(mesh.triangles[0]), mesh.triangles.size());
  attach(scene, shape, id);
}

void Accelerator::Impl::attach_user(RTCScene scene, uint32_t id, const UserShapes& shapes, size_t count) {
  if (count == 0) return;
  user_shapes.push_back(shapes);
  RTCGeometry shape = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  check();
  rtcSetGeometryUserPrimitiveCount(shape, static_cast<uint32_t>(count));
  rtcSetGeometryUserData(shape, &user_shapes.back());
  rtcSetGeometryBoundsFunction(shape, user_bounds, nullptr);
  rtcSetGeometryIntersectFunction(shape, user_intersect);
  rtcSetGeometryOccludedFunction(shape, user_occluded);
  attach(scene, shape, id);
}

// A scene with everything of a group, not yet committed.
RTCScene Accelerator::Impl::new_scene(uint32_t group) {
  const GeometryGroup& g = geometry.groups[group];
  RTCScene scene = scenes[group] = rtcNewScene(device);
  check();
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
  if (monitor) rtcSetSceneProgressMonitorFunction(scene, report_progress, this);
  for (uint32_t i = 0; i < g.meshes.size(); ++i) attach_mesh(scene, i, geometry.meshes[g.meshes[i]]);
  auto id = static_cast<uint32_t>(g.meshes.size());
  attach_user(scene, id, {geometry.quadrics.data() + g.quadric_begin, nullptr}, g.quadric_end - g.quadric_begin);
  for (const uint32_t mesh : g.patch_meshes)
    attach_user(scene, ++id, {nullptr, &geometry.patch_meshes[mesh]}, geometry.patch_meshes[mesh].patches.size());
  return scene;
}

bool Accelerator::Impl::is_empty(const GeometryGroup& group) const {
  for (uint32_t mesh : group.meshes)
    if (!geometry.meshes[mesh].triangles.empty()) return false;
  for (uint32_t mesh : group.patch_meshes)
    if (!geometry.patch_meshes[mesh].patches.empty()) return false;
  return group.quadric_begin == group.quadric_end;
}

static void set_motion(RTCGeometry shape, const AnimatedTransform& motion) {
  const std::span<const AnimatedTransform::Key> keys = motion.keys();
  rtcSetGeometryTimeStepCount(shape, static_cast<unsigned>(keys.size()));
  for (unsigned step = 0; step < keys.size(); ++step) {
    const AnimatedTransform::Key& k = keys[step];
    RTCQuaternionDecomposition q;
    rtcInitQuaternionDecomposition(&q);
    rtcQuaternionDecompositionSetTranslation(&q, k.translation.x, k.translation.y, k.translation.z);
    rtcQuaternionDecompositionSetQuaternion(&q, k.r, k.i, k.j, k.k);
    rtcQuaternionDecompositionSetScale(&q, k.scale.x, k.scale.y, k.scale.z);
    rtcQuaternionDecompositionSetSkew(&q, k.skew.x, k.skew.y, k.skew.z);
    rtcQuaternionDecompositionSetShift(&q, k.shift.x, k.shift.y, k.shift.z);
    rtcSetGeometryTransformQuaternion(shape, step, &q);
  }
}

void Accelerator::Impl::attach_instance(uint32_t index) {
  const GeometryInstance& instance = geometry.instances[index];
  if (instance.group == 0) throw std::runtime_error("an instance cannot contain the world");
  if (is_empty(geometry.groups[instance.group])) return;
  if (!scenes[instance.group]) rtcCommitScene(new_scene(instance.group));
  RTCGeometry shape = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
  check();
  rtcSetGeometryInstancedScene(shape, scenes[instance.group]);
  if (instance.motion) {
    set_motion(shape, *instance.motion);
  } else {
    const Affine& m = instance.to_world;
    const float columns[12] = {m.x.x, m.x.y, m.x.z, m.y.x, m.y.y, m.y.z, m.z.x, m.z.y, m.z.z, m.t.x, m.t.y, m.t.z};
    rtcSetGeometryTransform(shape, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
  }
  attach(scenes[0], shape, first_instance + index);
}

void Accelerator::Impl::build() {
  first_instance = static_cast<uint32_t>(geometry.groups[0].meshes.size() + 1 + geometry.groups[0].patch_meshes.size());
  RTCScene world = new_scene(0);
  for (uint32_t i = 0; i < geometry.instances.size(); ++i) attach_instance(i);
  rtcCommitScene(world);
  check();
}

Accelerator::Accelerator(const Geometry& geometry, const LoadMonitor& monitor)
    : impl_(std::make_unique<Impl>(geometry, monitor)) {
  impl_->open_device();
  impl_->build();
}
Accelerator::~Accelerator() = default;
Accelerator::Accelerator(Accelerator&&) noexcept = default;
Accelerator& Accelerator::operator=(Accelerator&&) noexcept = default;

bool Accelerator::intersect(const Ray& ray, Hit& hit) const {
  if (!(ray.t_max > ray.t_min)) return false;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query;
  query.ray = to_embree(ray);
  query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(impl_->scenes[0], &context, &query);
  const RTCHit& h = query.hit;
  if (h.geomID == RTC_INVALID_GEOMETRY_ID) return false;

  const Geometry& geometry = impl_->geometry;
  hit.t = query.ray.tfar;
  hit.time = ray.time;
  hit.instance = h.instID[0] == RTC_INVALID_GEOMETRY_ID ? kNoId : h.instID[0] - impl_->first_instance;
  const GeometryGroup& group = geometry.groups[hit.instance == kNoId ? 0 : geometry.instances[hit.instance].group];
  if (h.geomID < group.meshes.size()) {
    hit.geometry = group.meshes[h.geomID];
    hit.primitive = h.primID;
    hit.u = h.u;
    hit.v = h.v;
  } else if (const size_t after = h.geomID - group.meshes.size(); after > 0) {
    hit.geometry = kFirstPatchGeometry + group.patch_meshes[after - 1];
    hit.primitive = h.primID;
    hit.u = h.u;
    hit.v = h.v;
  } else {
    hit.geometry = kQuadricGeometry;
    hit.primitive = group.quadric_begin + h.primID;
    hit.offset = {h.Ng_x, h.Ng_y, h.Ng_z};
  }
  return true;
}

bool Accelerator::occluded(const Ray& ray) const {
  if (!(ray.t_max > ray.t_min)) return false;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay query = to_embree(ray);
  rtcOccluded1(impl_->scenes[0], &context, &query);
  return query.tfar < 0.0f;
}

Affine Accelerator::instance_to_world(uint32_t instance, float time) const {
  Affine m;
  float c[12];
  RTCGeometry shape = rtcGetGeometry(impl_->scenes[0], impl_->first_instance + instance);
  if (!shape) return m;
  rtcGetGeometryTransform(shape, time, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, c);
  m.x = {c[0], c[1], c[2]}, m.y = {c[3], c[4], c[5]}, m.z = {c[6], c[7], c[8]}, m.t = {c[9], c[10], c[11]};
  return m;
}

size_t Accelerator::bytes() const { return static_cast<size_t>(std::max<int64_t>(0, impl_->bytes.load())); }

}  // namespace etd
