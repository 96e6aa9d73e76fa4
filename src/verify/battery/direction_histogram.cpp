#include "verify/battery/direction_histogram.h"

#include <fmt/format.h>

#include "verify/battery/direction_grid.h"

namespace etd {

namespace {
constexpr double kMinExpected = 20.0;
// The number of samples for which DirectionDensity::integration_error and two forced splits at jumps are enough.
constexpr double kUsualSamples = 40000.0;
}  // namespace

void check_direction_density(const DirectionDensity& density, const std::string& where, size_t samples, uint64_t seed,
                             WorstP& chi_square, WorstP& mass) {
  std::vector<Vec3> pilots;
  HashStream pilot_numbers(hash_combine(seed, 1)), numbers(hash_combine(seed, 2));
  for (size_t i = 0; i < samples / 2; ++i)
    if (const auto wi = density.draw(pilot_numbers)) pilots.push_back(*wi);
  const DirectionGrid grid(pilots, std::max<size_t>(samples / 2 / density.cells, 1));

  std::vector<double> observed(grid.cell_count(), 0.0), expected;
  double elsewhere = 0, integral = 0;
  for (size_t i = 0; i < samples; ++i) {
    const auto wi = density.draw(numbers);
    (wi ? observed[grid.find(*wi)] : elsewhere) += 1.0;
  }
  // More samples see smaller errors of the integrals.
  const double n = static_cast<double>(samples), finer = std::max(1.0, std::sqrt(n / kUsualSamples));
  const double integration_error = density.integration_error / finer;
  const int splits = density.jumps ? 2 + static_cast<int>(std::ceil(std::log2(finer))) : 0;
  for (size_t i = 0; i < grid.cell_count(); ++i) {
    const auto cell = grid.integrate(
        i, [&](Vec3 wi) { return std::array<double, 4>{density.pdf(wi)}; }, 0.1 * integration_error, splits);
    expected.push_back(n * cell[0]);
    integral += cell[0];
  }
  const std::vector<double> observed_directions = observed, expected_directions = expected;
  observed.push_back(elsewhere);
  expected.push_back(std::max(0.0, n * (1.0 - integral)));
  const TestResult chi = chi_square_test(observed, expected, kMinExpected);
  const bool worst = chi_square.add(chi.statistic, chi.p_value, [&] {
    std::string text = fmt::format("{}, {} dof", where, chi.dof);
    if (chi.p_value < 1e-4) text.append("\n").append(grid.describe_worst(observed_directions, expected_directions));
    return text;
  });
  if (worst) chi_square.set_map(grid.map(observed_directions, expected_directions));
  const double inside = 1.0 - elsewhere / n, q = std::clamp(integral, 0.0, 1.0);
  const double z = (inside - integral) / std::sqrt(q * (1.0 - q) / n + sqr(integration_error));
  mass.add(z, normal_two_sided(z),
           [&] { return fmt::format("{}: integral {:.6f}, samples {:.6f}", where, integral, inside); });
}

}  // namespace etd
