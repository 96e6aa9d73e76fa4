// The Accelerator over Embree 3.13. Everything that knows Embree is in this file.
//
// One scene per used group: mesh i of the group has geometry id i, all its quadrics together the next id; the world's
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

// What the callbacks for the quadrics of one group need.
struct QuadricRange {
  const Quadric* quadrics = nullptr;  // Geometry::quadrics
  uint32_t begin = 0;                 // of the group
};

// Rounded outwards by more than the map and its inverse can disagree and than an edge is met beyond its place.
void quadric_bounds(const RTCBoundsFunctionArguments* args) {
  const auto& range = *static_cast<const QuadricRange*>(args->geometryUserPtr);
  const Bounds3 box = range.quadrics[range.begin + args->primID].bounds();
  Point3 lower = to_float(box.lo), upper = to_float(box.hi);
  for (int i = 0; i < 3; ++i) {
    const float slack = 0x1p-20f * (upper[i] - lower[i] + std::max(std::abs(lower[i]), std::abs(upper[i])));
    lower[i] -= slack;
    upper[i] += slack;
  }
  *args->bounds_o = {lower.x, lower.y, lower.z, 0.0f, upper.x, upper.y, upper.z, 0.0f};
}

std::optional<Quadric::Intersection> intersect_quadric(const void* range_pointer, uint32_t primitive,
                                                       const RTCRay& ray) {
  const auto& range = *static_cast<const QuadricRange*>(range_pointer);
  const Quadric& quadric = range.quadrics[range.begin + primitive];
  return quadric.intersect({ray.org_x, ray.org_y, ray.org_z}, {ray.dir_x, ray.dir_y, ray.dir_z}, next_up(ray.tfar),
                           next_down(ray.tnear));
}

// The unit-shape point travels to Accelerator::intersect in the place of Embree's normal. Rays come one at a time
// (N=1).
void quadric_intersect(const RTCIntersectFunctionNArguments* args) {
  if (!args->valid[0]) return;
  auto& query = *reinterpret_cast<RTCRayHit*>(args->rayhit);
  const auto found = intersect_quadric(args->geometryUserPtr, args->primID, query.ray);
  if (!found) return;
  const Vec3 q = found->q;
  query.ray.tfar = found->t;
  query.hit = {q.x, q.y, q.z, 0.0f, 0.0f, args->primID, args->geomID, {args->context->instID[0]}};
}

void quadric_occluded(const RTCOccludedFunctionNArguments* args) {
  if (!args->valid[0]) return;
  auto& ray = *reinterpret_cast<RTCRay*>(args->ray);
  if (intersect_quadric(args->geometryUserPtr, args->primID, ray)) ray.tfar = -kInfinity;
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
  std::vector<RTCScene> scenes;      // by group; null where nothing uses it or it is empty
  std::vector<QuadricRange> ranges;  // by group
  uint32_t first_instance = 0;       // geometry id of instance 0
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
  void attach_quadrics(RTCScene scene, uint32_t id, uint32_t group);
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

void Accelerator::Impl::attach_quadrics(RTCScene scene, uint32_t id, uint32_t group) {
  const GeometryGroup& g = geometry.groups[group];
  if (g.quadric_begin == g.quadric_end) return;
  ranges[group] = {geometry.quadrics.data(), g.quadric_begin};
  RTCGeometry shape = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  check();
  rtcSetGeometryUserPrimitiveCount(shape, g.quadric_end - g.quadric_begin);
  rtcSetGeometryUserData(shape, &ranges[group]);
  rtcSetGeometryBoundsFunction(shape, quadric_bounds, nullptr);
  rtcSetGeometryIntersectFunction(shape, quadric_intersect);
  rtcSetGeometryOccludedFunction(shape, quadric_occluded);
  attach(scene, shape, id);
}

// A scene with the meshes and quadrics of a group, not yet committed.
RTCScene Accelerator::Impl::new_scene(uint32_t group) {
  const GeometryGroup& g = geometry.groups[group];
  RTCScene scene = scenes[group] = rtcNewScene(device);
  check();
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
  for (uint32_t i = 0; i < g.meshes.size(); ++i) attach_mesh(scene, i, geometry.meshes[g.meshes[i]]);
  attach_quadrics(scene, static_cast<uint32_t>(g.meshes.size()), group);
  return scene;
}

bool Accelerator::Impl::is_empty(const GeometryGroup& group) const {
  for (uint32_t mesh : group.meshes)
    if (!geometry.meshes[mesh].triangles.empty()) return false;
  return group.quadric_begin == group.quadric_end;
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
  hit.instance = h.instID[0] == RTC_INVALID_GEOMETRY_ID ? kNoId : h.instID[0] - impl_->first_instance;
  const GeometryGroup& group = geometry.groups[hit.instance == kNoId ? 0 : geometry.instances[hit.instance].group];
  if (h.geomID < group.meshes.size()) {
    hit.geometry = group.meshes[h.geomID];
    hit.primitive = h.primID;
    hit.u = h.u;
    hit.v = h.v;
  } else {
    hit.geometry = kQuadricGeometry;
    hit.primitive = group.quadric_begin + h.primID;
    hit.q = {h.Ng_x, h.Ng_y, h.Ng_z};
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

size_t Accelerator::bytes() const { return static_cast<size_t>(std::max<int64_t>(0, impl_->bytes.load())); }

}  // namespace etd
