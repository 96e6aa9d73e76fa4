// The battery over pixel filters: the weighted samples must be distributed as the filter says, which must integrate to
// one and vanish beyond its radius.
#include <fmt/format.h>

#include "core/hash.h"
#include "scene/registry.h"
#include "verify/battery/models.h"
#include "verify/battery/parameter_grid.h"
#include "verify/battery/worst.h"
#include "verify/statistics/quadrature.h"

namespace etd {

namespace {

constexpr size_t kSamples = 200000;
constexpr int kCells = 16;  // along each axis of the support
// Rounding in weights and borders of cells, relative to the whole.
constexpr double kRounding = 1e-5;

Rect cell_of(Vec2 radius, int i, int j) {
  const double w = 2.0 * static_cast<double>(radius.x) / kCells, h = 2.0 * static_cast<double>(radius.y) / kCells;
  const double x = i * w - static_cast<double>(radius.x), y = j * h - static_cast<double>(radius.y);
  return {x, x + w, y, y + h};
}

struct FilterCells {
  std::vector<double> expected = std::vector<double>(kCells * kCells);
  double total = 0;
};

FilterCells integrate(const FilterModel& f) {
  FilterCells cells;
  for (int j = 0; j < kCells; ++j)
    for (int i = 0; i < kCells; ++i) {
      const auto value = [&](double x, double y) {
        return std::array<double, 1>{f.eval({static_cast<float>(x), static_cast<float>(y)})};
      };
      const double v = integrate_rect<1>(value, cell_of(f.radius, i, j), 1e-8, 1e-5)[0];
      cells.expected[static_cast<size_t>(j * kCells + i)] = v;
      cells.total += v;
    }
  return cells;
}

void check_values(const FilterModel& f, Worst& finite, Worst& support) {
  const Vec2 r = f.radius;
  for (const float x : {0.0f, 0.3f, 0.999f, 1.0f, 1.001f, 2.0f, 1e6f})
    for (const float y : {0.0f, -0.5f, -1.0f, -1.01f}) {
      const auto where = [&] { return fmt::format("at ({}, {}) radii", x, y); };
      const float v = f.eval({x * r.x, y * r.y});
      finite.add(std::isfinite(v) ? 0.0 : 1.0, where);
      if (x > 1.0f || y < -1.0f) support.add(std::abs(v), where);
    }
  const float ends[] = {0.0f, 0x1p-24f, 0.25f, 0.5f - 0x1p-25f, 0.5f, 0.5f + 0x1p-24f, 0.75f, kOneMinusEpsilon};
  for (const float x : ends)
    for (const float y : ends) {
      const FilterSample s = f.sample({x, y});
      const auto where = [&] { return fmt::format("sample at u ({}, {})", x, y); };
      finite.add(std::isfinite(s.weight) && std::isfinite(s.offset.x) && std::isfinite(s.offset.y) ? 0.0 : 1.0, where);
      support.add(std::abs(s.offset.x) <= r.x && std::abs(s.offset.y) <= r.y ? 0.0 : 1.0, where);
    }
}

}  // namespace

FilterModel filter_model(const std::string& name, const Filter& filter) {
  return {name, filter.radius(), [filter](Vec2 offset) { return filter.eval(offset); },
          [filter](Vec2 u) { return filter.sample(u); }};
}

std::vector<CheckResult> check_filter(const FilterModel& f, const BatteryOptions& options) {
  Worst finite(f.name, "finite", 0.0), support(f.name, "zero beyond its radius", 0.0);
  Worst unit(f.name, "integral = 1", 2e-4);
  WorstP histogram(f.name, "weighted samples follow it"), mean(f.name, "mean weight = 1");
  check_values(f, finite, support);
  const FilterCells cells = integrate(f);
  unit.add(std::abs(cells.total - 1.0), [&] { return fmt::format("{:.6f}", cells.total); });

  const double n = options.samples * kSamples;
  std::vector<double> sum(cells.expected.size()), squares(cells.expected.size());
  RunningStats weights;
  HashStream numbers(options.seed);
  const auto index = [](float offset, float radius) {
    return std::clamp(static_cast<int>((offset / radius + 1.0f) * (kCells / 2)), 0, kCells - 1);
  };
  for (double i = 0; i < n; ++i) {
    const float x = numbers.next_float(), y = numbers.next_float();
    const FilterSample s = f.sample({x, y});
    const double w = static_cast<double>(s.weight);
    const auto cell = static_cast<size_t>(index(s.offset.y, f.radius.y) * kCells + index(s.offset.x, f.radius.x));
    sum[cell] += w;
    squares[cell] += w * w;
    weights.add(w);
  }
  CheckMap map;
  map.width = map.height = kCells;
  map.axes = "y from -radius down to radius, x from -radius to the right";
  double smallest_p = 1, worst_z = 0;
  size_t worst = 0;
  for (size_t i = 0; i < sum.size(); ++i) {
    // The spread is that of a count of weighted samples, with a floor for cells that expect less than one.
    const double expected = cells.expected[i];
    const double spread = std::max(squares[i] / n, std::abs(expected)) - sqr(sum[i] / n);
    const double z = (sum[i] / n - expected) / std::sqrt(std::max(spread, 0.0) / n + 9.0 / (n * n) + sqr(kRounding));
    if (normal_two_sided(z) < smallest_p) smallest_p = normal_two_sided(z), worst_z = z, worst = i;
    map.sampled.push_back(static_cast<float>(sum[i] / n));
    map.expected.push_back(static_cast<float>(expected));
    map.sigmas.push_back(static_cast<float>(z));
  }
  histogram.add(worst_z, sidak_combined(smallest_p, sum.size()), [&] {
    return fmt::format("cell {}, {} of {}x{}: samples {:.6f}, integral {:.6f}", worst % kCells, worst / kCells, kCells,
                       kCells, sum[worst] / n, cells.expected[worst]);
  });
  histogram.set_map(std::move(map));
  const double z = (weights.mean() - 1.0) / std::sqrt(weights.variance_of_mean() + sqr(kRounding));
  mean.add(z, normal_two_sided(z), [&] { return fmt::format("{:.6f}", weights.mean()); });
  std::vector<CheckResult> results{finite.result(), support.result(), unit.result(), histogram.result(), mean.result()};
  judge(results, options.family_level);
  return results;
}

std::vector<BatterySubject> filter_subjects() {
  std::vector<BatterySubject> subjects;
  for (const ModelDecl* decl : models(Family::kFilter))
    for (const ModelUse& use : parameter_grid(*decl)) {
      const std::string name = setting_name(use);
      subjects.push_back({"filter", decl->name, name, [name, use](const BatteryOptions& options) {
                            Diagnostics diagnostics;
                            return check_filter(filter_model(name, make_filter(use, diagnostics)), options);
                          }});
    }
  return subjects;
}

}  // namespace etd
