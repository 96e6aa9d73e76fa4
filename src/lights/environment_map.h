// Radiance (or intensity) by direction from an image: constant over each texel, so that what is evaluated, sampled and
// integrated is one and the same function, exactly.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/distribution.h"
#include "core/equal_area.h"
#include "io/image.h"
#include "lights/light.h"

namespace etd {

class EnvironmentMap {
 public:
  // How texels lie on the sphere of directions; row 0 is the image's top.
  enum class Layout : uint8_t {
    // Square (core/equal_area.h): +z in the middle, -z in the corners, +x to the right, +y down.
    kEqualArea,
    // Twice as wide as high: theta = pi v from +z down the rows, phi = 2 pi u from +x towards +y along them.
    kLatLong
  };
  // Tells the layout by the image's proportions; nothing for others.
  static std::optional<Layout> layout_of(int width, int height);

  // The image's colours, negative ones as 0. Its proportions are those of a layout, and its values are finite.
  explicit EnvironmentMap(const Image& image);

  int height() const { return height_; }
  // The value in the unit direction w.
  Spectrum value(Vec3 w) const;
  // A direction in proportion to the mean of R, G and B, or to what exceeds its average when `sampling` is
  // kCompensated; nothing when the map is black.
  std::optional<Vec3> sample(Vec2 u, LightSampling sampling) const;
  // Density of sample() at the unit direction w, per solid angle.
  float pdf(Vec3 w, LightSampling sampling) const;

  // Returns the integral over all directions, in sr times the unit of the values.
  Spectrum integral() const { return integral_; }
  // Irradiance on a surface whose normal is +z.
  Spectrum irradiance_up() const;
  size_t bytes() const { return texels_.size() * sizeof(texels_[0]) + full_.bytes() + compensated_.bytes(); }

 private:
  struct Cell {
    int x, y;
  };
  Cell cell_of(Vec3 w) const;
  Vec3 direction(const GridDistribution::Sample& at) const;
  void set_solid_angles();
  const GridDistribution& distribution(LightSampling s) const {
    return s == LightSampling::kComplete ? full_ : compensated_;
  }

  Layout layout_;
  int width_, height_;
  std::vector<std::array<float, 3>> texels_;
  std::vector<double> solid_angles_;  // of a texel, for each row
  std::vector<double> row_cosines_;   // of theta above each row and below the last, for kLatLong
  GridDistribution full_, compensated_;
  Spectrum integral_;
};

// Which image of which file a light with a "filename" means.
std::filesystem::path light_image_key(const ParamReader& params, const std::filesystem::path& folder);
// Reads the image of a light's "filename", with finite values. Reports what keeps it from being one, and then gives
// null.
std::shared_ptr<const Image> read_light_image(const ParamReader& params, const ImageSource& source,
                                              const LightData& data);
// The same as a map of directions, which context.data keeps, read once for all lights of one file; null on failure.
const EnvironmentMap* read_environment(const ParamReader& params, const LightContext& context);

}  // namespace etd
