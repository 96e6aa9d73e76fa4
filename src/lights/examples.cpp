#include "lights/examples.h"

#include <array>

#include "core/hash.h"
#include "lights/light_list.h"

namespace etd {

namespace {

LightExample triangle(std::string name, bool two_sided, bool flip, const Point3 (&p)[3]) {
  Mesh m;
  m.positions = {p[0], p[1], p[2]};
  m.triangles = {{0, 1, 2}};
  m.flip_ng = flip;
  auto mesh = std::make_shared<const Mesh>(std::move(m));
  const AreaEmission emission{Spectrum::rgb(3.0f, 1.0f, 0.2f), nullptr, two_sided};
  const DiffuseAreaLight<TriangleSurface> light(emission, TriangleSurface(*mesh, 0));
  return {std::move(name), Light(light), mesh, nullptr};
}

LightExample patch(std::string name, bool two_sided, const std::array<Point3, 4>& p) {
  PatchMesh m;
  m.positions.assign(p.begin(), p.end());
  m.patches = {{0, 1, 2, 3}};
  auto mesh = std::make_shared<const PatchMesh>(std::move(m));
  const AreaEmission e{Spectrum::rgb(2.0f, 1.0f, 0.5f), nullptr, two_sided};
  LightExample example{std::move(name), Light(DiffuseAreaLight<PatchSurface>(e, PatchSurface(*mesh, 0))), nullptr,
                       nullptr};
  example.patches = std::move(mesh);
  return example;
}

LightExample quadric(std::string name, bool two_sided, bool flip, const Transform& t, const QuadricPart& part = {}) {
  auto q = std::make_shared<const Quadric>(t, flip, part);
  const AreaEmission emission{Spectrum::rgb(0.5f, 1.0f, 2.0f), nullptr, two_sided};
  return {std::move(name), Light(DiffuseAreaLight<QuadricSurface>(emission, QuadricSurface(*q))), nullptr, q};
}

// Values from 0 to 4, many of them 0, one of them large.
Image uneven_image(int width, int height) {
  HashStream numbers(7);
  std::vector<float> values;
  for (int i = 0; i < width * height * 3; ++i) values.push_back(std::max(0.0f, 5.0f * numbers.next_float() - 1.0f));
  values[static_cast<size_t>(width * height / 2 * 3 + 3)] = 30.0f;
  return {width, height, 3, std::move(values)};
}

const Frame& turned() {
  static const Frame frame = Frame::from_z(normalize(Vec3{1, -2, 0.5f}));
  return frame;
}

LightExample sky(std::string name, int width, int height, LightSampling sampling) {
  auto data = std::make_shared<LightData>();
  const EnvironmentMap& map = data->environments.emplace_back(uneven_image(width, height));
  return {std::move(name), Light(ImageInfiniteLight{&map, turned(), 0.5f}), nullptr, nullptr, data, sampling};
}

LightExample portal(std::string name, int width, int height) {
  auto data = std::make_shared<LightData>();
  const EnvironmentMap& map = data->environments.emplace_back(uneven_image(width, height));
  const Portal window{{-0.5f, -0.6f, 0.4f}, Frame::from_z(normalize(Vec3{0.2f, -0.4f, 1})), 1.2f, 0.7f};
  const PortalMap& seen = data->portals.emplace_back(map, turned(), window);
  LightExample example{std::move(name), Light(PortalInfiniteLight{&seen, 0.5f}), nullptr, nullptr, data};
  example.through_portal = true;
  return example;
}

LightExample goniometric(std::string name) {
  auto data = std::make_shared<LightData>();
  const EnvironmentMap& map = data->environments.emplace_back(uneven_image(4, 4));
  const GoniometricIntensity intensity{Spectrum::rgb(1.0f, 2.0f, 3.0f), &map, turned()};
  return {std::move(name), Light(PointLight<GoniometricIntensity>{{-0.4f, 0.6f, 0.1f}, intensity}), nullptr, nullptr,
          data};
}

LightExample projection() {
  auto data = std::make_shared<LightData>();
  LightData::Slide slide{data->keep(std::make_shared<const Image>(uneven_image(6, 3))), nullptr};
  ProjectionIntensity intensity = ProjectionIntensity::of(slide, turned(), 1.6f, 0.8f, *data);
  intensity.scale = 2.0f;
  return {"projection", Light(PointLight<ProjectionIntensity>{{0.5f, 0.2f, -0.3f}, intensity}), nullptr, nullptr, data};
}

LightExample spot(std::string name, float cos_inner, float cos_outer) {
  const SpotIntensity intensity{Spectrum::rgb(3.0f, 2.0f, 1.0f), turned().z, cos_inner, cos_outer};
  return {std::move(name), Light(PointLight<SpotIntensity>{{0.3f, 0.1f, 0.9f}, intensity}), nullptr, nullptr};
}

// A rectangle turned in space, of two triangles, with an image or without.
LightExample rectangle(std::string name, bool textured, bool two_sided, bool invisible = false) {
  auto data = std::make_shared<LightData>();
  Mesh m;
  const Frame& f = turned();
  for (const Vec2 at : {Vec2{-0.7f, -0.4f}, Vec2{0.7f, -0.4f}, Vec2{0.7f, 0.4f}, Vec2{-0.7f, 0.4f}}) {
    const Vec3 v = f.x * at.x + f.y * at.y;
    m.positions.push_back({v.x, v.y, v.z});
    m.uvs.push_back({at.x / 1.4f + 0.5f, at.y / 0.8f + 0.5f});
  }
  m.triangles = {{0, 1, 2}, {0, 2, 3}};
  auto mesh = std::make_shared<const Mesh>(std::move(m));
  const Image* image = textured ? data->keep(std::make_shared<const Image>(uneven_image(6, 3))) : nullptr;
  const AreaEmission emission{Spectrum::rgb(1.0f, 2.0f, 0.5f), image, two_sided, invisible};
  const RectangleSurface surface(data->rectangles.emplace_back(*LightRectangle::find(*mesh, 0)));
  const DiffuseAreaLight<RectangleSurface> light(emission, surface, 400);
  return {std::move(name), Light(light), mesh, nullptr, data};
}

LightExample textured_ball() {
  auto data = std::make_shared<LightData>();
  const Transform t = Transform::translate({0.1, 0.2, -0.1}) * Transform::scale({0.5, 0.5, 0.5});
  auto q = std::make_shared<const Quadric>(t, false);
  const AreaEmission emission{Spectrum(1.5f), data->keep(std::make_shared<const Image>(uneven_image(6, 3))), false};
  const DiffuseAreaLight<QuadricSurface> light(emission, QuadricSurface(*q), 400);
  return {"diffuse(sphere, image)", Light(light), nullptr, q, data};
}

// Puts the example in a space that is the world at time 0 and goes to `end`.
LightExample moving(LightExample example, const Transform& end, float time) {
  const TransformPath path = TransformPath().then(TransformPair(Transform(), end));
  example.motion = std::make_shared<const AnimatedTransform>(path, Vec3d{}, 2.0);
  example.light = example.light.moving(*example.motion);
  example.time = time;
  return example;
}

// The same of a light that changes its size: `make` gives it as it is under a transform.
template <class F>
LightExample growing(F make, const Transform& end, float time) {
  LightExample example = moving(make(Transform()), end, time);
  example.power_then = make(example.motion->at(time)).light.power();
  return example;
}

// A motion of the examples, under which they keep their size.
Transform turn() { return Transform::translate({0.3, 0.2, -0.2}) * Transform::rotate(100, {1, -1, 2}); }
// One that is not the same everywhere on them.
Transform stretch() { return turn() * Transform::scale({1.6, 0.6, 1.2}); }

LightExample stretching_triangle() {
  const auto under = [](const Transform& t) {
    const auto at = [&](double x, double y, double z) { return to_float(t.point({x, y, z})); };
    return triangle("diffuse(triangle, two-sided, stretching)", true, false,
                    {at(-1, -0.8, 0.1), at(1.2, -0.5, -0.1), at(0.1, 1.1, 0.2)});
  };
  return growing(under, stretch(), 0.7f);
}

LightExample stretching_patch() {
  const auto under = [](const Transform& t) {
    const auto at = [&](double x, double y, double z) { return to_float(t.point({x, y, z})); };
    return patch("diffuse(twisted patch, stretching)", false,
                 {at(-0.6, -0.9, 0.4), at(0.8, -0.7, -0.5), at(-0.9, 0.5, -0.4), at(0.7, 0.6, 0.7)});
  };
  return growing(under, stretch(), 0.4f);
}

LightExample growing_ball() {
  const auto under = [](const Transform& t) {
    return quadric("diffuse(sphere, growing)", false, false, t * Transform::scale({0.5, 0.5, 0.5}));
  };
  return growing(under, turn() * Transform::scale({2, 2, 2}), 0.6f);
}

LightExample turning_sky() {
  LightExample still = sky("infinite(latitude-longitude image, turning)", 12, 6, LightSampling::kComplete);
  return moving(std::move(still), Transform::rotate(100, {1, -1, 2}), 0.7f);
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
      rectangle("diffuse(rectangle)", false, false),
      rectangle("diffuse(rectangle, image, two-sided)", true, true),
      rectangle("diffuse(rectangle, two-sided, met by no ray)", false, true, true),
      textured_ball(),
      patch("diffuse(trapezoid)", false, {{{-1, -1, 0}, {1, -0.8f, 0}, {-0.3f, 0.6f, 0}, {0.4f, 0.67f, 0}}}),
      patch("diffuse(rectangular patch)", false,
            {{{-1, -0.5f, 0.2f}, {0.8f, -0.5f, 0.2f}, {-1, 0.5f, 0.2f}, {0.8f, 0.5f, 0.2f}}}),
      patch("diffuse(twisted patch, two-sided)", true,
            {{{-1, -0.9f, 0.4f}, {0.8f, -0.7f, -0.5f}, {-0.9f, 0.8f, -0.4f}, {1, 0.6f, 0.7f}}}),
      quadric("diffuse(sphere)", false, false, half),
      quadric("diffuse(sphere, inward)", false, true, half),
      quadric("diffuse(sphere, two-sided)", true, false, half),
      quadric("diffuse(ellipsoid)", false, false, egg),
      quadric("diffuse(ellipsoid, two-sided)", true, true, egg),
      quadric("diffuse(bowl)", false, true, half, {QuadricPart::Kind::kSphere, -0.9f, 0.3f, 4.0f}),
      quadric("diffuse(stretched bowl, two-sided)", true, false, egg, {QuadricPart::Kind::kSphere, 0.2f, 1.0f}),
      quadric("diffuse(cylinder)", false, false, half, {QuadricPart::Kind::kCylinder, -1.0f, 1.0f}),
      quadric("diffuse(gutter, two-sided)", true, false, egg, {QuadricPart::Kind::kCylinder, 0.0f, 1.0f, 2.0f}),
      quadric("diffuse(disk)", false, false, half, {QuadricPart::Kind::kDisk, 0.0f, 1.0f}),
      quadric("diffuse(ring, two-sided)", true, true, egg, {QuadricPart::Kind::kDisk, 0.4f, 1.0f, 5.0f}),
      stretching_triangle(),
      stretching_patch(),
      growing_ball(),
      {"infinite(constant)", Light(ConstantInfiniteLight{Spectrum::rgb(0.3f, 1.0f, 4.0f)}), nullptr, nullptr},
      sky("infinite(equal-area image)", 8, 8, LightSampling::kComplete),
      sky("infinite(equal-area image, compensated)", 8, 8, LightSampling::kCompensated),
      sky("infinite(latitude-longitude image)", 12, 6, LightSampling::kComplete),
      sky("infinite(latitude-longitude image, compensated)", 12, 6, LightSampling::kCompensated),
      turning_sky(),
      portal("infinite(portal, equal-area image)", 16, 16),
      portal("infinite(portal, latitude-longitude image)", 32, 16),
      {"distant", Light(DistantLight{turned().x, Spectrum::rgb(3.0f, 2.0f, 1.0f)}), nullptr, nullptr},
      {"point", Light(PointLight<IsotropicIntensity>{{1, 0.5f, -0.7f}, {Spectrum::rgb(3.0f, 2.0f, 1.0f)}}), nullptr,
       nullptr},
      spot("spot", 0.8f, 0.6f),
      spot("spot(hard edge)", 0.7f, 0.7f),
      spot("spot(wide)", 0.2f, -0.9f),
      goniometric("goniometric"),
      moving(goniometric("goniometric(turning)"), turn(), 0.3f),
      projection(),
  };
}

}  // namespace

std::span<const LightExample> light_examples() {
  static const std::vector<LightExample> examples = make_examples();
  return examples;
}

}  // namespace etd
