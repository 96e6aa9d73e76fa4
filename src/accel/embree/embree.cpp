// The Accelerator over Embree 3.13. Everything that knows Embree is in this file.
//
// One scene per used group: mesh i of the group has geometry id i, all its spheres together the next id; the world's
// scene holds instance j at the id after those plus j. Scenes are robust (watertight along shared edges) and built at
// medium quality, whose parallel builder gives the same tree for any number of threads.
#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <atomic>
#include <mutex>
#include <stdexcept>
#include <string>

#include "accel/accelerator.h"

namespace etd {
namespace {

// What the sphere callbacks of one group need.
struct SphereRange {
  const Sphere* spheres = nullptr;  // Geometry::spheres
  uint32_t begin = 0;               // of the group
};

// Bounds of an ellipsoid: the half extent along an axis is the norm of that row of its map. Rounded outwards by more
// than the map and its inverse can disagree.
void sphere_bounds(const RTCBoundsFunctionArguments* args) {
  const auto& range = *static_cast<const SphereRange*>(args->geometryUserPtr);
  const Affine& m = range.spheres[range.begin + args->primID].to_world;
  float lower[3], upper[3];
  for (int i = 0; i < 3; ++i) {
    const float half = length(Vec3{m.x[i], m.y[i], m.z[i]});
    const float slack = 0x1p-20f * (half + std::abs(m.t[i]));
    lower[i] = m.t[i] - half - slack;
    upper[i] = m.t[i] + half + slack;
  }
  *args->bounds_o = {lower[0], lower[1], lower[2], 0.0f, upper[0], upper[1], upper[2], 0.0f};
}

std::optional<Sphere::Intersection> intersect_sphere(const void* range_pointer, uint32_t primitive, const RTCRay& ray) {
  const auto& range = *static_cast<const SphereRange*>(range_pointer);
  const Sphere& sphere = range.spheres[range.begin + primitive];
  return sphere.intersect({ray.org_x, ray.org_y, ray.org_z}, {ray.dir_x, ray.dir_y, ray.dir_z}, next_up(ray.tfar));
}

// The unit-sphere point travels to Accelerator::intersect in the place of Embree's normal. Rays come one at a time
// (N=1).
void sphere_intersect(const RTCIntersectFunctionNArguments* args) {
  if (!args->valid[0]) return;
  auto& query = *reinterpret_cast<RTCRayHit*>(args->rayhit);
  const auto found = intersect_sphere(args->geometryUserPtr, args->primID, query.ray);
  if (!found) return;
  const Vec3 n = found->n;
  query.ray.tfar = found->t;
  query.hit = {n.x, n.y, n.z, 0.0f, 0.0f, args->primID, args->geomID, {args->context->instID[0]}};
}

void sphere_occluded(const RTCOccludedFunctionNArguments* args) {
  if (!args->valid[0]) return;
  auto& ray = *reinterpret_cast<RTCRay*>(args->ray);
  if (intersect_sphere(args->geometryUserPtr, args->primID, ray)) ray.tfar = -kInfinity;
}

// The smallest distance Embree may report: it tests tnear <= t, we promise 0 < t, and work items flush denormals.
constexpr float kNearest = std::numeric_limits<float>::min();

RTCRay to_embree(const Ray& r) {
  return {r.o.x, r.o.y, r.o.z, kNearest, r.d.x, r.d.y, r.d.z, r.time, next_down(r.t_max), 0xffffffffu, 0, 0};
}

}  // namespace

struct Accelerator::Impl {
  const Geometry& geometry;
  RTCDevice device = nullptr;
  std::vector<RTCScene> scenes;     // by group; null where nothing uses it or it is empty
  std::vector<SphereRange> ranges;  // by group
  uint32_t first_instance = 0;      // geometry id of instance 0
  std::atomic<int64_t> bytes{0};
  std::mutex error_mutex;  // builders report from their own threads
  std::string error;

  explicit Impl(const Geometry& g) : geometry(g), scenes(g.groups.size()), ranges(g.groups.size()) {}
  ~Impl() {
    for (RTCScene scene : scenes)
      if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }

  void open_device();
  void build();
  RTCScene new_scene(uint32_t group);
  void attach_mesh(RTCScene scene, uint32_t id, const Mesh& mesh);
  void attach_spheres(RTCScene scene, uint32_t id, uint32_t group);
  void attach_instance(uint32_t index);
  bool is_empty(const GeometryGroup& group) const;
  void check() const {
    if (!error.empty()) throw std::runtime_error("cannot build the acceleration structure: " + error);
  }
};

void Accelerator::Impl::open_device() {
  device = rtcNewDevice(nullptr);
  if (!device)
    throw std::runtime_error(
        fmt::format("cannot open Embree (error {})", static_cast<int>(rtcGetDeviceError(nullptr))));
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
  constexpr RTCFormat kVertex = RTC_FORMAT_FLOAT3;
  constexpr size_t kStride = sizeof(Point3);
  if (p.capacity() > p.size()) {
    rtcSetSharedGeometryBuffer(shape, RTC_BUFFER_TYPE_VERTEX, 0, kVertex, p.data(), 0, kStride, p.size());
  } else {
    void* copy = rtcSetNewGeometryBuffer(shape, RTC_BUFFER_TYPE_VERTEX, 0, kVertex, kStride, p.size());
    if (copy) std::memcpy(copy, p.data(), p.size() * kStride);
  }
  rtcSetSharedGeometryBuffer(shape, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(), 0,
                             sizeof(mesh.triangles[0]), mesh.triangles.size());
  attach(scene, shape, id);
}

void Accelerator::Impl::attach_spheres(RTCScene scene, uint32_t id, uint32_t group) {
  const GeometryGroup& g = geometry.groups[group];
  if (g.sphere_begin == g.sphere_end) return;
  ranges[group] = {geometry.spheres.data(), g.sphere_begin};
  RTCGeometry shape = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  check();
  rtcSetGeometryUserPrimitiveCount(shape, g.sphere_end - g.sphere_begin);
  rtcSetGeometryUserData(shape, &ranges[group]);
  rtcSetGeometryBoundsFunction(shape, sphere_bounds, nullptr);
  rtcSetGeometryIntersectFunction(shape, sphere_intersect);
  rtcSetGeometryOccludedFunction(shape, sphere_occluded);
  attach(scene, shape, id);
}

// A scene with the meshes and spheres of a group, not yet committed.
RTCScene Accelerator::Impl::new_scene(uint32_t group) {
  const GeometryGroup& g = geometry.groups[group];
  RTCScene scene = scenes[group] = rtcNewScene(device);
  check();
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
  for (uint32_t i = 0; i < g.meshes.size(); ++i) attach_mesh(scene, i, geometry.meshes[g.meshes[i]]);
  attach_spheres(scene, static_cast<uint32_t>(g.meshes.size()), group);
  return scene;
}

bool Accelerator::Impl::is_empty(const GeometryGroup& group) const {
  for (uint32_t mesh : group.meshes)
    if (!geometry.meshes[mesh].triangles.empty()) return false;
  return group.sphere_begin == group.sphere_end;
}

void Accelerator::Impl::attach_instance(uint32_t index) {
  const GeometryInstance& instance = geometry.instances[index];
  if (instance.group == 0) throw std::runtime_error("an instance cannot contain the world");
  if (is_empty(geometry.groups[instance.group])) return;
  if (!scenes[instance.group]) rtcCommitScene(new_scene(instance.group));
  RTCGeometry shape = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
  check();
  rtcSetGeometryInstancedScene(shape, scenes[instance.group]);
  const Affine& m = instance.to_world;
  const float columns[12] = {m.x.x, m.x.y, m.x.z, m.y.x, m.y.y, m.y.z, m.z.x, m.z.y, m.z.z, m.t.x, m.t.y, m.t.z};
  rtcSetGeometryTransform(shape, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
  attach(scenes[0], shape, first_instance + index);
}

void Accelerator::Impl::build() {
  first_instance = static_cast<uint32_t>(geometry.groups[0].meshes.size()) + 1;
  RTCScene world = new_scene(0);
  for (uint32_t i = 0; i < geometry.instances.size(); ++i) attach_instance(i);
  rtcCommitScene(world);
  check();
}

Accelerator::Accelerator(const Geometry& geometry) : impl_(std::make_unique<Impl>(geometry)) {
  impl_->open_device();
  impl_->build();
}
Accelerator::~Accelerator() = default;
Accelerator::Accelerator(Accelerator&&) noexcept = default;
Accelerator& Accelerator::operator=(Accelerator&&) noexcept = default;

bool Accelerator::intersect(const Ray& ray, Hit& hit) const {
  if (!(ray.t_max > 0.0f)) return false;
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
  hit.instance = h.instID[0] == RTC_INVALID_GEOMETRY_ID ? kNoId : h.instID[0] - impl_->first_instance;
  const GeometryGroup& group = geometry.groups[hit.instance == kNoId ? 0 : geometry.instances[hit.instance].group];
  if (h.geomID < group.meshes.size()) {
    hit.geometry = group.meshes[h.geomID];
    hit.primitive = h.primID;
    hit.u = h.u;
    hit.v = h.v;
  } else {
    hit.geometry = kSphereGeometry;
    hit.primitive = group.sphere_begin + h.primID;
    hit.n = {h.Ng_x, h.Ng_y, h.Ng_z};
  }
  return true;
}

bool Accelerator::occluded(const Ray& ray) const {
  if (!(ray.t_max > 0.0f)) return false;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay query = to_embree(ray);
  rtcOccluded1(impl_->scenes[0], &context, &query);
  return query.tfar < 0.0f;
}

size_t Accelerator::bytes() const { return static_cast<size_t>(std::max<int64_t>(0, impl_->bytes.load())); }

}  // namespace etd
