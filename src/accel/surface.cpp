#include "accel/surface.h"

#include "shapes/triangle.h"

namespace etd {
namespace {

// Returns the point in the space of its mesh; `instance` is where that space is, null for the world itself.
SurfacePoint point_on_mesh(const Mesh& mesh, const Hit& hit, const Placement* instance, bool tangents) {
  float margin = 0;
  if (instance) margin = placement_error(*instance, triangle_position(mesh, hit.primitive, hit.u, hit.v, hit.time));
  return triangle_point(mesh, hit.primitive, hit.u, hit.v, hit.time, margin, tangents);
}

SurfacePoint point_on_patches(const PatchMesh& patches, const Hit& hit, const Placement* instance) {
  const SurfacePoint s = patch_point(patches, hit.primitive, hit.u, hit.v);
  return instance ? patch_point(patches, hit.primitive, hit.u, hit.v, placement_error(*instance, s.p)) : s;
}

SurfacePoint point_in_object(const Geometry& geometry, const Hit& hit, const Placement* instance, bool tangents) {
  if (hit.on_quadric()) {
    const Quadric& quadric = geometry.quadrics[hit.primitive];
    return quadric_point(quadric, quadric.unit_point_at(hit.offset));
  }
  if (hit.on_patch()) return point_on_patches(geometry.patch_meshes[hit.patch_mesh()], hit, instance);
  return point_on_mesh(geometry.meshes[hit.geometry], hit, instance, tangents);
}

}  // namespace

SurfacePoint surface_point(const Geometry& geometry, const Hit& hit, bool tangents) {
  if (hit.instance == kNoId) return point_in_object(geometry, hit, nullptr, tangents);
  const Placement instance = geometry.placement(hit.instance, hit.time);
  return to_world(point_in_object(geometry, hit, &instance, tangents), instance);
}

}  // namespace etd
