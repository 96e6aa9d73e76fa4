// A slide projector without a lens: an image as intensity within a pyramid.
#pragma once

#include "lights/light_data.h"
#include "lights/point_lights.h"

namespace etd {

struct ProjectionIntensity {
  const Image* image = nullptr;
  const GridDistribution* texels = nullptr;  // in proportion to the mean of R, G and B, and to their solid angles
  Frame axes;                    // of the light, in the world: the image is seen along +z with +x right and +y up
  float half_x = 1, half_y = 1;  // of the image at z = 1
  float scale = 1;

  static const ModelDecl& decl() {
    static const ModelDecl d{Family::kLight,
                             "projection",
                             "An image projected from one point along the light's +z.",
                             {filename_param("Image of the radiant intensity, in W/sr.", true),
                              layer_param(),
                              {.name = "fov",
                               .default_value = 90.0,
                               .min = 0,
                               .max = 180,
                               .above_min = true,
                               .unit = "degrees",
                               .doc = "Angle across the shorter side of the image; below 180."},
                              scale_param(),
                              power_param()}};
    return d;
  }
  // Makes the intensity of an image that reaches so far from the axis at z = 1; a slide without its distribution gets
  // one, kept by `data`.
  static ProjectionIntensity of(LightData::Slide& slide, const Frame& axes, float half_x, float half_y,
                                LightData& data);
  static std::optional<PointLight<ProjectionIntensity>> create(const ParamReader& p, const LightContext& context);

  Spectrum intensity(Vec3 w, const ShadingContext&) const;
  std::optional<Vec3> sample(Vec2 u) const;
  float pdf(Vec3 w) const;
  Spectrum power() const;
  void bound(LightBounds& b) const;

 private:
  struct Cell {
    int x, y;
  };
  // The texel in the local direction v; nothing beside the image.
  std::optional<Cell> cell_of(Vec3 v) const;
  Spectrum texel(int x, int y) const;
  double solid_angle(int x, int y) const;  // of a texel
};

}  // namespace etd
