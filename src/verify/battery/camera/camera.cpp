// The rays of cameras: of unit length whatever the sample, the same for the same sample, all those of a point of the
// film through one point, and the law by which each kind of camera spreads the film over directions or positions.
#include "verify/battery/camera/camera.h"

#include <fmt/format.h>

#include "core/hash.h"
#include "verify/battery/camera/model.h"
#include "verify/battery/worst.h"

namespace etd {

namespace {

constexpr int kWidth = CameraModel::kFilmWidth, kHeight = CameraModel::kFilmHeight;
const Vec2 kMiddle{0.5f, 0.5f};  // of the lens
constexpr float kTime = 0.5f;

Point3d along(const Ray& r, double t) { return to_double(r.o) + to_double(r.d) * t; }

void check_rays(const CameraModel& camera, uint64_t seed, Worst& finite, Worst& same) {
  HashStream numbers(seed);
  for (int i = 0; i < 4000; ++i) {
    const auto edge = [&](float v) { return i % 4 == 0 ? std::round(v) * kOneMinusEpsilon : v; };
    const float x = edge(numbers.next_float()), y = edge(numbers.next_float()), time = edge(numbers.next_float());
    const Vec2 lens{edge(numbers.next_float()), edge(numbers.next_float())};
    const CameraSample s{{x * kWidth, y * kHeight}, lens, time};
    const Ray a = camera.generate_ray(s), b = camera.generate_ray(s);
    const auto where = [&] { return fmt::format("film ({}, {}), lens ({}, {})", s.film.x, s.film.y, lens.x, lens.y); };
    const bool sound = std::isfinite(a.o.x + a.o.y + a.o.z) && std::abs(length(a.d) - 1.0f) < 1e-5f &&
                       std::isfinite(a.time) && a.t_max > 0.0f;
    finite.add(sound ? 0.0 : 1.0, where);
    same.add(a.o == b.o && a.d == b.d && a.time == b.time ? 0.0 : 1.0, where);
  }
}

// Rays through different points of the lens meet in one point: their distance from the middle one along it falls to
// zero, at the same place for all.
void check_focus(const CameraModel& camera, Worst& focus) {
  for (const Vec2 film : {Vec2{12.0f, 8.0f}, Vec2{1.5f, 2.25f}, Vec2{20.0f, 15.0f}}) {
    const Ray middle = camera.generate_ray({film, kMiddle, kTime});
    double meeting = -1;
    HashStream numbers(11);
    for (int i = 0; i < 64; ++i) {
      const float x = numbers.next_float(), y = numbers.next_float();
      const Ray r = camera.generate_ray({film, {x, y}, kTime});
      const Vec3d apart = to_double(r.o) - to_double(middle.o), d = to_double(middle.d) - to_double(r.d);
      if (length(apart) < 1e-6 && length(d) < 1e-6) continue;  // no lens
      // The rays' directions have unit length, so they reach the focus after different lengths: solve for both.
      const Vec3d u = to_double(middle.d), v = to_double(r.d);
      const double uv = dot(u, v), det = 1.0 - uv * uv;
      if (det < 1e-8) continue;
      const double t = (dot(apart, u) - dot(apart, v) * uv) / det, s = (dot(apart, u) * uv - dot(apart, v)) / det;
      const double miss = length(along(middle, t) - along(r, s)) / t;
      const auto where = [&] { return fmt::format("film ({}, {}), lens ({}, {})", film.x, film.y, x, y); };
      focus.add(t > 0.0 && s > 0.0 ? miss : 1.0, where);
      if (meeting < 0) meeting = t;
      focus.add(0.01 * std::abs(t / meeting - 1.0), where);
    }
  }
}

// Solid angle per area of film, or for parallel rays area across the ray, relative to what the kind of camera promises.
struct Spread {
  double solid_angle, area;
};

Spread spread_at(const CameraModel& camera, Vec2 film) {
  constexpr float kStep = 0.0625f;
  const auto difference = [&](Vec2 axis) {
    const Ray a = camera.generate_ray({{film.x + axis.x, film.y + axis.y}, kMiddle, kTime});
    const Ray b = camera.generate_ray({{film.x - axis.x, film.y - axis.y}, kMiddle, kTime});
    return std::pair{(to_double(a.d) - to_double(b.d)) / (2.0 * static_cast<double>(kStep)),
                     (to_double(a.o) - to_double(b.o)) / (2.0 * static_cast<double>(kStep))};
  };
  const auto [dx, ox] = difference({kStep, 0});
  const auto [dy, oy] = difference({0, kStep});
  const Vec3d d = to_double(camera.generate_ray({film, kMiddle, kTime}).d);
  return {length(cross(dx, dy)), std::abs(dot(cross(ox, oy), d))};
}

// Where pixels are wider, or turn faster, differences say nothing about the derivative.
constexpr double kLargestPixel = 0.1, kSmallestCosine = 0.05;

// Film points away from edges and from lines where the maps have kinks.
template <class F>
void for_film(F&& f) {
  for (float x = 0.8f; x < kWidth; x += 1.37f)
    for (float y = 0.7f; y < kHeight; y += 1.21f) f(Vec2{x, y});
}

void check_spread(const CameraModel& camera, Worst& spread) {
  const auto film_text = [](Vec2 p) { return fmt::format("film ({}, {})", p.x, p.y); };
  if (camera.spread == FilmSpread::kFlat || camera.spread == FilmSpread::kParallel) {
    double constant = 0;
    for_film([&](Vec2 p) {
      const Spread s = spread_at(camera, p);
      const double c = static_cast<double>(dot(camera.generate_ray({p, kMiddle, kTime}).d, camera.axis));
      if (s.solid_angle > kLargestPixel || c < kSmallestCosine) return;
      const double law = camera.spread == FilmSpread::kFlat ? s.solid_angle / (c * c * c) : s.area;
      if (constant == 0) constant = law;
      spread.add_relative(law, constant, [&] { return film_text(p); });
    });
    return;
  }
  if (camera.spread == FilmSpread::kOther) return;
  const bool latlong = camera.spread == FilmSpread::kLatLong;
  for_film([&](Vec2 p) {
    const Vec3 d = camera.generate_ray({p, kMiddle, kTime}).d;
    const double sine = std::sqrt(std::max(1.0 - sqr(static_cast<double>(dot(d, camera.up))), 0.0));
    const double expected = latlong ? 2.0 * kPiD * kPiD * sine / (kWidth * kHeight) : 4.0 * kPiD / (kWidth * kHeight);
    // The equal-area square is folded along its diagonals and middle lines.
    const Vec2 st{std::abs(2.0f * p.x / kWidth - 1.0f), std::abs(2.0f * p.y / kHeight - 1.0f)};
    if (!latlong && (std::abs(st.x + st.y - 1.0f) < 0.1f || std::min(st.x, st.y) < 0.1f)) return;
    spread.add_relative(spread_at(camera, p).solid_angle, expected, [&] { return film_text(p); });
  });
}

}  // namespace

std::vector<CheckResult> check_camera(const CameraModel& camera, const BatteryOptions& options) {
  const std::string& name = camera.name;
  Worst finite(name, "finite, unit directions", 0.0), same(name, "the same for the same sample", 0.0);
  Worst focus(name, "rays of a film point meet", 2e-3), spread(name, "film to directions and area", 5e-3);
  check_rays(camera, options.seed, finite, same);
  check_focus(camera, focus);
  check_spread(camera, spread);
  std::vector<CheckResult> results{finite.result(), same.result(), focus.result(), spread.result()};
  for (CheckResult& r : check_importance(camera, options)) results.push_back(std::move(r));
  judge(results, options.family_level);
  return results;
}

std::vector<BatterySubject> camera_subjects() {
  std::vector<BatterySubject> subjects;
  for (const CameraSetting& setting : camera_settings())
    subjects.push_back({"camera", setting.use.model, setting.name, [setting](const BatteryOptions& options) {
                          const MadeCamera made = camera_model(setting);
                          if (!made.problem.empty())
                            return std::vector<CheckResult>{
                                {setting.name, "is made from its declaration", false, 0.0, {}, made.problem, nullptr}};
                          return check_camera(made.model, options);
                        }});
  return subjects;
}

}  // namespace etd
