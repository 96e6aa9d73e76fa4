#include "metrics/rel_mse.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "core/math.h"

namespace etd {
namespace {

constexpr double kEpsilon = 0.01;
constexpr size_t kTrimmedOneIn = 1000;

}  // namespace

RelMse rel_mse(std::span<const float> x, std::span<const float> r, int channels) {
  const size_t step = static_cast<size_t>(channels), pixels = x.size() / step;
  if (pixels == 0) return {};
  std::vector<double> errors(pixels, 0.0);
  for (size_t i = 0; i < x.size(); ++i) {
    const double ref = r[i];
    errors[i / step] += sqr(x[i] - ref) / (sqr(ref) + kEpsilon) / channels;
  }
  const size_t kept = pixels - pixels / kTrimmedOneIn;
  const auto end = errors.begin() + static_cast<std::ptrdiff_t>(kept);
  std::nth_element(errors.begin(), end - 1, errors.end());
  const double most = std::accumulate(errors.begin(), end, 0.0), rest = std::accumulate(end, errors.end(), 0.0);
  return {(most + rest) / static_cast<double>(pixels), most / static_cast<double>(kept)};
}

}  // namespace etd
