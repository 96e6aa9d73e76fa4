// Checks of a closure by many samples against integrals over the sphere of directions.
#include <fmt/format.h>

#include "verify/battery/bsdf/checks.h"
#include "verify/battery/direction_grid.h"

namespace etd::bsdf_checks {

namespace {

// Integration errs by about this share of the whole (at worst by four times it: 1.2e-3 for rough glass of index 1.3,
// whose density ends inside cells); differences below it say nothing.
constexpr double kIntegrationError = 3e-4;
constexpr double kMinExpected = 20.0;
constexpr size_t kCells = 256, kTiltedCells = 64;  // about

struct Setting {
  Vec3 wo;
  TransportMode mode;
  Lobe sides;
};

// Integrals over the sphere of pdf and of eval_cos in three lanes; pdf per cell.
struct Integrals {
  std::vector<double> cell_pdf;
  double pdf = 0;
  std::array<double, 3> f{};
};

class Histogram {
 public:
  Histogram(const ScatterModel& model, const Setting& setting, size_t samples, uint64_t seed)
      : model_(model),
        setting_(setting),
        grid_(pilots(samples / 2, seed),
              std::max<size_t>(samples / 2 / (model.is_tilted() ? kTiltedCells : kCells), 1)) {
    observed_.assign(grid_.cell_count(), 0.0);
    HashStream numbers(hash_combine(seed, 2));
    for (size_t i = 0; i < samples; ++i) {
      const auto s = draw(numbers);
      if (s) {
        observed_[grid_.find(s->wi)] += 1.0;
      } else {
        elsewhere_ += 1.0;
      }
      for (int lane = 0; lane < 3; ++lane) weight_[lane].add(s ? static_cast<double>(s->weight[lane]) : 0.0);
    }
  }

  Integrals integrate() const {
    Integrals sum;
    HashStream rng(0);
    const Setting& t = setting_;
    const auto values = [&](Vec3 wi) {
      const bool allowed = (t.sides & (same_hemisphere(t.wo, wi) ? kReflection : kTransmission)) != 0;
      const Spectrum f = allowed ? model_.eval_cos(t.wo, wi, t.mode, rng) : Spectrum();
      return std::array<double, 4>{model_.pdf(t.wo, wi, t.mode, t.sides), f[0], f[1], f[2]};
    };
    // The horizon of a tilted surface cuts through cells.
    const int splits = model_.is_tilted() ? 1 : 0;
    for (size_t i = 0; i < grid_.cell_count(); ++i) {
      const std::array<double, 4> v = grid_.integrate(i, values, 1e-6, splits);
      sum.cell_pdf.push_back(v[0]);
      sum.pdf += v[0];
      for (size_t lane = 0; lane < 3; ++lane) sum.f[lane] += v[lane + 1];
    }
    return sum;
  }

  const DirectionGrid& grid() const { return grid_; }
  const std::vector<double>& observed() const { return observed_; }
  // Samples that failed or took a delta lobe.
  double elsewhere() const { return elsewhere_; }
  const RunningStats& weight(int lane) const { return weight_[lane]; }

 private:
  // Nothing on failure and for delta lobes.
  std::optional<BsdfSample> draw(HashStream& numbers) const {
    const float x = numbers.next_float(), y = numbers.next_float(), z = numbers.next_float();
    HashStream rng(hash_combine(numbers.next_u32(), 3));
    const auto s = model_.sample(setting_.wo, {x, y, z}, setting_.mode, rng, setting_.sides);
    return s && !s->is_delta() ? s : std::nullopt;
  }
  std::vector<Vec3> pilots(size_t n, uint64_t seed) const {
    std::vector<Vec3> list;
    HashStream numbers(hash_combine(seed, 1));
    for (size_t i = 0; i < n; ++i)
      if (const auto s = draw(numbers)) list.push_back(s->wi);
    return list;
  }

  const ScatterModel& model_;
  Setting setting_;
  DirectionGrid grid_;
  std::vector<double> observed_;
  double elsewhere_ = 0;
  RunningStats weight_[3];
};

struct HistogramChecks {
  WorstP chi_square, mass, mean;
  explicit HistogramChecks(const ScatterModel& m)
      : chi_square(m.name, "samples follow pdf"),
        mass(m.name, "integral of pdf = 1 - failures"),
        mean(m.name, "mean weight = albedo") {}
};

// Returns the integrals of eval_cos.
std::array<double, 3> check_setting(const ScatterModel& m, const Setting& t, size_t samples, uint64_t seed,
                                    HistogramChecks& c) {
  const Histogram histogram(m, t, samples, seed);
  const Integrals integrals = histogram.integrate();
  const double n = static_cast<double>(samples);
  const std::string where = describe(t.wo, t.mode, t.sides);

  std::vector<double> observed = histogram.observed(), expected;
  for (double p : integrals.cell_pdf) expected.push_back(n * p);
  const std::string picture = histogram.grid().describe_worst(observed, expected);
  observed.push_back(histogram.elsewhere());
  expected.push_back(std::max(0.0, n * (1.0 - integrals.pdf)));
  const TestResult chi = chi_square_test(observed, expected, kMinExpected);
  const bool worst = c.chi_square.add(chi.statistic, chi.p_value, [&] {
    std::string text = fmt::format("{}, {} dof", where, chi.dof);
    if (chi.p_value < 1e-4)
      text += fmt::format("; failed or delta: {} of {}, expected {:.1f}\n{}", histogram.elsewhere(), samples,
                          n * (1.0 - integrals.pdf), picture);
    return text;
  });
  if (worst) c.chi_square.set_map(histogram.grid().map(observed, expected));

  const double inside = 1.0 - histogram.elsewhere() / n, p = clamp(static_cast<float>(integrals.pdf), 0.0f, 1.0f);
  const double z_mass = (inside - integrals.pdf) / std::sqrt(p * (1.0 - p) / n + sqr(kIntegrationError));
  c.mass.add(z_mass, normal_two_sided(z_mass),
             [&] { return fmt::format("{}: integral {:.6f}, not failed {:.6f}", where, integrals.pdf, inside); });

  for (int lane = 0; lane < 3; ++lane) {
    const RunningStats& w = histogram.weight(lane);
    const double expected_mean = integrals.f[static_cast<size_t>(lane)];
    // Where samples rarely succeed, too few of them tell their own variance; it is at least that of a weight which is
    // the same whenever a sample succeeds.
    const double least = p > 0.0 ? sqr(expected_mean) * (1.0 / p - 1.0) / n : 0.0;
    const double error =
        std::sqrt(std::max(w.variance_of_mean(), least) + sqr(kIntegrationError * std::max(expected_mean, w.mean())));
    const double z = error > 0.0 ? (w.mean() - expected_mean) / error : 0.0;
    c.mean.add(z, normal_two_sided(z), [&] {
      return fmt::format("{}, lane {}: integral of eval_cos {:.6f}, mean weight {:.6f}", where, lane, expected_mean,
                         w.mean());
    });
  }
  return integrals.f;
}

}  // namespace

void check_histograms(const ScatterModel& m, const BsdfBatteryOptions& options, Results& out) {
  HistogramChecks c(m);
  Worst energy(m.name, "energy <= 1", 0.0), furnace(m.name, "furnace = 1", 1e-3);
  // Single sides of a tilted surface are those of its closure, which is tested alone.
  const bool two_sided = (m.lobes & kBothSides) == kBothSides && !m.is_tilted();
  const std::vector<Lobe> side_choices =
      two_sided ? std::vector<Lobe>{kBothSides, kReflection, kTransmission} : std::vector<Lobe>{kBothSides};
  uint64_t run = 0;
  for (const Vec3& wo : test_directions()) {
    if (m.grazing_cos(wo) < m.min_cos) continue;
    std::array<double, 3> albedo{};
    for (TransportMode mode : {TransportMode::kImportance, TransportMode::kRadiance}) {
      for (Lobe sides : side_choices) {
        // What is carried changes values, which both sides together show; single sides change what is sampled.
        const bool modes_differ = ((m.lobes & kTransmission) || m.is_tilted()) && sides == kBothSides;
        const bool wanted = m.has_smooth() && (mode == TransportMode::kImportance || modes_differ);
        if (!wanted) continue;
        const auto f = check_setting(m, {wo, mode, sides}, options.samples, hash_combine(options.seed, ++run), c);
        if (mode == TransportMode::kImportance && sides == kBothSides) albedo = f;
      }
    }
    if (m.has_delta()) {
      for (const DeltaLobe& l : find_delta_lobes(m, wo, TransportMode::kImportance, kBothSides))
        for (int lane = 0; lane < 3; ++lane)
          albedo[static_cast<size_t>(lane)] += static_cast<double>(l.sample.weight[lane]) * l.sample.pdf;
    }
    for (double a : albedo) {
      const auto where = [&] {
        return fmt::format("albedo {:.6f} at {}", a, describe(wo, TransportMode::kImportance));
      };
      energy.add(std::max(0.0, a - 1.0 - kIntegrationError), where);
      furnace.add(std::abs(a - 1.0), where);
    }
  }
  if (m.has_smooth())
    for (const WorstP* w : {&c.chi_square, &c.mass, &c.mean}) out.push_back(w->result());
  if (m.traits.energy_conserving) out.push_back(energy.result());
  if (m.lossless) out.push_back(furnace.result());
}

}  // namespace etd::bsdf_checks
