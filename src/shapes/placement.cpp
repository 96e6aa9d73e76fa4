#include "shapes/placement.h"

namespace etd {
namespace {

// The absolute values of a linear map's entries applied to a vector of sizes.
Vec3 magnitude(const Affine& a, Vec3 v) { return abs(a.x) * v.x + abs(a.y) * v.y + abs(a.z) * v.z; }

}  // namespace

Placement placement_at(const AnimatedTransform& motion, float time) {
  const Transform t = motion.at(time);
  return {Affine(t.matrix()), Affine(t.inverse_matrix()), true, motion.pivot_distance()};
}

// The world point is M p + t, rounded. Embree inverts M in float and computes M'p - M't', each term with a relative
// error of u = 2^-24 per operation. The inverse of a matrix carries a componentwise error of a few u |M^-1||M||M^-1|,
// the products and sums a few u |M^-1| (|p| + |t|): together at most 4u |M^-1||M||M^-1| (|p| + |t|) with |.| taken per
// entry. An interpolated M has an error of 7u |M| besides (measured: core/animated_transform.h), which also turns, so
// that sizes count and not single entries: 16u for all of it.
float placement_error(const Placement& placement, Point3 p) {
  const Affine &m = placement.to_world, &inverse = placement.to_object;
  const Vec3 size = magnitude(m, abs(p - Point3{})) + abs(m.t) * 2.0f;
  const Vec3 world = magnitude(m, magnitude(inverse, size));
  if (!placement.moves) return 0x1p-22f * length(magnitude(inverse, world));
  const float all = length(world) + placement.pivot;
  return 0x1p-20f * length(magnitude(inverse, {all, all, all}));
}

SurfacePoint to_world(const SurfacePoint& s, const Placement& placement) {
  const Affine& m = placement.to_world;
  const Vec3d p =
      to_double(m.t) + to_double(m.x) * double(s.p.x) + to_double(m.y) * double(s.p.y) + to_double(m.z) * double(s.p.z);
  SurfacePoint w = s;
  w.p = to_float(Point3d{p.x, p.y, p.z});
  // Moving by e along the world normal M^-T ng / |M^-T ng| moves by e |M^-T ng| along ng in object space.
  const Vec3 ng = placement.to_object.transposed(s.ng);
  const float stretch = length(ng);
  w.p_error = (s.p_error + placement_error(placement, s.p)) / stretch;
  w.ng = ng * (1.0f / stretch);
  w.ns = s.ns == s.ng ? w.ng : normalize(placement.to_object.transposed(s.ns));
  w.ng = face_forward(w.ng, w.ns);
  w.dpdu = m.vector(s.dpdu);
  w.dpdv = m.vector(s.dpdv);
  return w;
}

SurfacePoint to_object(const SurfacePoint& s, const Placement& placement) {
  SurfacePoint o = s;
  o.p = placement.to_object.point(s.p);
  o.ng = o.ns = normalize(placement.to_world.transposed(s.ng));
  return o;
}

}  // namespace etd
