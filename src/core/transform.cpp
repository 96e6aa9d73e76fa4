#include "core/transform.h"

namespace etd {

namespace {

Mat4 zero_matrix() {
  Mat4 z;
  for (auto& row : z.m) row.fill(0.0);
  return z;
}

// Gauss-Jordan with full row pivoting; the zero matrix when `a` is singular to working precision.
Mat4 invert(const Mat4& a) {
  Mat4 left = a, right;
  for (int col = 0; col < 4; ++col) {
    int pivot = col;
    for (int r = col + 1; r < 4; ++r)
      if (std::abs(left.m[r][col]) > std::abs(left.m[pivot][col])) pivot = r;
    const double p = left.m[pivot][col];
    if (p == 0.0 || !std::isfinite(p)) return zero_matrix();
    std::swap(left.m[col], left.m[pivot]);
    std::swap(right.m[col], right.m[pivot]);
    for (int c = 0; c < 4; ++c) left.m[col][c] /= p, right.m[col][c] /= p;
    for (int r = 0; r < 4; ++r) {
      const double f = left.m[r][col];
      if (r == col || f == 0.0) continue;
      for (int c = 0; c < 4; ++c) left.m[r][c] -= f * left.m[col][c], right.m[r][c] -= f * right.m[col][c];
    }
  }
  for (const auto& row : right.m)
    for (double v : row)
      if (!std::isfinite(v)) return zero_matrix();
  return right;
}

Mat4 from_rows(Vec3d x, Vec3d y, Vec3d z) {
  Mat4 r;
  r.m[0] = {x.x, x.y, x.z, 0};
  r.m[1] = {y.x, y.y, y.z, 0};
  r.m[2] = {z.x, z.y, z.z, 0};
  return r;
}

}  // namespace

Mat4 operator*(const Mat4& a, const Mat4& b) {
  Mat4 r;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      double s = 0.0;
      for (int k = 0; k < 4; ++k) s += a.m[i][k] * b.m[k][j];
      r.m[i][j] = s;
    }
  return r;
}

Transform::Transform(const Mat4& m) : m_(m), inv_(invert(m)) {}

Transform Transform::translate(Vec3d t) {
  Mat4 m, inv;
  for (int i = 0; i < 3; ++i) m.m[i][3] = t[i], inv.m[i][3] = -t[i];
  return {m, inv};
}

Transform Transform::scale(Vec3d s) { return Transform(from_rows({s.x, 0, 0}, {0, s.y, 0}, {0, 0, s.z})); }

Transform Transform::rotate(double degrees, Vec3d axis) {
  if (dot(axis, axis) == 0.0) return Transform(zero_matrix());
  const Vec3d a = normalize(axis);
  const double s = std::sin(radians(degrees)), c = std::cos(radians(degrees)), t = 1.0 - c;
  // Rodrigues: c I + s [a]x + (1 - c) a a^T.
  const Mat4 m = from_rows({c + t * a.x * a.x, t * a.x * a.y - s * a.z, t * a.x * a.z + s * a.y},
                           {t * a.y * a.x + s * a.z, c + t * a.y * a.y, t * a.y * a.z - s * a.x},
                           {t * a.z * a.x - s * a.y, t * a.z * a.y + s * a.x, c + t * a.z * a.z});
  Mat4 inv;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) inv.m[i][j] = m.m[j][i];
  return {m, inv};
}

Transform Transform::look_at(Point3d eye, Point3d target, Vec3d up) {
  const Vec3d forward = target - eye;
  if (dot(forward, forward) == 0.0) return Transform(zero_matrix());
  const Vec3d z = normalize(forward);
  const Vec3d side = cross(up, z);
  if (!(dot(side, side) > 1e-24 * dot(up, up))) return Transform(zero_matrix());
  const Vec3d x = normalize(side), y = cross(z, x);
  Mat4 camera_to_world;
  const Vec3d o{eye.x, eye.y, eye.z};
  for (int i = 0; i < 3; ++i) camera_to_world.m[i] = {x[i], y[i], z[i], o[i]};
  const Mat4 world_to_camera = from_rows(x, y, z) * translate(-o).matrix();
  return {world_to_camera, camera_to_world};
}

bool Transform::is_singular() const {
  // An inverse of zeros marks failure; a product with one keeps a zero bottom row.
  return inv_.m[3][0] == 0 && inv_.m[3][1] == 0 && inv_.m[3][2] == 0 && inv_.m[3][3] == 0;
}

bool Transform::is_affine() const { return m_.m[3] == std::array<double, 4>{0, 0, 0, 1}; }

double Transform::determinant3() const {
  const auto& a = m_.m;
  return a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) - a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
         a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
}

Point3d Transform::point(Point3d p) const {
  const auto& a = m_.m;
  const Point3d r{a[0][0] * p.x + a[0][1] * p.y + a[0][2] * p.z + a[0][3],
                  a[1][0] * p.x + a[1][1] * p.y + a[1][2] * p.z + a[1][3],
                  a[2][0] * p.x + a[2][1] * p.y + a[2][2] * p.z + a[2][3]};
  const double w = a[3][0] * p.x + a[3][1] * p.y + a[3][2] * p.z + a[3][3];
  if (w == 1.0) return r;
  return {r.x / w, r.y / w, r.z / w};
}

Vec3d Transform::vector(Vec3d v) const {
  const auto& a = m_.m;
  return {a[0][0] * v.x + a[0][1] * v.y + a[0][2] * v.z, a[1][0] * v.x + a[1][1] * v.y + a[1][2] * v.z,
          a[2][0] * v.x + a[2][1] * v.y + a[2][2] * v.z};
}

Vec3d Transform::normal(Vec3d n) const {
  const auto& a = inv_.m;
  return {a[0][0] * n.x + a[1][0] * n.y + a[2][0] * n.z, a[0][1] * n.x + a[1][1] * n.y + a[2][1] * n.z,
          a[0][2] * n.x + a[1][2] * n.y + a[2][2] * n.z};
}

}  // namespace etd
