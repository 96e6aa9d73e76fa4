// The importance of cameras against their rays, one by one.
#include <fmt/format.h>

#include "verify/battery/camera/checks.h"

namespace etd {

namespace {

constexpr int kWidth = CameraModel::kFilmWidth, kHeight = CameraModel::kFilmHeight;

std::string text(const CameraSample& s) {
  return fmt::format("film ({}, {}), lens ({}, {}), time {}", s.film.x, s.film.y, s.lens.x, s.lens.y, s.time);
}

// The share of cases that go wrong, with the first of them. At the rims of openings, texels and film rounding decides.
class WrongShare {
 public:
  WrongShare(const std::string& subject, const std::string& name) : worst_(subject, name, 2e-3) {}
  template <class F>
  void add(bool wrong, F&& where) {
    ++cases_;
    if (!wrong) return;
    if (wrong_++ == 0) first_ = where();
  }
  CheckResult result() {
    worst_.add(cases_ > 0 ? static_cast<double>(wrong_) / static_cast<double>(cases_) : 1.0, [&] { return first_; });
    return worst_.result();
  }

 private:
  Worst worst_;
  size_t cases_ = 0, wrong_ = 0;
  std::string first_ = "no case at all";
};

bool differ(double a, double b, double relative) { return !(std::abs(a - b) <= relative * std::max(a, b)); }

// How rays change from pixel to pixel: solid angle and area per pixel, and the smaller angle of both steps.
struct FilmSteps {
  double solid_angle, area, angle;
};

FilmSteps film_steps(const CameraModel& m, const CameraSample& s) {
  constexpr float kStep = 0.03125f;
  const auto step = [&](Vec2 axis) {
    CameraSample a = s, b = s;
    a.film = {s.film.x + axis.x, s.film.y + axis.y};
    b.film = {s.film.x - axis.x, s.film.y - axis.y};
    const Ray p = m.generate_ray(a), q = m.generate_ray(b);
    const double scale = 0.5 / static_cast<double>(kStep);
    return std::pair{(to_double(p.d) - to_double(q.d)) * scale, (to_double(p.o) - to_double(q.o)) * scale};
  };
  const auto [dx, ox] = step({kStep, 0});
  const auto [dy, oy] = step({0, kStep});
  return {length(cross(dx, dy)), length(cross(ox, oy)), std::min(length(dx), length(dy))};
}

bool is_flat(const CameraModel& m) { return m.spread == FilmSpread::kFlat || m.spread == FilmSpread::kParallel; }

// Whether the differences are derivatives: not in wide pixels, nor in those so narrow that rounding shows, nor at the
// poles of a map and the folds of another.
bool are_derivatives(const CameraModel& m, const CameraSample& s, const FilmSteps& steps) {
  if (m.spread == FilmSpread::kParallel) return true;
  if (steps.solid_angle > 0.04 || steps.angle < 1e-3) return false;
  const Vec2 st{std::abs(2.0f * s.film.x / kWidth - 1.0f), std::abs(2.0f * s.film.y / kHeight - 1.0f)};
  if (m.spread != FilmSpread::kEqualArea) return m.spread == FilmSpread::kFlat || st.y < 0.9f;
  return std::abs(st.x + st.y - 1.0f) > 0.1f && std::min(st.x, st.y) > 0.1f;
}

void check_rays_back(const CameraModel& m, uint64_t seed, WrongShare& film, WrongShare& density) {
  HashStream numbers(seed);
  for (int i = 0; i < 4000; ++i) {
    CameraSample s = next_sample(numbers);
    if (i % 2 == 0) s.time = 0.5f;  // when the axis is known
    const Ray ray = m.generate_ray(s);
    // The film is looked up within a margin: where a pixel is seen nearly edge on, rounding carries film points beyond
    // the edge.
    const auto found = m.we(ray, 1);
    const auto where = [&] { return text(s); };
    film.add(found.has_value() == m.blurs_alike, where);
    if (!found) continue;
    const Ray again = m.generate_ray({found->film, s.lens, s.time});
    film.add(!(length(again.d - ray.d) < 2e-6f && length(again.o - ray.o) < 1e-5f), where);
    const bool sound = std::isfinite(found->we()) && found->we() > 0.0f && found->pdf_position > 0.0f &&
                       found->pdf_direction > 0.0f && found->cosine > 0.0f && found->cosine < 1.00001f;
    density.add(!sound, where);
    if (s.time == 0.5f)
      density.add(!(std::abs(found->cosine - (is_flat(m) ? dot(ray.d, m.axis) : 1.0f)) < 1e-4f), where);
    const FilmSteps steps = film_steps(m, s);
    if (is_sideways(m, ray.d) || !are_derivatives(m, s, steps)) continue;
    const bool parallel = m.spread == FilmSpread::kParallel;
    density.add(
        differ((parallel ? found->pdf_position * steps.area : found->pdf_direction * steps.solid_angle), 1.0, 0.01),
        where);
    if (!m.lens) density.add((parallel ? found->pdf_direction : found->pdf_position) != 1.0f, where);
  }
}

void check_ways_back(const CameraModel& m, uint64_t seed, WrongShare& same) {
  HashStream numbers(seed);
  for (int i = 0; i < 4000; ++i) {
    const CameraSample s = next_sample(numbers);
    const Ray ray = m.generate_ray(s);
    const float far = 0.5f + 4.0f * numbers.next_float();
    const auto where = [&] { return fmt::format("{}, from distance {}", text(s), far); };
    const Point3 p = ray.o + ray.d * far;
    const auto c = m.sample_wi(p, s.lens, ray.time, 1);
    same.add(!c, where);
    if (!c) continue;
    // The film point through the same point of the lens, the same direction and distance.
    same.add(!(length(c->wi + ray.d) < 3e-6f) || differ(c->distance, far, 1e-5), where);
    same.add(c->is_delta != !m.lens || (c->is_delta && c->pdf != 1.0f), where);
    const double position = c->importance.pdf_position, direction = c->importance.pdf_direction;
    const double cosine = c->importance.cosine, d2 = sqr(double{c->distance});
    const bool parallel = m.spread == FilmSpread::kParallel;
    if (!c->is_delta)
      same.add(differ(double{c->weight} * double{c->pdf}, position * direction / cosine, 1e-4), where);
    else
      same.add(differ(c->weight, parallel ? position / cosine : direction / d2, 1e-4), where);
    // The ray back starts at the very point of the lens: p + wi distance would be beside it by the rounding of p, and a
    // camera at the origin has none.
    const auto back = m.we(Ray{ray.o, -c->wi, kInfinity, ray.time}, 2);
    same.add(!back && !m.blurs_alike, where);
    if (back) same.add(differ(back->we(), c->importance.we(), 1e-3), where);
  }
}

// Rays and points of which the camera must know nothing.
void check_strangers(const CameraModel& m, uint64_t seed, WrongShare& nothing) {
  HashStream numbers(seed);
  for (int i = 0; i < 1000; ++i) {
    const CameraSample s = next_sample(numbers);
    const Ray ray = m.generate_ray(s);
    const auto expect_nothing = [&](const Ray& r, const char* what) {
      nothing.add(m.we(r, 0).has_value(), [&] { return fmt::format("{}, {}", text(s), what); });
    };
    Ray before = ray;
    before.o = ray.o + m.axis * 0.01f;
    expect_nothing(before, "from in front of the lens");
    if (m.spread != FilmSpread::kParallel) {
      Ray beside = ray;
      beside.o = ray.o + m.up * 2.5f;
      expect_nothing(beside, "from beside the lens");
    }
    if (!is_flat(m)) continue;
    Ray backwards = ray;
    backwards.d = -ray.d;
    expect_nothing(backwards, "backwards");
    const Point3 behind = ray.o - ray.d * (0.1f + 3.0f * numbers.next_float());
    nothing.add(m.sample_wi(behind, s.lens, ray.time, 0).has_value(), [&] { return text(s) + ", a point behind"; });
    CameraSample out = s;
    const float off = 0.01f + 0.9f * numbers.next_float();
    if (i % 2 == 0)
      out.film.x = i % 4 == 0 ? -off : kWidth + off;
    else
      out.film.y = i % 4 == 1 ? -off : kHeight + off;
    const Ray outside = m.generate_ray(out);
    if (is_sideways(m, outside.d)) continue;
    expect_nothing(outside, "beyond the film");
    nothing.add(m.we(outside, 1).has_value() == m.blurs_alike, [&] { return text(out) + ", within the margin"; });
  }
}

}  // namespace

std::vector<CheckResult> check_importance(const CameraModel& m, const BatteryOptions& options) {
  constexpr double kSamples = 200000;
  WrongShare film(m.name, "rays tell their film point"), density(m.name, "importance = density"),
      same(m.name, "sample_wi = we"), nothing(m.name, "no importance elsewhere");
  WorstP connected(m.name, "sample_wi = rays"), chance(m.name, "we = rays");
  check_rays_back(m, hash_combine(options.seed, 1), film, density);
  check_ways_back(m, hash_combine(options.seed, 2), same);
  check_strangers(m, hash_combine(options.seed, 3), nothing);
  check_measurement(m, static_cast<size_t>(options.samples * kSamples), hash_combine(options.seed, 4), connected,
                    chance);
  std::vector<CheckResult> results{film.result(), same.result(), nothing.result()};
  if (!m.blurs_alike) results.push_back(density.result());
  for (const WorstP* measured : {&connected, &chance})
    if (measured->any()) results.push_back(measured->result());
  return results;
}

}  // namespace etd
