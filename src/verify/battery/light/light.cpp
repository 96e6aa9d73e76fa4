#include "verify/battery/light/light.h"

#include <fmt/format.h>

#include "core/frame.h"
#include "core/hash.h"
#include "core/warp.h"
#include "verify/battery/battery.h"
#include "verify/battery/direction_histogram.h"
#include "verify/battery/light/rays.h"

namespace etd {

namespace {

std::string describe(Point3 p) { return fmt::format("seen from ({:.3g}, {:.3g}, {:.3g})", p.x, p.y, p.z); }

// The points are in front of, behind, beside, near, far from and (for spheres) within the examples.
const std::vector<Point3>& test_points() {
  static const std::vector<Point3> points{{0.2f, 0.1f, 2.0f},   {1.5f, 0.5f, 0.6f},  {-0.7f, -1.0f, -1.2f},
                                          {0.1f, 0.05f, 0.25f}, {-6.0f, 3.0f, 5.0f}, {0.0f, -0.2f, -0.3f}};
  return points;
}

void check_samples(const LightModel& m, const LightRays& rays, Point3 p, uint64_t seed, Worst& finite, Worst& sound) {
  HashStream numbers(seed);
  const auto where = [&] { return describe(p); };
  for (int i = 0; i < 2000; ++i) {
    const auto s = m.sample_li(p, {numbers.next_float(), numbers.next_float()});
    if (!s) continue;
    const bool positive = s->pdf > 0.0f && std::isfinite(s->pdf) && !is_black(s->radiance);
    finite.add(positive && is_finite(s->radiance) && is_finite(s->wi) ? 0.0 : 1.0, where);
    const SurfacePoint* on_light = m.infinite ? nullptr : &s->on_light;
    sound.add(std::abs(length(s->wi) - 1.0f), where);
    sound.add_relative(m.pdf_li(p, s->wi, on_light), s->pdf, where);
    const Spectrum emitted = m.emitted(on_light, -s->wi, p);
    for (int lane = 0; lane < 3; ++lane) sound.add_relative(emitted[lane], s->radiance[lane], where);
    if (!on_light) continue;
    sound.add(length(normalize(s->on_light.p - p) - s->wi), where);
    // Where the ray along wi arrives the density is the same, unless it grazes.
    if (std::abs(dot(s->wi, s->on_light.ng)) > 0.1f && rays.visible(p, *s))
      sound.add_relative(rays.pdf_visible(p, s->wi), s->pdf, where);
  }
}

// Histogram of visible samples against pdf_li.
void check_density(const LightModel& m, const LightRays& rays, Point3 p, size_t samples, uint64_t seed,
                   WorstP& chi_square, WorstP& mass) {
  const auto draw = [&](HashStream& numbers) -> std::optional<Vec3> {
    const float x = numbers.next_float(), y = numbers.next_float();
    const auto s = m.sample_li(p, {x, y});
    if (!s || !rays.visible(p, *s)) return {};
    return s->wi;
  };
  // Cells that the light's outline crosses are integrated to about a thousandth of the whole.
  const DirectionDensity density{.draw = draw,
                                 .pdf = [&](Vec3 wi) { return rays.pdf_visible(p, wi); },
                                 .jumps = true,
                                 .cells = 64,
                                 .integration_error = 1e-3};
  check_direction_density(density, describe(p), samples, seed, chi_square, mass);
}

// The integral of radiance over directions, weighted by 1, by x and by a mixture, estimated in both ways.
void check_radiance(const LightModel& m, const LightRays& rays, Point3 p, size_t samples, uint64_t seed, WorstP& out) {
  HashStream numbers(seed);
  RunningStats by_light[3], by_rays[3];
  const auto add = [](RunningStats(&stats)[3], Vec3 wi, double value) {
    stats[0].add(value);
    stats[1].add(value * wi.x);
    stats[2].add(value * (wi.y + 0.5 * wi.z));
  };
  for (size_t i = 0; i < samples; ++i) {
    const float x = numbers.next_float(), y = numbers.next_float();
    const auto s = m.sample_li(p, {x, y});
    const bool counts = s && rays.visible(p, *s);
    add(by_light, counts ? s->wi : Vec3{}, counts ? static_cast<double>(mean_value(s->radiance)) / s->pdf : 0.0);
  }
  for (size_t i = 0; i < 4 * samples; ++i) {
    const float x = numbers.next_float(), y = numbers.next_float();
    const Vec3 wi = sample_sphere_uniform({x, y});
    add(by_rays, wi, static_cast<double>(mean_value(rays.look(p, wi).radiance)) / pdf_sphere_uniform());
  }
  for (int i = 0; i < 3; ++i) {
    const double a = by_light[i].mean(), b = by_rays[i].mean();
    const double error2 = by_light[i].variance_of_mean() + by_rays[i].variance_of_mean() + sqr(1e-5 * (a + b));
    const double z = error2 > 0.0 ? (a - b) / std::sqrt(error2) : 0.0;
    out.add(z, normal_two_sided(z),
            [&] { return fmt::format("{}, weight {}: by light {:.6g}, by rays {:.6g}", describe(p), i, a, b); });
  }
}

// Along lines spread evenly over positions and directions, every crossing with the light counts what it sends back.
// Lines through a sphere of radius r carry 4 pi^2 r^2 times their mean radiance.
void check_power(const LightModel& m, const LightRays& rays, size_t samples, uint64_t seed, WorstP& out) {
  constexpr float kRadius = 3.0f;
  HashStream numbers(seed);
  RunningStats lanes[3];
  for (size_t i = 0; i < 4 * samples; ++i) {
    const float x = numbers.next_float(), y = numbers.next_float(), z = numbers.next_float(), w = numbers.next_float();
    const Vec3 n = sample_sphere_uniform({x, y});
    const Vec3 d = Frame::from_z(-n).to_world(sample_hemisphere_cosine({z, w}));
    const Point3 o = Point3{} + n * kRadius;
    Spectrum sum;
    if (m.infinite) {
      sum = rays.look(o, d).radiance;
    } else {
      rays.for_crossings(o, d, [&](const SurfacePoint& s) { sum += m.emitted(&s, -d, o); });
    }
    for (int lane = 0; lane < 3; ++lane) lanes[lane].add(static_cast<double>(sum[lane]));
  }
  const double scale = 4.0 * kPiD * kPiD * (m.infinite && !m.through_portal ? 1.0 : kRadius * kRadius);
  for (int lane = 0; lane < 3; ++lane) {
    const double power = m.power[lane], flux = lanes[lane].mean() * scale;
    const double error2 = sqr(scale) * lanes[lane].variance_of_mean() + sqr(1e-5 * power);
    const double z = (flux - power) / std::sqrt(error2);
    out.add(z, normal_two_sided(z),
            [&] { return fmt::format("lane {}: power {:.6g}, flux {:.6g}", lane, power, flux); });
  }
}

// Nothing but samples find a delta light. Its power is the flux that leaves the sphere of radius 3, or that enters the
// unit sphere of an infinite one.
void check_delta(const LightModel& m, size_t samples, uint64_t seed, Worst& finite, Worst& sound, WorstP& out) {
  const float radius = test_radius(m);
  const double area = 4.0 * kPiD * sqr(radius);
  HashStream numbers(seed);
  RunningStats lanes[3];
  for (size_t i = 0; i < samples; ++i) {
    const float x = numbers.next_float(), y = numbers.next_float();
    const Vec3 n = sample_sphere_uniform({x, y}), o = n * radius;
    const Point3 p{o.x, o.y, o.z};
    const auto where = [&] { return describe(p); };
    const auto s = m.sample_li(p, {x, y});
    Spectrum crossing;
    if (s) {
      finite.add(is_finite(s->radiance) && !is_black(s->radiance) && is_finite(s->wi) ? 0.0 : 1.0, where);
      sound.add(std::abs(length(s->wi) - 1.0f), where);
      sound.add(s->is_delta && s->pdf > 0.0f && std::isfinite(s->pdf) ? 0.0 : 1.0, where);
      const SurfacePoint* on_light = m.infinite ? nullptr : &s->on_light;
      sound.add(m.pdf_li(p, s->wi, on_light) + max_value(m.emitted(on_light, -s->wi, p)), where);
      if (on_light) sound.add(length(normalize(s->on_light.p - p) - s->wi), where);
      const float inward = dot(s->wi, n);
      crossing = s->radiance * ((m.infinite ? std::max(0.0f, inward) : -inward) / s->pdf);
    }
    for (int lane = 0; lane < 3; ++lane) lanes[lane].add(area * static_cast<double>(crossing[lane]));
  }
  for (int lane = 0; lane < 3; ++lane) {
    const double power = m.power[lane], flux = lanes[lane].mean();
    const double z = (flux - power) / std::sqrt(lanes[lane].variance_of_mean() + sqr(1e-5 * power));
    out.add(z, normal_two_sided(z),
            [&] { return fmt::format("lane {}: power {:.6g}, flux {:.6g}", lane, power, flux); });
  }
}

// Adds the checks of emission and judges all.
std::vector<CheckResult> judged(std::vector<CheckResult> results, const LightModel& m,
                                const LightBatteryOptions& options) {
  for (CheckResult& r : check_emission(m, options)) results.push_back(std::move(r));
  judge(results, options.family_level);
  return results;
}

}  // namespace

LightModel light_model(const LightExample& example, const EmissionDisks& disks) {
  const Light light = example.light;
  LightModel m;
  m.name = example.name;
  m.time = example.time;
  const ShadingContext context{m.time};
  // What moves is a group of its own.
  GeometryGroup group;
  if (example.mesh) {
    m.geometry.meshes.push_back(*example.mesh);
    group.meshes.push_back(0);
  }
  if (example.patches) {
    m.geometry.patch_meshes.push_back(*example.patches);
    group.patch_meshes.push_back(0);
  }
  if (example.quadric) {
    m.geometry.quadrics.push_back(*example.quadric);
    group.quadric_end = 1;
  }
  if (example.motion) {
    m.geometry.groups.push_back(group);
    m.geometry.instances.push_back({placement_at(*example.motion, 0.0f), 1, example.motion.get()});
  } else {
    m.geometry.groups[0] = group;
  }
  m.on_surface = example.mesh || example.patches || example.quadric;
  m.power = example.power_then.value_or(light.power());
  m.infinite = light.is_infinite();
  m.through_portal = example.through_portal;
  m.delta = light.is_delta();
  m.sampling = example.sampling;
  const auto mode = example.sampling;
  m.sample_li = [=](Point3 p, Vec2 u) { return light.sample_li(p, u, context, mode); };
  m.pdf_li = [=](Point3 p, Vec3 wi, const SurfacePoint* s) { return light.pdf_li(p, wi, s, context, mode); };
  m.emitted = [=](const SurfacePoint* s, Vec3 w, Point3 from) { return light.emitted(s, w, context, from); };
  m.sample_le = [=](Vec2 position, Vec2 direction) { return light.sample_le(position, direction, disks, context); };
  m.pdf_le = [=](const SurfacePoint* s, Vec3 w, Point3 from) { return light.pdf_le(s, w, disks, context, from); };
  return m;
}

std::vector<CheckResult> check_light(const LightModel& m, const LightBatteryOptions& options) {
  const LightRays rays(m);
  Worst finite(m.name, "finite and positive", 0.0), sound(m.name, "sample = pdf_li, emitted", 2e-3);
  WorstP chi_square(m.name, "samples follow pdf_li"), mass(m.name, "integral of pdf_li"),
      radiance(m.name, "radiance of all directions"), power(m.name, "power = flux");
  uint64_t run = 0;
  if (m.delta) {
    check_delta(m, options.samples, options.seed, finite, sound, power);
    return judged({finite.result(), sound.result(), power.result()}, m, options);
  }
  for (const Point3& p : test_points()) {
    const uint64_t seed = hash_combine(options.seed, ++run);
    check_samples(m, rays, p, hash_combine(seed, 1), finite, sound);
    check_density(m, rays, p, options.samples, hash_combine(seed, 2), chi_square, mass);
    if (m.sampling == LightSampling::kComplete)
      check_radiance(m, rays, p, options.samples, hash_combine(seed, 3), radiance);
  }
  check_power(m, rays, options.samples, hash_combine(options.seed, 1000), power);
  return judged(
      {finite.result(), sound.result(), chi_square.result(), mass.result(), radiance.result(), power.result()}, m,
      options);
}

std::vector<BatterySubject> light_subjects() {
  constexpr double kSamples = 40000;
  std::vector<BatterySubject> subjects;
  for (const LightExample& e : light_examples())
    subjects.push_back(
        {"light", e.name.substr(0, e.name.find('(')), e.name, [&e](const BatteryOptions& o) {
           return check_light(light_model(e), {static_cast<size_t>(o.samples * kSamples), o.seed, o.family_level});
         }});
  return subjects;
}

}  // namespace etd
