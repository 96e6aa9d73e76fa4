// Transforms that change with time. Time is 0 at the start of the scene's motion and 1 at its end.
//
// An affine map is taken apart into M = T R S: a translation, a rotation (a unit quaternion) and an upper triangular
// rest. Between two maps T and S change linearly and R turns at constant speed by the shorter way (Shoemake 1985):
// what Embree calls a quaternion decomposition. pbrt-v4 lets S be symmetric instead, which is the same for all motions
// but those that stretch something across its axes while it moves.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "core/bounds.h"
#include "core/transform.h"

namespace etd {

struct Quaternion {
  double r = 1, i = 0, j = 0, k = 0;
};

struct TransformParts {
  Vec3d translation;
  Quaternion rotation;
  Vec3d scale{1, 1, 1};  // diagonal of S; negative in z alone where the map mirrors
  Vec3d skew;            // its entries xy, xz, yz

  // Takes apart an affine map that is not singular.
  static TransformParts of(const Mat4& m);
  // Interpolates between `a` at 0 and `b` at 1. Rotations by less than 3.6 degrees are interpolated linearly and
  // normalised, as Embree and pbrt do: at most 1e-6 of them off.
  static TransformParts between(const TransformParts& a, const TransformParts& b, double t);
  Transform transform() const;
  // S alone.
  Transform rest() const;
};

// Tells where something is over time that moving things place within each other: a product of transforms, some of which
// move.
class TransformPath {
 public:
  TransformPath() = default;
  // This path times `inner`, which points go through first.
  TransformPath then(const TransformPair& inner) const;
  TransformPath then(const TransformPath& inner) const;

  bool moves() const;
  Transform at(double time) const;
  size_t length() const { return factors_.size(); }

 private:
  struct Factor {
    bool moves;
    Transform always;
    TransformParts start, end;
  };
  void append(const Factor& factor);

  std::vector<Factor> factors_;
};

// A path as rays follow it: keys at even steps of time with TransformParts::between in between, so many that this
// agrees with the path up to rounding, or 128 steps: what turns within something that turns is then met by its chords.
// Steps turn by less than 3.6 degrees, where Embree's own interpolation has the precision of float.
class AnimatedTransform {
 public:
  // Keys have the precision in which Embree has them. A point p is mapped to T R (S p + shift).
  struct Key {
    Vec3 translation;
    float r = 1, i = 0, j = 0, k = 0;
    Vec3 scale{1, 1, 1}, skew, shift;
  };

  // Maps p to path(p + centre); `size` is how far from 0 such p are.
  AnimatedTransform(const TransformPath& path, Vec3d centre, double size);

  std::span<const Key> keys() const { return keys_; }
  Transform at(float time) const;
  // Whether it only turns and translates.
  bool is_rigid() const;
  // Returns by how much areas grow in the mean over time; exact where all directions grow alike.
  double mean_area_scale() const;
  // The first and the last of the keys between which the times are.
  std::pair<size_t, size_t> keys_between(float start, float end) const;
  // Returns by how much it turns from key `step` to the next, radians.
  double turn(size_t step) const;
  // A box around all that the points of `box` pass between two times.
  Bounds3 swept(const Bounds3& box, float start, float end) const;
  // How far the pivot is from the centre in the space that S maps to, at most.
  float pivot_distance() const { return pivot_distance_; }

 private:
  std::vector<Key> keys_;
  float pivot_distance_ = 0;
};

}  // namespace etd
