#include "cameras/aperture.h"

#include <fmt/format.h>

#include "core/warp.h"
#include "io/layer_param.h"
#include "io/named_images.h"

namespace etd {

namespace {

constexpr int kMostBlades = 64;

float cosine(double degrees) { return static_cast<float>(std::cos(radians(degrees))); }

bool is_shape(const std::string& name) {
  return name == "gaussian" || name == "square" || name == "pentagon" || name == "star";
}

}  // namespace

std::vector<ParamDecl> Aperture::params() {
  return {
      {.name = "blades",
       .type = ParamType::kInteger,
       .default_value = 0,
       .min = 0,
       .max = kMostBlades,
       .doc = "Corners of the lens's opening, a regular polygon in the circle of lensradius; 0: it is round. (Of "
              "Etendue, not of pbrt.)"},
      {.name = "bladerotation",
       .default_value = 0.0,
       .unit = "degrees",
       .doc = "Rotation of the opening, counterclockwise as the camera sees it; at 0 the first corner is up. (Of "
              "Etendue, not of pbrt.)"},
      {.name = "aperture",
       .type = ParamType::kString,
       .doc = "The opening as an image, whose longer side is 2 lensradius and whose values (the mean of R, G and B) "
              "are the density of rays, or one of the shapes gaussian, square, pentagon and star of pbrt's realistic "
              "camera. (Of Etendue, not of pbrt.)"},
      layer_param("aperture")};
}

Aperture Aperture::create(const ParamReader& p, const ImageSource& images, CameraData& data) {
  const Param* file = p.given("aperture");
  const Param* blades = p.given("blades");
  const int corners = p.integer("blades");
  Aperture a;
  if (!file || is_shape(file->strings[0])) reject_layer_without_file(p, "aperture");
  if (file && corners > 0)
    p.diagnostics().error(blades->loc, "an opening has \"blades\" or an \"aperture\", not both");
  else if (file)
    a = is_shape(file->strings[0]) ? named(file->strings[0], data) : of_file(p, *file, images, data);
  else if (corners == 1 || corners == 2)
    p.diagnostics().error(blades->value_loc, fmt::format("{} blades leave no opening", corners),
                          "valid: 0 (round), or 3 and more");
  else if (corners > 0)
    a = star(corners, 1.0f, cosine(180.0 / corners));
  const double turn = p.number("bladerotation");
  a.turn_ = {cosine(turn), static_cast<float>(std::sin(radians(turn)))};
  return a;
}

Aperture Aperture::star(int points, float outer, float inner) {
  Aperture a;
  a.shape_ = Shape::kStar;
  a.points_ = points;
  a.outer_ = outer;
  a.inner_ = outer * inner;
  return a;
}

Aperture Aperture::named(const std::string& name, CameraData& data) {
  if (name == "pentagon") return star(5, 0.8f, cosine(36));
  if (name == "star") return star(5, 1.0f, cosine(72) / cosine(36));
  constexpr int kSide = 256;
  std::vector<double> weights;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const double s = (2.0 * x + 1.0) / kSide - 1.0, t = (2.0 * y + 1.0) / kSide - 1.0;
      weights.push_back(name == "square" ? std::max(std::abs(s), std::abs(t)) < 0.5
                                         : std::max(0.0, std::exp(-s * s - t * t) - std::exp(-1.0)));
    }
  return of_weights(kSide, kSide, weights, data);
}

Aperture Aperture::of_weights(int width, int height, const std::vector<double>& weights, CameraData& data) {
  Aperture a;
  a.shape_ = Shape::kImage;
  a.image_ = &data.apertures.emplace_back(width, height, weights);
  const auto longer = static_cast<float>(std::max(width, height));
  a.corner_ = {-static_cast<float>(width) / longer, static_cast<float>(height) / longer};
  a.step_ = {2.0f / longer, -2.0f / longer};
  return a;
}

Aperture Aperture::of_file(const ParamReader& p, const Param& file, const ImageSource& images, CameraData& data) {
  static const std::string valid = "valid: an image file, or gaussian, square, pentagon, star";
  const std::shared_ptr<const Image> read = read_named_image(p, file, images, valid);
  if (!read) return {};
  const Image& image = *read;
  const int colours = std::min(image.channels(), 3);
  std::vector<double> weights;
  double total = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      double sum = 0;
      for (int c = 0; c < colours; ++c) sum += image.texel(x, y, c);
      weights.push_back(std::max(0.0, sum / colours));
      total += weights.back();
    }
  if (!(total > 0)) {
    p.diagnostics().error(file.value_loc, fmt::format("image \"{}\" can't be an opening: it is black", file.strings[0]),
                          valid);
    return {};
  }
  return of_weights(image.width(), image.height(), weights, data);
}

Vec2 Aperture::sample_round(Vec2 u) { return sample_disk_concentric(u); }

Vec2 Aperture::star_corner(int i) const {
  const float angle = kPi / 2 + kPi * static_cast<float>(i) / static_cast<float>(points_);
  const float radius = i % 2 == 0 ? outer_ : inner_;
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

// The star is 2 points_ triangles of equal area around its middle.
Vec2 Aperture::sample_star(Vec2 u) const {
  const float scaled = u.x * static_cast<float>(2 * points_);
  const int sector = std::min(static_cast<int>(scaled), 2 * points_ - 1);
  const Vec2 b = sample_triangle_uniform({std::min(scaled - static_cast<float>(sector), kOneMinusEpsilon), u.y});
  const Vec2 p = star_corner(sector), q = star_corner(sector + 1);
  return {b.x * p.x + b.y * q.x, b.x * p.y + b.y * q.y};
}

Vec2 Aperture::sample_image(Vec2 u) const {
  const GridDistribution::Sample s = image_->sample(u);
  return {corner_.x + step_.x * (static_cast<float>(s.x) + s.offset.x),
          corner_.y + step_.y * (static_cast<float>(s.y) + s.offset.y)};
}

float Aperture::density(Vec2 p) const {
  if (shape_ == Shape::kRound) return p.x * p.x + p.y * p.y <= 1.0f ? pdf_disk() : 0.0f;
  const Vec2 q{turn_.x * p.x + turn_.y * p.y, turn_.x * p.y - turn_.y * p.x};
  return shape_ == Shape::kStar ? density_star(q) : density_image(q);
}

float Aperture::density_star(Vec2 p) const {
  // The triangle whose sector p is in, and whether p is on the middle's side of the line between its corners.
  const float sectors = static_cast<float>(2 * points_);
  const float turns = (std::atan2(p.y, p.x) - kPi / 2) / (2.0f * kPi);
  const auto sector = static_cast<int>((turns - std::floor(turns)) * sectors);
  const Vec2 a = star_corner(sector), b = star_corner(sector + 1);
  if ((b.x - a.x) * (p.y - a.y) < (b.y - a.y) * (p.x - a.x)) return 0.0f;
  return 1.0f / (0.5f * sectors * (a.x * b.y - a.y * b.x));
}

float Aperture::density_image(Vec2 p) const {
  const float x = std::floor((p.x - corner_.x) / step_.x), y = std::floor((p.y - corner_.y) / step_.y);
  if (!(x >= 0.0f && x < static_cast<float>(image_->width()) && y >= 0.0f && y < static_cast<float>(image_->height())))
    return 0.0f;
  return image_->probability(static_cast<int>(x), static_cast<int>(y)) / std::abs(step_.x * step_.y);
}

}  // namespace etd
