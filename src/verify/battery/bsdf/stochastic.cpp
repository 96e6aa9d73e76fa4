// Checks of closures whose values are random: weighted histograms of samples are compared with averaged values over the
// same cells, and averages with each other.
#include <fmt/format.h>

#include "verify/battery/bsdf/checks.h"
#include "verify/statistics/statistics.h"

namespace etd::bsdf_checks {

namespace {

constexpr int kCosines = 3, kAzimuths = 4, kCells = 2 * kCosines * kAzimuths;

// Cells of equal solid angle: the sphere cut by height and azimuth.
int cell_of(Vec3 w) {
  const int row = std::min(static_cast<int>((w.z + 1.0f) * kCosines), 2 * kCosines - 1);
  const float turn = std::atan2(w.y, w.x) / (2.0f * kPi) + 0.5f;
  return row * kAzimuths + std::min(static_cast<int>(turn * kAzimuths), kAzimuths - 1);
}

struct CellStats {
  std::array<std::array<RunningStats, 3>, kCells> cells;
  std::array<RunningStats, 3> total;
  std::array<double, 3> largest{};  // of the numbers
};

// Means that differ by less are equal but for rounding.
constexpr double kRounding = 1e-4;
// Cells that fewer samples than this would fill, if all were worth as much as the largest, are not normally
// distributed.
constexpr double kMinSamples = 20.0;

std::array<double, 3> lanes(const Spectrum& s) { return {s[0], s[1], s[2]}; }

CellStats sampled(const ScatterModel& m, Vec3 wo, TransportMode mode, size_t n, uint64_t seed, Worst& form) {
  CellStats stats;
  HashStream numbers(hash_combine(seed, 1)), rng(hash_combine(seed, 2));
  for (size_t i = 0; i < n; ++i) {
    const float x = numbers.next_float(), y = numbers.next_float(), z = numbers.next_float();
    const auto s = m.sample(wo, {x, y, z}, mode, rng, kBothSides);
    const int hit = s && !s->is_delta() ? cell_of(s->wi) : -1;
    const std::array<double, 3> weight = s ? lanes(s->weight) : std::array<double, 3>{};
    for (size_t lane = 0; lane < 3; ++lane) {
      stats.total[lane].add(weight[lane]);
      stats.largest[lane] = std::max(stats.largest[lane], weight[lane]);
      if (hit >= 0) stats.cells[static_cast<size_t>(hit)][lane].add(weight[lane]);
    }
    if (!s) continue;
    const auto where = [&] { return describe(wo, mode); };
    form.add(std::max(0.0, std::abs(length(s->wi) - 1.0) - 1e-5), where);
    form.add((s->lobe & ~m.lobes) == 0 && s->pdf > 0.0f ? 0.0 : 1.0, where);
    if (s->is_delta()) continue;
    const float pdf = m.pdf(wo, s->wi, mode, kBothSides);
    // The way into a tilted frame and back rounds.
    form.add(s->pdf == pdf || (m.is_tilted() && std::abs(s->pdf / pdf - 1.0f) < 1e-3f) ? 0.0 : 1.0, where);
  }
  // A sample is worth nothing to the cells that it did not hit.
  for (auto& cell : stats.cells)
    for (RunningStats& lane : cell) lane.add_zeros(n - lane.count());
  return stats;
}

CellStats averaged(const ScatterModel& m, Vec3 wo, TransportMode mode, size_t n, uint64_t seed) {
  CellStats stats;
  HashStream numbers(hash_combine(seed, 3)), rng(hash_combine(seed, 4));
  const double cell_solid_angle = 4.0 * static_cast<double>(kPi) / kCells;
  for (size_t i = 0; i < n; ++i) {
    const int c = static_cast<int>(i % kCells), row = c / kAzimuths, column = c % kAzimuths;
    const float z = (static_cast<float>(row) + numbers.next_float()) / kCosines - 1.0f;
    const float phi = 2.0f * kPi * ((static_cast<float>(column) + numbers.next_float()) / kAzimuths - 0.5f);
    const float r = safe_sqrt(1.0f - z * z);
    const Spectrum f = m.eval_cos(wo, {r * std::cos(phi), r * std::sin(phi), z}, mode, rng);
    for (size_t lane = 0; lane < 3; ++lane)
      stats.cells[static_cast<size_t>(c)][lane].add(f[static_cast<int>(lane)] * cell_solid_angle);
  }
  return stats;
}

// A comparison of two means, whose p-value does not count if they are equal but for rounding.
void compare(WorstP& all, const TestResult& test, const std::string& where, double a, double b) {
  const bool equal = std::abs(a - b) <= kRounding * std::max(std::abs(a), std::abs(b));
  all.add(test.statistic, equal ? 1.0 : test.p_value,
          [&] { return fmt::format("{}: {:.6f} and {:.6f}", where, a, b); });
}

// f(wo, wi) and f(wi, wo) for a few pairs, averaged. One side only: these closures do not transmit.
void check_reciprocity(const ScatterModel& m, size_t n, uint64_t seed, WorstP& reciprocity) {
  HashStream rng(hash_combine(seed, 5));
  const Vec3 pairs[][2] = {{{0.6f, 0.0f, 0.8f}, {-0.3f, 0.2f, 0.932738f}},
                           {{0.0f, -0.9f, 0.43589f}, {0.0f, 0.0f, 1.0f}}};
  for (const auto& [a, b] : pairs) {
    RunningStats there, back;
    for (size_t i = 0; i < n; ++i) {
      there.add(m.eval_cos(a, b, TransportMode::kRadiance, rng)[1] / b.z);
      back.add(m.eval_cos(b, a, TransportMode::kRadiance, rng)[1] / a.z);
    }
    compare(reciprocity, welch_test(there, back), describe(a, TransportMode::kRadiance), there.mean(), back.mean());
  }
}

}  // namespace

void check_stochastic(const ScatterModel& m, const BsdfBatteryOptions& options, Results& out) {
  Worst form(m.name, "unit wi, lobes as declared, pdf()", 0.0);
  WorstP histogram(m.name, "weighted samples = averaged values"), reciprocity(m.name, "averages are reciprocal");
  WorstP energy(m.name, "energy <= 1");
  uint64_t run = 0;
  for (const Vec3& wo : test_directions()) {
    if (m.grazing_cos(wo) < std::max(m.min_cos, 0.02f)) continue;
    for (TransportMode mode : {TransportMode::kRadiance, TransportMode::kImportance}) {
      const uint64_t seed = hash_combine(options.seed, ++run);
      const CellStats samples = sampled(m, wo, mode, options.samples, seed, form);
      const CellStats values = averaged(m, wo, mode, options.samples, seed);
      for (size_t lane = 0; lane < 3; ++lane) {
        const RunningStats& total = samples.total[lane];
        const double z = (total.mean() - 1.0) / std::max(std::sqrt(total.variance_of_mean()), 1e-5);
        compare(energy, {z, 0.0, normal_sf(z)}, describe(wo, mode), total.mean(), 1.0);
        for (size_t c = 0; c < kCells; ++c) {
          const RunningStats &a = samples.cells[c][lane], &b = values.cells[c][lane];
          if (static_cast<double>(options.samples) * std::max(a.mean(), b.mean()) < kMinSamples * samples.largest[lane])
            continue;
          compare(histogram, welch_test(a, b), fmt::format("{}, cell {}, lane {}", describe(wo, mode), c, lane),
                  a.mean(), b.mean());
        }
      }
    }
  }
  if (m.traits.reciprocal) check_reciprocity(m, options.samples, options.seed, reciprocity);
  out.push_back(form.result());
  if (m.has_smooth()) out.push_back(histogram.result());
  if (m.traits.energy_conserving) out.push_back(energy.result());
  if (m.traits.reciprocal && m.has_smooth()) out.push_back(reciprocity.result());
}

}  // namespace etd::bsdf_checks
