#include "materials/bent_normal.h"

namespace etd {

namespace {

// How far above the surface the mirror image comes, as a cosine.
constexpr double kClearance = 0.01;

}  // namespace

// The mirror image r of wo about n has r.ng = 2 (n.wo) (n.ng) - wo.ng, a quadratic form of n. In the axes of wo + ng,
// wo - ng and across both, with c = wo.ng, r.ng >= e is
//     b0 x^2 >= b1 y^2 + b2 z^2,  b0 = 1 - e, b1 = 1 + e, b2 = c + e,
// an elliptical cone about wo + ng. Its point nearest to n solves (1 + t diag(b0, -b1, -b2)) n' = n (Lagrange), that is
// n' along (|x|, q y / (1 + (1 -+ q) b1 / b0), q z / (1 + (1 -+ q) b2 / b0)), - where x > 0, with the one q > 0 at
// which n' is on the cone.
Frame bend_to_viewer(const Frame& frame, Vec3 ng_float, Vec3 wo_float) {
  const float side = dot(wo_float, ng_float) < 0.0f ? -1.0f : 1.0f;
  const Vec3d wo = to_double(wo_float), ng = to_double(ng_float) * double{side}, n = to_double(frame.z) * double{side};
  const double c = dot(wo, ng), e = std::min(kClearance, 0.5 * c);
  if (2.0 * dot(n, wo) * dot(n, ng) - c >= e || !(c > 0.0)) return frame;

  // Seen straight on the cone is round, so that any axes across it do.
  const Vec3d apart = wo - ng, x = normalize(wo + ng);
  const Vec3d y = normalize(dot(apart, apart) > 1e-20 ? apart : cross(x, n)), z = cross(x, y);
  const double b0 = 1.0 - e, b1 = 1.0 + e, b2 = c + e;
  const double along = dot(n, x), across = std::max(std::abs(along), 1e-12);
  const auto point = [&](double q) {
    const double rest = 1.0 - std::copysign(q, along);
    return Vec3d{across, dot(n, y) * q / (1.0 + rest * b1 / b0), dot(n, z) * q / (1.0 + rest * b2 / b0)};
  };
  double low = 0.0, high = along > 0.0 ? 1.0 : 1e6;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    const Vec3d p = point(middle);
    (b0 * sqr(p.x) >= b1 * sqr(p.y) + b2 * sqr(p.z) ? low : high) = middle;
  }
  const Vec3d p = point(low), bent = normalize(x * p.x + y * p.y + z * p.z);
  return Frame::from_z_tangent(to_float(bent) * side, frame.x);
}

}  // namespace etd
