#include "accel/surface.h"

#include "shapes/triangle.h"

namespace etd {
namespace {

// The absolute values of a linear map's entries applied to a vector of sizes.
Vec3 magnitude(const Affine& a, Vec3 v) { return abs(a.x) * v.x + abs(a.y) * v.y + abs(a.z) * v.z; }

}  // namespace

// The world point is M p + t, rounded. Embree inverts M in float and computes M'p - M't', each term with a relative
// error of u = 2^-24 per operation. The inverse of a matrix carries a componentwise error of a few u |M^-1||M||M^-1|,
// the products and sums a few u |M^-1| (|p| + |t|): together at most 4u |M^-1||M||M^-1| (|p| + |t|) with |.| taken per
// entry.
float instance_error(const GeometryInstance& instance, Point3 p) {
  const Affine &m = instance.to_world, &inverse = instance.to_object;
  const Vec3 size = magnitude(m, abs(p - Point3{})) + abs(m.t) * 2.0f;
  return 0x1p-22f * length(magnitude(inverse, magnitude(m, magnitude(inverse, size))));
}

SurfacePoint to_world(const SurfacePoint& s, const GeometryInstance& instance) {
  const Affine& m = instance.to_world;
  const Vec3d p =
      to_double(m.t) + to_double(m.x) * double(s.p.x) + to_double(m.y) * double(s.p.y) + to_double(m.z) * double(s.p.z);
  SurfacePoint w = s;
  w.p = to_float(Point3d{p.x, p.y, p.z});
  // Moving by e along the world normal M^-T ng / |M^-T ng| moves by e |M^-T ng| along ng in object space.
  const Vec3 ng = instance.to_object.transposed(s.ng);
  const float stretch = length(ng);
  w.p_error = (s.p_error + instance_error(instance, s.p)) / stretch;
  w.ng = ng * (1.0f / stretch);
  w.ns = s.ns == s.ng ? w.ng : normalize(instance.to_object.transposed(s.ns));
  w.ng = face_forward(w.ng, w.ns);
  w.dpdu = m.vector(s.dpdu);
  w.dpdv = m.vector(s.dpdv);
  return w;
}

SurfacePoint surface_point(const Geometry& geometry, const Hit& hit) {
  const GeometryInstance* instance = hit.instance == kNoId ? nullptr : &geometry.instances[hit.instance];
  if (hit.on_quadric()) {
    const SurfacePoint s = quadric_point(geometry.quadrics[hit.primitive], hit.q);
    return instance ? to_world(s, *instance) : s;
  }
  if (hit.on_patch()) {
    const PatchMesh& patches = geometry.patch_meshes[hit.patch_mesh()];
    if (!instance) return patch_point(patches, hit.primitive, hit.u, hit.v);
    const Point3 near = patch_point(patches, hit.primitive, hit.u, hit.v).p;
    return to_world(patch_point(patches, hit.primitive, hit.u, hit.v, instance_error(*instance, near)), *instance);
  }
  const Mesh& mesh = geometry.meshes[hit.geometry];
  if (!instance) return triangle_point(mesh, hit.primitive, hit.u, hit.v);
  const auto& index = mesh.triangles[hit.primitive];
  const Point3 p0 = mesh.positions[index[0]];
  const Point3 p = p0 + (mesh.positions[index[1]] - p0) * hit.u + (mesh.positions[index[2]] - p0) * hit.v;
  return to_world(triangle_point(mesh, hit.primitive, hit.u, hit.v, instance_error(*instance, p)), *instance);
}

}  // namespace etd
