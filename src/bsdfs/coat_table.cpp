#include "bsdfs/coat_table.h"

#include <utility>
#include <vector>

namespace etd {

namespace {

struct Node {
  double x, weight;
};

// The rule of Gauss and Legendre on [0, 1], by Newton's method on the Legendre polynomial.
std::vector<Node> gauss_legendre(int n) {
  std::vector<Node> nodes;
  for (int i = 0; i < n; ++i) {
    double x = std::cos(kPiD * (i + 0.75) / (n + 0.5)), slope = 1;
    for (int step = 0; step < 8; ++step) {
      double p = x, before = 1;
      for (int k = 2; k <= n; ++k) before = std::exchange(p, ((2 * k - 1) * x * p - (k - 1) * before) / k);
      slope = n * (x * p - before) / (x * x - 1);
      x -= p / slope;
    }
    nodes.push_back({0.5 * (1 - x), 1 / ((1 - x * x) * slope * slope)});
  }
  return nodes;
}

// Nodes for integrals over [0, 1] that are dense at both ends and at `edge`: where cosines vanish, and where total
// reflection begins, functions bend sharply.
std::vector<Node> cosines_with_edge(double edge, int n) {
  std::vector<Node> nodes;
  for (const auto& [from, to] : {std::pair(0.0, edge), std::pair(edge, 1.0)}) {
    if (!(to > from)) continue;
    for (const auto& [x, weight] : gauss_legendre(n))
      nodes.push_back({from + (to - from) * x * x * (3 - 2 * x), (to - from) * 6 * x * (1 - x) * weight});
  }
  return nodes;
}

// The cosine inside at which total reflection begins, and outside for a coat thinner than air; 0 where it never does.
double critical_cosine(double index_ratio) {
  return index_ratio < 1 ? std::sqrt((1 - index_ratio) * (1 + index_ratio)) : 0.0;
}

// The share of the light from wo that the coat scatters to one side, attenuated along its new direction.
double share(const RoughDielectric& coat, Vec3 wo, Lobe side, float thickness, const std::vector<Node>& slopes,
             const std::vector<Node>& azimuths) {
  // Numbers u.y near 1 make steep facets, whose slope grows like alpha / t^2; those with u.x near 1/2 face away from a
  // grazing wo. The coat is isotropic and wo has no y, so half of the azimuths is enough.
  HashStream unused(0);
  double sum = 0;
  for (const auto& [t, t_weight] : slopes)
    for (const auto& [around, weight] : azimuths) {
      const Vec3 u{0.5f * static_cast<float>(around), static_cast<float>(1 - t * t), 0.5f};
      if (const auto s = coat.sample(wo, u, TransportMode::kImportance, unused, side))
        sum += 2 * t * t_weight * weight *
               static_cast<double>(s->weight[0] * coat_transmittance(thickness, std::abs(s->wi.z)));
    }
  return sum;
}

// Returns the share of diffuse light from the base that a rough coat sends back and that arrives there. By the facet's
// normal h, the cosine c to it, and the azimuth psi about it, for which the measure of both directions is 4 c dh dc
// dpsi and the reflection operator (Walter et al. 2007, equation 20) leaves
//   1/pi int D(h) dh int c F(c) dc int G2 exp(-thickness (1/mu1 + 1/mu2)) dpsi,
// mu1 and mu2 being c h.z +- s cos(psi), s the product of the sines. Where total reflection begins and where directions
// end below the surface are then ends of intervals. With tan(h) = alpha sqrt(1 - t^2) / t, D(h) dh is 2 t dt / h.z.
double rough_returned_share(const RoughDielectric& coat, float thickness) {
  const std::vector<Node> slopes = gauss_legendre(24), azimuths = gauss_legendre(10);
  const double alpha = coat.ggx.ax;
  const std::vector<Node> cosines = cosines_with_edge(critical_cosine(1.0 / coat.eta), 16);
  // 1 + 2 Lambda, Lambda being Smith's function (Heitz 2014, equation 86).
  const auto masking = [alpha](double mu) { return std::sqrt(1 + sqr(alpha) * (1 - mu) * (1 + mu) / sqr(mu)); };
  double sum = 0;
  for (const auto& [t, t_weight] : slopes) {
    const double tan2 = sqr(alpha) * (1 - t) * (1 + t) / sqr(t), hz = 1 / std::sqrt(1 + tan2),
                 sin_h = std::sqrt(tan2) * hz;
    for (const auto& [c, c_weight] : cosines) {
      const double middle = c * hz, s = sin_h * std::sqrt((1 - c) * (1 + c));
      const double first = s > middle ? std::acos(middle / s) : 0, range = 0.5 * kPiD - first;  // of psi, a quarter
      double around = 0;
      for (const auto& [x, weight] : azimuths) {
        const double d = s * std::cos(first + range * x), mu1 = std::min(middle + d, 1.0), mu2 = middle - d;
        if (!(mu2 > 0)) continue;
        around += weight * 2 / (masking(mu1) + masking(mu2)) * std::exp(-thickness * (1 / mu1 + 1 / mu2));
      }
      const double f = fresnel_dielectric(static_cast<float>(c), 1.0f / coat.eta).reflectance;
      sum += 2 * t / hz * t_weight * c * f * c_weight * 4 * range * around;
    }
  }
  return sum / kPiD;
}

Vec3 direction(float cosine) { return {safe_sqrt(1.0f - cosine * cosine), 0, cosine}; }

}  // namespace

CoatMeans smooth_coat_means(float eta, float thickness) {
  constexpr int kNodes = 48;
  double returned = 0, entering = 0;
  for (const auto& [mu, weight] : cosines_with_edge(critical_cosine(1.0 / eta), kNodes)) {
    const auto cosine = static_cast<float>(mu);
    const float there = coat_transmittance(thickness, cosine);
    returned += 2 * mu * weight * static_cast<double>(fresnel_dielectric(cosine, 1.0f / eta).reflectance * sqr(there));
  }
  for (const auto& [mu, weight] : cosines_with_edge(critical_cosine(eta), kNodes)) {
    const auto [reflectance, cos_t] = fresnel_dielectric(static_cast<float>(mu), eta);
    if (cos_t > 0.0f)
      entering += 2 * mu * weight * static_cast<double>((1.0f - reflectance) * coat_transmittance(thickness, cos_t));
  }
  return {static_cast<float>(returned), static_cast<float>(entering)};
}

CoatTable::CoatTable(float eta, float alpha, float thickness)
    : boundary_{eta, {alpha, alpha}},
      width_(std::min(0.25f * alpha, 0.001f)),
      nodes_per_unit_(kCells / std::asinh(1.0f / width_)) {
  const std::vector<Node> slopes = gauss_legendre(24), azimuths = gauss_legendre(16), few = gauss_legendre(12);
  for (int i = 0; i <= kCells; ++i) {
    const Vec3 wo = direction(std::max(cosine_of(i), 1e-6f));
    const auto at = static_cast<size_t>(i);
    entering_[at] = static_cast<float>(share(boundary_, wo, kTransmission, thickness, slopes, azimuths));
    reflected_[at] = static_cast<float>(share(boundary_, wo, kReflection, 0, few, few));
  }
  double entering = 0;
  for (const auto& [mu, weight] : cosines_with_edge(0.0, 24))
    entering += 2 * mu * weight * static_cast<double>(shares(static_cast<float>(mu)).entering);
  means_ = {static_cast<float>(rough_returned_share(boundary_, thickness)), static_cast<float>(entering)};
}

float CoatTable::cosine_of(int node) const {
  const float v = std::min(width_ * std::sinh(static_cast<float>(node) / nodes_per_unit_), 1.0f);
  return v * (2.0f - v);
}

CoatShares CoatTable::shares(float cosine) const {
  const float v = cosine / (1.0f + safe_sqrt(1.0f - cosine)), q = v / width_;
  const float x = std::log(q + std::sqrt(q * q + 1.0f)) * nodes_per_unit_;  // asinh
  const int first = std::clamp(static_cast<int>(x) - 1, 0, kCells - 3);
  // The cubic through the four nodes around (Lagrange).
  const float t = x - static_cast<float>(first), a = t - 1.0f, b = t - 2.0f, c = t - 3.0f;
  const auto interpolate = [&](const Nodes& nodes) {
    const float* y = nodes.data() + first;
    const float value = (t * b * c * y[1] - t * a * c * y[2]) * 0.5f + (t * a * b * y[3] - a * b * c * y[0]) / 6.0f;
    return std::max(value, 0.0f);
  };
  return {interpolate(reflected_), interpolate(entering_)};
}

const CoatTable* CoatTables::find(float eta, float alpha, float thickness) {
  auto& table = tables_[{eta, alpha, thickness}];
  if (!table) table = std::make_unique<const CoatTable>(eta, alpha, thickness);
  return table.get();
}

}  // namespace etd
