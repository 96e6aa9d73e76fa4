#include "scene/check_precision.h"

#include <fmt/format.h>

#include "core/hash.h"

namespace etd {

namespace {

constexpr int kSide = 32;  // of the grid of rays

struct Tally {
  int met = 0, unsure = 0;
  double error = 0, distance = 0, pixel = 0;  // where it is worst
};

// The larger of the steps to the neighbouring pixels at the distance t; parallels of a sphere meet at its poles.
double pixel_at(const Camera& camera, const CameraSample& at, const Ray& ray, float t) {
  double size = 0;
  for (const Vec2 step : {Vec2{1, 0}, Vec2{0, 1}}) {
    CameraSample next = at;
    next.film = {at.film.x + step.x, at.film.y + step.y};
    const Ray r = camera.generate_ray(next);
    const double along = static_cast<double>(t);
    size = std::max(size, length(to_double(r.o - ray.o) + (to_double(r.d) - to_double(ray.d)) * along));
  }
  return size;
}

}  // namespace

void check_precision(const Scene& scene, const SceneNames& names, int width, int height, Diagnostics& diagnostics) {
  std::vector<Tally> tallies(names.shapes.size());
  HashStream random(1);
  // What composing transforms in double leaves of the position.
  const double composed = 0x1p-51 * max_component(abs(scene.origin));
  for (int i = 0; i < kSide * kSide; ++i) {
    const auto share = [](int k) { return (static_cast<float>(k) + 0.5f) / kSide; };
    const CameraSample at{{share(i % kSide) * static_cast<float>(width), share(i / kSide) * static_cast<float>(height)},
                          {0.5f, 0.5f},
                          random.next_float()};
    const Ray ray = scene.camera.generate_ray(at);
    Hit hit;
    if (!scene.intersect(ray, hit)) continue;
    // The bound for points of the surface, and the rounding of the ray's direction.
    const double distance = static_cast<double>(hit.t), pixel = pixel_at(scene.camera, at, ray, hit.t);
    const double error =
        static_cast<double>(surface_point(scene.geometry, hit).p_error) + 0x1p-24 * distance + composed;
    Tally& tally = tallies[scene.binding_of(hit).shape];
    ++tally.met;
    if (!(error > 0.5 * pixel)) continue;
    ++tally.unsure;
    if (!(error * tally.pixel <= tally.error * pixel) || tally.unsure == 1)
      tally.error = error, tally.distance = distance, tally.pixel = pixel;
  }
  for (size_t s = 0; s < tallies.size(); ++s) {
    const Tally& t = tallies[s];
    if (2 * t.unsure <= t.met) continue;
    diagnostics.warning(
        names.shapes[s].loc,
        fmt::format("this {} is met up to {:.2g} away from its place, where a pixel is {:.2g} wide, {:.2g} from the "
                    "camera: shadows and edges on it may be wrong",
                    names.shapes[s].model, t.error, t.pixel, t.distance),
        "coordinates are rounded to 24 bits from the camera on, and to 53 from the origin of the file");
  }
}

}  // namespace etd
