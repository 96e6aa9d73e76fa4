// Affine and projective transforms, composed in double so that chains of them and far-away scenes stay exact.
#pragma once

#include <array>

#include "core/vec.h"

namespace etd {

// Row-major 4x4 matrix acting on column vectors: p' = M p.
struct Mat4 {
  std::array<std::array<double, 4>, 4> m{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
  friend bool operator==(const Mat4&, const Mat4&) = default;
};
Mat4 operator*(const Mat4& a, const Mat4& b);

// A matrix with its inverse. A singular matrix keeps a zero inverse and says so through is_singular().
class Transform {
 public:
  Transform() = default;
  explicit Transform(const Mat4& m);
  Transform(const Mat4& m, const Mat4& inverse) : m_(m), inv_(inverse) {}

  static Transform translate(Vec3d t);
  static Transform scale(Vec3d s);
  // Right-handed rotation by `degrees` around `axis` (any nonzero length).
  static Transform rotate(double degrees, Vec3d axis);
  // World-to-camera for pbrt's left-handed LookAt: camera looks along +z, y is up. Singular when up is parallel to
  // the view or eye = target.
  static Transform look_at(Point3d eye, Point3d target, Vec3d up);

  const Mat4& matrix() const { return m_; }
  const Mat4& inverse_matrix() const { return inv_; }
  Transform inverse() const { return {inv_, m_}; }
  bool is_singular() const;
  bool is_identity() const { return m_ == Mat4{}; }
  // True when the last row is (0 0 0 1).
  bool is_affine() const;
  // Determinant of the upper 3x3 block; negative for mirroring transforms.
  double determinant3() const;

  Point3d point(Point3d p) const;  // with the homogeneous divide
  Vec3d vector(Vec3d v) const;
  Vec3d normal(Vec3d n) const;  // inverse transpose; not normalised

  friend Transform operator*(const Transform& a, const Transform& b) { return {a.m_ * b.m_, b.inv_ * a.inv_}; }
  friend bool operator==(const Transform&, const Transform&) = default;

 private:
  Mat4 m_, inv_;
};

// A transform as it is at the start and at the end of the scene's motion (core/animated_transform.h: in between).
struct TransformPair {
  Transform start, end;

  TransformPair() = default;
  TransformPair(const Transform& always) : start(always), end(always) {}
  TransformPair(const Transform& at_start, const Transform& at_end) : start(at_start), end(at_end) {}
  bool is_moving() const { return !(start.matrix() == end.matrix()); }
  TransformPair inverse() const { return {start.inverse(), end.inverse()}; }
};

}  // namespace etd
