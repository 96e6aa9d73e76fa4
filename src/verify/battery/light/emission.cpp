// The battery over emission sampling: where paths from lights start. No picture shows it before there are such paths,
// so every ray is compared with what light samples and rays that look for the light know.
#include <fmt/format.h>

#include <algorithm>

#include "core/frame.h"
#include "core/hash.h"
#include "core/warp.h"
#include "verify/battery/direction_histogram.h"
#include "verify/battery/light/rays.h"

namespace etd {

namespace {

Vec2 next_2d(HashStream& numbers) {
  const float x = numbers.next_float(), y = numbers.next_float();
  return {x, y};
}

// Beyond everything that is near the origin, a portal too.
Point3 far_along(const Ray& ray) { return ray.o + ray.d * 8.0f; }

EmissionDensity density_of(const LightModel& m, const EmissionSample& s) {
  return m.pdf_le(m.infinite ? nullptr : &s.on_light, s.ray.d, far_along(s.ray));
}

void check_samples(const LightModel& m, uint64_t seed, Worst& finite, Worst& sound) {
  HashStream numbers(seed);
  std::optional<Point3> place;  // of a point
  for (int i = 0; i < 2000; ++i) {
    const Vec2 u = next_2d(numbers), v = next_2d(numbers);
    const auto where = [&] { return fmt::format("numbers ({}, {}), ({}, {})", u.x, u.y, v.x, v.y); };
    const auto s = m.sample_le(u, v);
    if (!s) continue;
    const bool positive = s->pdf_position > 0.0f && s->pdf_direction > 0.0f && s->cosine > 0.0f;
    const Spectrum weight = s->weight();
    finite.add(positive && is_finite(weight) && !is_black(weight) && is_finite(s->ray.d) ? 0.0 : 1.0, where);
    sound.add(std::abs(length(s->ray.d) - 1.0f), where);
    sound.add(s->ray.time == m.time ? 0.0 : 1.0, where);
    const EmissionDensity density = density_of(m, *s);
    sound.add_relative(density.position, s->pdf_position, where);
    sound.add_relative(density.direction, s->pdf_direction, where);
    if (!m.delta) {
      const Spectrum emitted = m.emitted(m.infinite ? nullptr : &s->on_light, s->ray.d, far_along(s->ray));
      for (int lane = 0; lane < 3; ++lane) sound.add_relative(emitted[lane], s->radiance[lane], where);
    }
    if (m.infinite) {
      // Rays start before the bounding sphere, in no part of which light may be missing, unless they say that they do
      // not.
      if (!s->starts_within)
        sound.add(std::max(0.0f, dot(s->ray.o - kTestScene.center, s->ray.d) + kTestScene.radius), where);
    } else {
      sound.add(length(s->ray.o - s->on_light.p), where);
      if (m.on_surface) sound.add(std::abs(std::abs(dot(s->on_light.ng, s->ray.d)) - s->cosine), where);
      if (!m.on_surface) sound.add(length(s->ray.o - place.value_or(s->ray.o)), where);
      place = s->ray.o;
    }
  }
}

// Checks directions from a few positions: around the normal there, where one is, so that the horizon is an edge of
// cells.
void check_directions(const LightModel& m, size_t samples, uint64_t seed, WorstP& chi_square, WorstP& mass) {
  HashStream positions(seed);
  const int count = m.on_surface ? 3 : 1;
  for (int i = 0; i < count; ++i) {
    std::optional<EmissionSample> first;
    Vec2 u;
    for (int attempt = 0; attempt < 100 && !first; ++attempt) {
      u = next_2d(positions);
      first = m.sample_le(u, next_2d(positions));
    }
    if (!first) continue;
    const Frame frame = m.on_surface ? Frame::from_z(first->on_light.ng) : Frame{};
    const SurfacePoint* on_light = m.infinite ? nullptr : &first->on_light;
    const auto draw = [&](HashStream& numbers) -> std::optional<Vec3> {
      const auto s = m.sample_le(u, next_2d(numbers));
      return s ? std::optional(frame.to_local(s->ray.d)) : std::nullopt;
    };
    // Where a sample would bring nothing, there is none.
    const auto pdf = [&](Vec3 local) {
      const Vec3 w = frame.to_world(local);
      const Point3 from = far_along({first->on_light.p, w});
      const bool shines = m.delta || !is_black(m.emitted(on_light, w, from));
      return shines ? static_cast<double>(m.pdf_le(on_light, w, from).direction) : 0.0;
    };
    const DirectionDensity density{
        .draw = draw, .pdf = pdf, .jumps = !m.on_surface, .cells = 64, .integration_error = 1e-3};
    check_direction_density(density, fmt::format("position {}", i), samples, hash_combine(seed, i), chi_square, mass);
  }
}

// A sum over samples (or random lines) for all of them and for those in each of eight parts around a middle.
struct Parts {
  RunningStats stats[9];

  void add(const std::array<double, 9>& values) {
    for (size_t i = 0; i < 9; ++i) stats[i].add(values[i]);
  }
  static size_t of(Vec3 from_middle) {
    return 1 + (from_middle.x > 0 ? 1 : 0) + (from_middle.y > 0 ? 2 : 0) + (from_middle.z > 0 ? 4 : 0);
  }
};

void compare(const RunningStats& samples, const RunningStats& others, const std::string& what, WorstP& out) {
  const double a = samples.mean(), b = others.mean();
  const double error2 =
      samples.variance_of_mean() + others.variance_of_mean() + sqr(1e-5 * (std::abs(a) + std::abs(b)));
  const double z = error2 > 0.0 ? (a - b) / std::sqrt(error2) : 0.0;
  out.add(z, normal_two_sided(z), [&] { return fmt::format("{}: emitted {:.6g}, expected {:.6g}", what, a, b); });
}

void compare(const Parts& samples, const Parts& others, const std::string& what, WorstP& out) {
  for (size_t i = 0; i < 9; ++i) compare(samples.stats[i], others.stats[i], fmt::format("{}, part {}", what, i), out);
}

// The middle of points, and the radius of a ball around it that has room for what few of them may have missed.
struct Ball {
  Vec3 middle;
  float radius = 0;

  explicit Ball(const std::vector<Vec3>& points) {
    for (const Vec3& p : points) middle = middle + p * (1.0f / static_cast<float>(points.size()));
    for (const Vec3& p : points) radius = std::max(radius, 1.3f * length(p - middle));
  }
};

// Random lines through a ball of radius r cross a surface in it so that the mean over them of the sum of h at their
// crossings is the integral of h over the surface / (2 pi r^2) (Crofton).
void check_positions_on_surface(const LightModel& m, const LightRays& rays, size_t samples, uint64_t seed,
                                WorstP& out) {
  HashStream numbers(seed);
  const auto draw = [&]() -> std::optional<Vec3> {
    const Vec2 u = next_2d(numbers), v = next_2d(numbers);
    const auto s = m.sample_le(u, v);
    return s ? std::optional(s->on_light.p - Point3{}) : std::nullopt;
  };
  std::vector<Vec3> pilots;
  for (int i = 0; i < 500; ++i)
    if (const auto p = draw()) pilots.push_back(*p);
  const Ball ball(pilots);
  // Where a sample would bring nothing, there is none.
  const auto density = [&](const SurfacePoint& s) {
    const bool shines = m.delta || !is_black(m.emitted(&s, s.ng, {}));
    return shines ? static_cast<double>(m.pdf_le(&s, s.ng, {}).position) : 0.0;
  };
  Parts sampled, expected;
  for (size_t i = 0; i < samples; ++i) {
    std::array<double, 9> values{};
    if (const auto p = draw()) values[0] = values[Parts::of(*p - ball.middle)] = 1.0;
    sampled.add(values);
  }
  for (size_t i = 0; i < 2 * samples; ++i) {
    const Vec3 n = sample_sphere_uniform(next_2d(numbers));
    const Vec3 d = Frame::from_z(-n).to_world(sample_hemisphere_cosine(next_2d(numbers)));
    std::array<double, 9> values{};
    rays.for_crossings(Point3{} + ball.middle + n * ball.radius, d, [&](const SurfacePoint& s) {
      const double value = 2.0 * kPiD * sqr(ball.radius) * density(s);
      values[0] += value;
      values[Parts::of(s.p - Point3{} - ball.middle)] += value;
    });
    expected.add(values);
  }
  compare(sampled, expected, "surface", out);
}

// Checks for one direction where its rays cross the plane through the scene's middle, against points spread evenly
// there. A portal is not looked at from so far aside that hardly any of these would see it.
void check_positions_across(const LightModel& m, size_t samples, uint64_t seed, WorstP& out) {
  HashStream numbers(seed);
  for (int i = 0; i < 3; ++i) {
    std::optional<EmissionSample> first;
    Vec2 v;
    for (int attempt = 0; attempt < 100 && !(first && first->cosine > 0.3f); ++attempt) {
      v = next_2d(numbers);
      first = m.sample_le(next_2d(numbers), v);
    }
    if (!first) continue;
    const Frame frame = Frame::from_z(first->ray.d);
    const auto draw = [&]() -> std::optional<Vec3> {
      const auto s = m.sample_le(next_2d(numbers), v);
      if (!s) return {};
      const Vec3 local = frame.to_local(s->ray.o - kTestScene.center);
      return Vec3{local.x, local.y, 0.0f};
    };
    std::vector<Vec3> pilots;
    for (int k = 0; k < 500; ++k)
      if (const auto p = draw()) pilots.push_back(*p);
    Ball ball(pilots);
    if (!m.through_portal) ball.middle = {}, ball.radius = kTestScene.radius;
    // Quarters around the middle, within and beyond half of the area of the disk (or a bit of it).
    const auto part = [&](Vec3 p) {
      const Vec3 d = p - ball.middle;
      return Parts::of({d.x, d.y, dot(d, d) - (m.through_portal ? 0.2f : 0.5f) * sqr(ball.radius)});
    };
    Parts sampled, expected;
    for (size_t k = 0; k < samples; ++k) {
      std::array<double, 9> values{};
      const auto p = draw();
      if (p && length(*p - ball.middle) <= 1.00001f * ball.radius) values[0] = values[part(*p)] = 1.0;
      sampled.add(values);
    }
    for (size_t k = 0; k < samples; ++k) {
      const Vec2 at = sample_disk_concentric(next_2d(numbers));
      const Vec3 p = ball.middle + Vec3{at.x, at.y, 0.0f} * ball.radius;
      const Ray ray{kTestScene.center + frame.to_world(p), first->ray.d};
      std::array<double, 9> values{};
      values[0] = values[part(p)] =
          kPiD * sqr(ball.radius) * m.pdf_le(nullptr, ray.d, far_along(ray)).position / first->cosine;
      expected.add(values);
    }
    compare(sampled, expected, fmt::format("direction {}", i), out);
  }
}

// What is compared of the lines that carry flux: they have the unit direction d and the moment o x d around the origin,
// which is the same for all of their points o. Flux itself, directions and places in the mean and as to their spread,
// and what passes near two points.
constexpr const char* kLineWeights[] = {"1",          "direction", "direction^2",  "moment",      "moment^2",
                                        "|moment|^2", "both",      "near a point", "near another"};
constexpr size_t kLineWeightCount = std::size(kLineWeights);

std::array<double, kLineWeightCount> line_weights(Point3 o, Vec3 d) {
  const Vec3 moment = cross(o - Point3{}, d);
  const float along = dot(d, Vec3{0.6f, -0.3f, 0.5f}), around = dot(moment, Vec3{-0.4f, 0.7f, 0.3f});
  const auto near = [&](Vec3 q) { return length(moment - cross(q, d)) < 0.4f ? 1.0f : 0.0f; };
  std::array<double, kLineWeightCount> w{};
  const float values[] = {1.0f,
                          along,
                          along * along,
                          around,
                          around * around,
                          dot(moment, moment),
                          along * around,
                          near({0.4f, 0.5f, 0.1f}),
                          near({-0.5f, -0.2f, 0.3f})};
  for (size_t i = 0; i < kLineWeightCount; ++i) w[i] = static_cast<double>(values[i]);
  return w;
}

using LineSums = std::array<RunningStats, kLineWeightCount>;

void add_line(LineSums& sums, Point3 o, Vec3 d, double flux) {
  const auto weights = flux == 0.0 ? std::array<double, kLineWeightCount>{} : line_weights(o, d);
  for (size_t i = 0; i < kLineWeightCount; ++i) sums[i].add(flux * weights[i]);
}

// What light samples know of the flux that leaves a sphere (or enters it, from infinitely far away).
LineSums lines_by_light_samples(const LightModel& m, const LightRays& rays, size_t samples, uint64_t seed) {
  const float radius = test_radius(m);
  HashStream numbers(seed);
  LineSums sums;
  for (size_t i = 0; i < samples; ++i) {
    const Vec3 n = sample_sphere_uniform(next_2d(numbers));
    const Point3 p = Point3{} + n * radius;
    const auto s = m.sample_li(p, next_2d(numbers));
    double flux = 0;
    if (s && rays.visible(p, *s)) {
      const float outward = dot(-s->wi, n), crossing = m.infinite && !m.through_portal ? -outward : outward;
      flux =
          4.0 * kPiD * sqr(radius) * std::max(0.0f, crossing) * static_cast<double>(mean_value(s->radiance)) / s->pdf;
    }
    add_line(sums, p, s ? -s->wi : Vec3{}, flux);
  }
  return sums;
}

void check_flux(const LightModel& m, const LightRays& rays, size_t samples, uint64_t seed, WorstP& power,
                WorstP& lines) {
  const float radius = test_radius(m);
  HashStream numbers(seed);
  RunningStats lanes[3];
  LineSums emitted;
  for (size_t i = 0; i < samples; ++i) {
    const Vec2 u = next_2d(numbers);
    const auto s = m.sample_le(u, next_2d(numbers));
    const Spectrum weight = s ? s->weight() : Spectrum();
    for (int lane = 0; lane < 3; ++lane) lanes[lane].add(static_cast<double>(weight[lane]));
    const bool counts = s && length(cross(s->ray.o - Point3{}, s->ray.d)) < radius && rays.leaves(s->ray);
    add_line(emitted, s ? s->ray.o : Point3{}, s ? s->ray.d : Vec3{},
             counts ? static_cast<double>(mean_value(weight)) : 0.0);
  }
  // Lights without a power of their own tell that through a disk of pi m^2; it is scaled to the disk across the
  // bounding sphere.
  const double scale = m.infinite && !m.through_portal ? sqr(static_cast<double>(kTestScene.radius)) : 1.0;
  for (int lane = 0; lane < 3; ++lane) {
    RunningStats told;
    told.add(scale * static_cast<double>(m.power[lane]));
    compare(lanes[lane], told, fmt::format("lane {}", lane), power);
  }
  const LineSums expected = lines_by_light_samples(m, rays, samples, hash_combine(seed, 1));
  for (size_t i = 0; i < kLineWeightCount; ++i) compare(emitted[i], expected[i], kLineWeights[i], lines);
}

}  // namespace

std::vector<CheckResult> check_emission(const LightModel& m, const LightBatteryOptions& options) {
  if (m.sampling == LightSampling::kCompensated) return {};
  const LightRays rays(m);
  const uint64_t seed = hash_combine(options.seed, 2000);
  const size_t samples = options.samples / 2;
  Worst finite(m.name, "emission is finite, positive", 0.0), sound(m.name, "emission = pdf_le, emitted", 2e-3);
  WorstP chi_square(m.name, "directions follow pdf_le"), mass(m.name, "integral of pdf_le"),
      positions(m.name, "positions follow pdf_le"), power(m.name, "weight of emission = power"),
      lines(m.name, "flux along lines");
  check_samples(m, hash_combine(seed, 1), finite, sound);
  if (!m.infinite || !m.delta) check_directions(m, samples / 2, hash_combine(seed, 2), chi_square, mass);
  if (m.on_surface) check_positions_on_surface(m, rays, samples, hash_combine(seed, 3), positions);
  if (m.infinite) check_positions_across(m, samples / 2, hash_combine(seed, 4), positions);
  check_flux(m, rays, samples, hash_combine(seed, 5), power, lines);
  std::vector<CheckResult> results{finite.result(), sound.result()};
  for (const WorstP* p : {&chi_square, &mass, &positions, &power, &lines})
    if (p->any()) results.push_back(p->result());
  return results;
}

}  // namespace etd
