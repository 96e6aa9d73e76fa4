// The opening of a lens: what blurred points of light look like.
#pragma once

#include "cameras/camera.h"

namespace etd {

// Which points of the unit disk (or, for images, of the square around it) light passes through, x to the right and y up
// as the camera sees them. The ray's weight is 1 whatever the shape: a smaller opening blurs less and is no darker.
class Aperture {
 public:
  // A disk.
  Aperture() = default;

  static std::vector<ParamDecl> params();
  // `data` keeps an image's distribution.
  static Aperture create(const ParamReader& p, const ImageSource& images, CameraData& data);

  // Uniform over a disk or polygon, in proportion to the values of an image.
  Vec2 sample(Vec2 u) const {
    if (shape_ == Shape::kRound) return sample_round(u);
    const Vec2 p = shape_ == Shape::kStar ? sample_star(u) : sample_image(u);
    return {turn_.x * p.x - turn_.y * p.y, turn_.y * p.x + turn_.x * p.y};
  }
  // The density of sample() per area of that plane; 0 outside of the opening.
  float density(Vec2 p) const;

 private:
  enum class Shape : uint8_t { kRound, kStar, kImage };
  static Vec2 sample_round(Vec2 u);
  Vec2 sample_star(Vec2 u) const;
  Vec2 sample_image(Vec2 u) const;
  Vec2 star_corner(int i) const;
  float density_star(Vec2 p) const;
  float density_image(Vec2 p) const;
  static Aperture star(int points, float outer, float inner);
  static Aperture named(const std::string& name, CameraData& data);
  static Aperture of_weights(int width, int height, const std::vector<double>& weights, CameraData& data);
  static Aperture of_file(const ParamReader& p, const Param& file, const ImageSource& images, CameraData& data);

  Shape shape_ = Shape::kRound;
  // A star has corners at the radius outer_, the first one up, and between them others at inner_. A regular polygon is
  // the star whose inner corners lie on its sides.
  int points_ = 0;
  float outer_ = 1, inner_ = 1;
  // An image has its distribution, its upper left corner and the steps from texel to texel.
  const GridDistribution* image_ = nullptr;
  Vec2 corner_, step_;
  Vec2 turn_{1, 0};  // cosine and sine of the rotation, counterclockwise
};

}  // namespace etd
