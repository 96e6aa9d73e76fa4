#include "lights/examples.h"

#include "lights/constant_infinite.h"
#include "lights/diffuse_area.h"

namespace etd {

namespace {

LightExample triangle(std::string name, bool two_sided, bool flip, const Point3 (&p)[3]) {
  Mesh m;
  m.positions = {p[0], p[1], p[2]};
  m.triangles = {{0, 1, 2}};
  m.flip_ng = flip;
  auto mesh = std::make_shared<const Mesh>(std::move(m));
  const DiffuseAreaLight<TriangleSurface> light{Spectrum::rgb(3.0f, 1.0f, 0.2f), TriangleSurface(*mesh, 0), two_sided};
  return {std::move(name), Light(light), mesh, nullptr};
}

LightExample sphere(std::string name, bool two_sided, bool flip, const Transform& t) {
  auto s = std::make_shared<const Sphere>(Sphere{Affine(t.matrix()), Affine(t.inverse_matrix()), flip});
  const DiffuseAreaLight<SphereSurface> light{Spectrum::rgb(0.5f, 1.0f, 2.0f), SphereSurface(*s), two_sided};
  return {std::move(name), Light(light), nullptr, s};
}

std::vector<LightExample> make_examples() {
  const Transform half = Transform::scale({0.5, 0.5, 0.5});
  const Transform egg =
      Transform::translate({0.1, -0.2, 0.1}) * Transform::rotate(40, {1, 2, 3}) * Transform::scale({0.4, 0.9, -0.6});
  const Point3 plain[3] = {{-1.0f, -0.8f, 0.1f}, {1.2f, -0.5f, -0.1f}, {0.1f, 1.1f, 0.2f}};
  const Point3 thin[3] = {{-1.5f, 0.0f, 0.3f}, {1.5f, 0.02f, 0.3f}, {0.2f, 0.1f, -0.3f}};
  return {
      triangle("diffuse(triangle)", false, false, plain),
      triangle("diffuse(triangle, flipped)", false, true, plain),
      triangle("diffuse(triangle, two-sided)", true, false, plain),
      triangle("diffuse(thin triangle, two-sided)", true, false, thin),
      sphere("diffuse(sphere)", false, false, half),
      sphere("diffuse(sphere, inward)", false, true, half),
      sphere("diffuse(sphere, two-sided)", true, false, half),
      sphere("diffuse(ellipsoid)", false, false, egg),
      sphere("diffuse(ellipsoid, two-sided)", true, true, egg),
      {"infinite(constant)", Light(ConstantInfiniteLight{Spectrum::rgb(0.3f, 1.0f, 4.0f)}), nullptr, nullptr},
  };
}

}  // namespace

std::span<const LightExample> light_examples() {
  static const std::vector<LightExample> examples = make_examples();
  return examples;
}

}  // namespace etd
