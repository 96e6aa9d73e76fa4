#include "bsdfs/energy.h"

#include <map>
#include <memory>
#include <mutex>

namespace etd {

namespace {

// The mean weight of samples on a Fibonacci lattice of numbers. It is finer where u.y is near 1, which makes the few
// steep facets that lose most. The closures are isotropic and wo has no y, so half of the azimuths is enough.
template <class Closure>
double mean_weight(const Closure& c, Vec3 wo) {
  constexpr int kPoints = 610, kStep = 377;
  HashStream unused(0);
  double sum = 0;
  for (int i = 0; i < kPoints; ++i) {
    const float t = (static_cast<float>(i) + 0.5f) / kPoints;
    const float around = (static_cast<float>(i * kStep % kPoints) + 0.5f) / kPoints;
    for (const Lobe side : {kReflection, kTransmission})
      if (const auto s = c.sample(wo, {0.5f * around, 1.0f - t * t, 0.5f}, TransportMode::kImportance, unused, side))
        sum += static_cast<double>(s->weight[0] * 2.0f * t);
  }
  return sum / kPoints;
}

}  // namespace

// Nodes are the squares of even steps: E changes fastest where alpha and the cosine are small.
template <class F>
EnergyTable::EnergyTable(const F& closure_of, bool two_sided) {
  const auto node = [](int i) { return std::max(sqr(static_cast<float>(i) / kCells), 1e-5f); };
  for (int i = 0; i <= kCells; ++i)
    for (int j = 0; j <= kCells; ++j) {
      const auto closure = closure_of(std::max(node(i), 1e-4f));
      const float z = node(j), x = safe_sqrt(1.0f - z * z);
      const auto at = static_cast<size_t>(i * (kCells + 1) + j);
      outside_[at] = static_cast<float>(mean_weight(closure, {x, 0, z}));
      inside_[at] = two_sided ? static_cast<float>(mean_weight(closure, {x, 0, -z})) : outside_[at];
    }
}

float EnergyTable::albedo(float alpha, float cosine) const {
  const Grid& grid = cosine > 0.0f ? outside_ : inside_;
  const float x = std::sqrt(std::min(alpha, 1.0f)) * kCells, y = std::sqrt(std::min(std::abs(cosine), 1.0f)) * kCells;
  const int i = std::min(static_cast<int>(x), kCells - 1), j = std::min(static_cast<int>(y), kCells - 1);
  const float dx = x - static_cast<float>(i), dy = y - static_cast<float>(j);
  const float* at = grid.data() + i * (kCells + 1) + j;
  const float here = at[0] + (at[1] - at[0]) * dy;
  const float next = at[kCells + 1] + (at[kCells + 2] - at[kCells + 1]) * dy;
  return here + (next - here) * dx;
}

const EnergyTable& mirror_energy() {
  static const EnergyTable table(
      [](float alpha) {
        return RoughConductor{Spectrum(0.0f), Spectrum(0.0f), {alpha, alpha}};
      },
      false);
  return table;
}

const EnergyTable& dielectric_energy(float eta) {
  static std::mutex mutex;
  static std::map<float, std::unique_ptr<const EnergyTable>> tables;
  const std::lock_guard lock(mutex);
  auto& table = tables[eta];
  if (!table)
    table = std::make_unique<const EnergyTable>(
        [eta](float alpha) {
          return RoughDielectric{eta, {alpha, alpha}};
        },
        true);
  return *table;
}

}  // namespace etd
