// Rays of light from infinitely far away enter the scene through disks across their direction. One hides the
// whole scene. Where that is much larger than what the camera sees, smaller ones are nested around that, so that a ray
// goes there about as often as through all of the rest; the density is that of all disks together.
#pragma once

#include "core/bounds.h"

namespace etd {

class EmissionDisks {
 public:
  EmissionDisks() = default;
  // Around everything that rays can meet, and around most of what the camera sees; with a radius of 0 there is one
  // disk.
  explicit EmissionDisks(const BoundingSphere& scene, const BoundingSphere& seen = {});

  struct Entry {
    Point3 start;                // before the sphere of the disk that was chosen, one radius from its middle
    float pdf = 0;               // per area across the direction
    bool starts_within = false;  // things may lie before the start: it is near what is seen, for the sake of rounding
  };
  // A ray along unit d.
  Entry sample(Vec2 u, Vec3 d) const;
  // The density of the line through p along unit d.
  float pdf(Point3 p, Vec3 d) const { return pdf(p, d, -1); }

  const BoundingSphere& scene() const { return scene_; }
  // The smallest disk, around what the camera sees if that is much smaller than the scene.
  BoundingSphere smallest() const { return inner_ > 0 ? disk(0) : scene_; }
  // Each is chosen as often as the others.
  int count() const { return inner_ + 1; }

 private:
  // Inner disks, the smallest first, and then the one of the scene.
  BoundingSphere disk(int level) const;
  // `known`: a disk that the line meets, whatever rounding says; -1: none.
  float pdf(Point3 p, Vec3 d, int known) const;

  BoundingSphere scene_, seen_;
  int inner_ = 0;
};

}  // namespace etd
