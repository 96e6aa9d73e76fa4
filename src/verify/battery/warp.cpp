// Every map from the unit square in core/, and those of the closures and phase functions that are too sharp for
// histograms: its density must be the reciprocal of its numeric Jacobian, which needs no statistics.
#include <fmt/format.h>

#include "bsdfs/microfacet.h"
#include "core/distribution.h"
#include "core/solid_angle.h"
#include "core/warp.h"
#include "core/windowed_distribution.h"
#include "phase/henyey_greenstein.h"
#include "verify/battery/models.h"
#include "verify/battery/worst.h"

namespace etd {

namespace {

// Fourth order central difference along one axis.
Vec3d derivative(const WarpModel& w, Vec2 u, Vec2 axis) {
  const auto at = [&](float t) { return w.map(Vec2{u.x + axis.x * t, u.y + axis.y * t}); };
  const float h = w.step;
  return ((at(h) - at(-h)) * 8.0 - (at(2.0f * h) - at(-2.0f * h))) / (12.0 * static_cast<double>(h));
}

Vec3d in_plane(Vec2 v) { return {static_cast<double>(v.x), static_cast<double>(v.y), 0.0}; }
// The concentric map has a kink along the diagonals of the square, the triangle's along one.
bool off_diagonals(Vec2 u) { return std::abs(u.x - u.y) > 0.02f && std::abs(u.x + u.y - 1.0f) > 0.02f; }
// Malley's hemisphere is also too steep at the horizon for finite differences.
bool off_horizon(Vec2 u) { return off_diagonals(u) && std::max(std::abs(u.x - 0.5f), std::abs(u.y - 0.5f)) < 0.46f; }

WarpModel spherical_triangle(std::string setting, const Point3d (&corners)[3]) {
  const SphericalTriangle t({0, 0, 0}, corners);
  return {"SphericalTriangle::sample", std::move(setting), [t](Vec2 u) { return t.sample(u); },
          [t](Vec2) { return 1.0 / t.solid_angle(); }};
}

WarpModel spherical_rectangle(std::string setting, Point3d corner, Vec3d x, Vec3d y) {
  const SphericalRectangle r({0, 0, 0}, {corner, x, y});
  const auto direction = [=](Vec2 u) {
    const Vec2T<double> at = r.sample(u);
    return normalize(corner + x * at.x + y * at.y - Point3d{0, 0, 0});
  };
  return {"SphericalRectangle::sample", std::move(setting), direction, [r](Vec2) { return 1.0 / r.solid_angle(); }};
}

WarpModel spherical_cap(double distance) {
  const Point3d center{0.0, 0.6 * distance, -0.8 * distance};
  const SphericalCap cap = *SphericalCap::seen_from({0, 0, 0}, center, 1.0);
  const auto direction = [=](Vec2 u) { return normalize(center + cap.sample_normal(u) - Point3d{0, 0, 0}); };
  return {"SphericalCap::sample_normal", fmt::format("distance {:g}", distance), direction,
          [cap](Vec2) { return 1.0 / cap.solid_angle(); }};
}

// Uneven cells, one of them empty.
WarpModel grid_distribution() {
  const std::vector<double> weights{1, 2, 0, 4, 3, 1, 5, 2};
  const auto grid = std::make_shared<const GridDistribution>(4, 2, weights);
  const auto point = [grid](Vec2 u) {
    const GridDistribution::Sample s = grid->sample(u);
    return Vec3d{s.x + static_cast<double>(s.offset.x), s.y + static_cast<double>(s.offset.y), 0.0};
  };
  const auto pdf = [grid](Vec2 u) {
    const GridDistribution::Sample s = grid->sample(u);
    return static_cast<double>(grid->probability(s.x, s.y));
  };
  const auto inside = [grid](Vec2 u) {
    const GridDistribution::Sample s = grid->sample(u);
    const auto far = [](float a) { return a > 0.25f && a < 0.75f; };
    return far(s.offset.x) && far(s.offset.y);
  };
  return {"GridDistribution::sample", "4x2", point, pdf, inside};
}

// A window that cuts cells.
WarpModel windowed_distribution() {
  const std::vector<double> densities{1, 2, 0.5, 4, 3, 1, 5, 2};
  const auto grid = std::make_shared<const WindowedDistribution>(4, 2, densities);
  const WindowedDistribution::Window window{{0.1, 0.2}, {0.85, 0.9}};
  const auto point = [=](Vec2 u) {
    const WindowedDistribution::Point p = grid->sample(u, window);
    return Vec3d{p.x, p.y, 0.0};
  };
  const auto inside = [=](Vec2 u) {
    const WindowedDistribution::Point p = grid->sample(u, window);
    const auto far = [](double cells) { return std::abs(cells - std::round(cells)) > 0.06; };
    return far(4.0 * p.x) && far(2.0 * p.y);
  };
  return {"WindowedDistribution::sample", "4x2", point,
          [=](Vec2 u) { return grid->pdf(grid->sample(u, window), window); }, inside};
}

WarpModel visible_normals(float ax, float ay, Vec3 wo) {
  const Ggx ggx{ax, ay};
  const auto pdf = [=](Vec2 u) {
    const Vec3 h = ggx.sample_visible(wo, u);
    return static_cast<double>(ggx.g1(wo) * std::max(0.0f, dot(wo, h)) * ggx.d(h) / wo.z);
  };
  return {"Ggx::sample_visible", fmt::format("alpha {:g} x {:g}, cos {:.2g}", ax, ay, wo.z),
          [=](Vec2 u) { return to_double(ggx.sample_visible(wo, u)); }, pdf,
          [](Vec2 u) { return u.y > 0.06f && u.y < 0.94f; }};
}

WarpModel henyey_greenstein(float g) {
  const HenyeyGreenstein phase{g};
  const Vec3 wo = normalize(Vec3{0.3f, -0.5f, 0.7f});
  return {"HenyeyGreenstein::sample", fmt::format("g {:g}", g), [=](Vec2 u) { return to_double(phase.sample(wo, u)); },
          [=](Vec2 u) { return static_cast<double>(phase.p(wo, phase.sample(wo, u))); },
          [](Vec2 u) { return u.x > 0.05f && u.x < 0.95f; }};
}

std::vector<WarpModel> warps() {
  const Vec3 oblique = normalize(Vec3{0.5f, -0.4f, 0.6f}), grazing = normalize(Vec3{-0.3f, 0.9f, 0.05f});
  return {
      {"sample_disk_concentric", "", [](Vec2 u) { return in_plane(sample_disk_concentric(u)); },
       [](Vec2) { return static_cast<double>(pdf_disk()); }, off_diagonals},
      {"sample_hemisphere_cosine", "", [](Vec2 u) { return to_double(sample_hemisphere_cosine(u)); },
       [](Vec2 u) { return static_cast<double>(pdf_hemisphere_cosine(sample_hemisphere_cosine(u).z)); }, off_horizon},
      {"sample_sphere_uniform", "", [](Vec2 u) { return to_double(sample_sphere_uniform(u)); },
       [](Vec2) { return static_cast<double>(pdf_sphere_uniform()); },
       [](Vec2 u) { return u.x > 0.04f && u.x < 0.96f; }},
      // Barycentrics cover a triangle of area 1/2.
      {"sample_triangle_uniform", "", [](Vec2 u) { return in_plane(sample_triangle_uniform(u)); },
       [](Vec2) { return 2.0; }, off_diagonals},
      spherical_triangle("octant", {{1, 0, 0}, {0, 2, 0}, {0, 0, 5}}),
      spherical_triangle("small", {{1, 0, 1}, {1, 0.2, 1}, {1.1, 0.1, 1}}),
      spherical_rectangle("face of a cube", {-1, -1, 1}, {2, 0, 0}, {0, 2, 0}),
      spherical_rectangle("slanted", {2, 1, 0.3}, {1, 0, 0}, {0, 3, 0}),
      spherical_cap(1.5),
      spherical_cap(10.0),
      grid_distribution(),
      windowed_distribution(),
      visible_normals(0.5f, 0.5f, {0, 0, 1}),
      visible_normals(0.1f, 0.6f, oblique),
      visible_normals(0.01f, 0.01f, oblique),
      visible_normals(0.3f, 0.3f, grazing),
      henyey_greenstein(0.0f),
      henyey_greenstein(0.7f),
      henyey_greenstein(-0.4f),
  };
}

// The alias method sends intervals to indices: their lengths are found by walking evenly through the unit interval.
std::vector<CheckResult> check_alias_table() {
  const std::vector<double> weights{3, 0, 1, 1e-4, 7, 2, 0.5};
  const AliasTable table(weights);
  double total = 0;
  for (const double w : weights) total += w;
  constexpr int kSteps = 1 << 20;
  std::vector<double> share(weights.size(), 0.0);
  for (int i = 0; i < kSteps; ++i) share[table.sample((i + 0.5) / kSteps)] += 1.0 / kSteps;
  Worst shares("AliasTable::sample", "shares = weights", 2e-5), told("AliasTable::sample", "probability()", 1e-6);
  for (uint32_t i = 0; i < weights.size(); ++i) {
    const auto where = [&] { return fmt::format("index {}", i); };
    shares.add(std::abs(share[i] - weights[i] / total), where);
    told.add(std::abs(static_cast<double>(table.probability(i)) - weights[i] / total), where);
  }
  return {shares.result(), told.result()};
}

}  // namespace

std::vector<CheckResult> check_warp(const WarpModel& w) {
  Worst jacobian(w.name(), "1 / pdf = Jacobian", 4e-3), finite(w.name(), "finite at the edges", 0.0);
  for (float x = 0.0237f; x < 0.98f; x += 0.0313f)
    for (float y = 0.0419f; y < 0.97f; y += 0.0291f) {
      if (!w.smooth({x, y})) continue;
      const double area = length(cross(derivative(w, {x, y}, {1, 0}), derivative(w, {x, y}, {0, 1})));
      jacobian.add(std::abs(area * w.pdf({x, y}) - 1.0), [&] { return fmt::format("at u = ({:.4f}, {:.4f})", x, y); });
    }
  for (const float x : {0.0f, 0x1p-24f, 0.25f, 0.5f, 0.75f, kOneMinusEpsilon})
    for (const float y : {0.0f, 0x1p-24f, 0.25f, 0.5f, 0.75f, kOneMinusEpsilon}) {
      const Vec3d p = w.map({x, y});
      finite.add(std::isfinite(p.x + p.y + p.z) ? 0.0 : 1.0, [&] { return fmt::format("at u = ({}, {})", x, y); });
    }
  return {jacobian.result(), finite.result()};
}

std::vector<BatterySubject> warp_subjects() {
  std::vector<BatterySubject> subjects;
  for (const WarpModel& w : warps())
    subjects.push_back({"warp", w.model, w.name(), [w](const BatteryOptions&) { return check_warp(w); }});
  subjects.push_back(
      {"warp", "AliasTable::sample", "AliasTable::sample", [](const BatteryOptions&) { return check_alias_table(); }});
  return subjects;
}

}  // namespace etd
