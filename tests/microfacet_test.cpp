#include "bsdfs/microfacet.h"

#include <gtest/gtest.h>

#include "bsdfs/conductor.h"
#include "bsdfs/roughness.h"

namespace etd {
namespace {

// The distribution from its definition in slopes and angles, in double: independent of the code under test.
struct GgxReference {
  double ax, ay;

  double d(Vec3d h) const {
    const double c2 = h.z * h.z, tan2_scaled = (sqr(h.x / ax) + sqr(h.y / ay)) / c2;
    return 1.0 / (kPiD * ax * ay * c2 * c2 * sqr(1.0 + tan2_scaled));
  }
  double lambda(Vec3d w) const { return 0.5 * (std::sqrt(1.0 + (sqr(ax * w.x) + sqr(ay * w.y)) / (w.z * w.z)) - 1.0); }
};

// Calls f(h, dh) over the hemisphere of normals: midpoint rule in (theta, phi) with theta = atan(alpha tan t), which
// follows the lobe.
template <class F>
void for_each_normal(const GgxReference& g, int n, F&& f) {
  const double alpha = std::sqrt(g.ax * g.ay);
  for (int i = 0; i < n; ++i) {
    const double t = (i + 0.5) / n * kPiD / 2.0, theta = std::atan(alpha * std::tan(t));
    const double dtheta = alpha / (sqr(std::cos(t)) + sqr(alpha * std::sin(t))) * kPiD / 2.0 / n;
    for (int j = 0; j < n; ++j) {
      const double phi = (j + 0.5) / n * 2.0 * kPiD;
      f(Vec3d{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)},
        std::sin(theta) * dtheta * 2.0 * kPiD / n);
    }
  }
}

Vec3d direction(double cos_theta, double phi) {
  const double s = std::sqrt(1.0 - cos_theta * cos_theta);
  return {s * std::cos(phi), s * std::sin(phi), cos_theta};
}

TEST(Ggx, ProjectedAreaIsOneAndVisibleAreaIsTheCosine) {
  for (const auto& [ax, ay] : {std::pair{1.0f, 1.0f}, {0.1f, 0.1f}, {0.05f, 0.5f}, {1e-3f, 1e-3f}, {1e-4f, 2e-4f}}) {
    const Ggx ggx{ax, ay};
    const GgxReference reference{ax, ay};
    for (double c : {1.0, 0.6, 0.1}) {
      const Vec3d wo = direction(c, 0.7);
      double projected = 0, visible = 0;
      for_each_normal(reference, 400, [&](Vec3d h, double dh) {
        const double d = ggx.d(to_float(h));
        projected += d * h.z * dh;
        visible += ggx.g1(to_float(wo)) * std::max(0.0, dot(wo, h)) * d * dh;
      });
      EXPECT_NEAR(projected, 1.0, 1e-4) << ax << ' ' << ay;
      EXPECT_NEAR(visible / c, 1.0, 3e-3) << ax << ' ' << ay << ' ' << c;
    }
  }
}

TEST(Ggx, AgreesWithItsDefinition) {
  for (const auto& [ax, ay] : {std::pair{1.0f, 1.0f}, {0.1f, 0.3f}, {1e-4f, 1e-4f}}) {
    const Ggx ggx{ax, ay};
    const GgxReference reference{ax, ay};
    for (double c : {1.0, 0.8, 0.3, 0.01, 1e-6}) {
      const Vec3d w = direction(c, 2.0), v = direction(0.4, -1.0);
      EXPECT_NEAR(ggx.g1(to_float(w)) * (1.0 + reference.lambda(w)), 1.0, 1e-5);
      const double g2 = 1.0 / (1.0 + reference.lambda(w) + reference.lambda(v));
      EXPECT_NEAR(ggx.reflection_factor(to_float(w), to_float(v)) * 4.0 * w.z / g2, 1.0, 1e-5);
      EXPECT_NEAR(ggx.d(to_float(w)) / reference.d(to_double(to_float(w))), 1.0, 1e-5);
    }
    EXPECT_NEAR(ggx.d({0, 0, 1}) * kPiD * ax * ay, 1.0, 1e-5);
  }
}

// alpha = 1 at normal incidence has a closed form: visible normals reflect uniformly over the sphere, half of them
// below the surface, and G2 / G1 = 2 c / (1 + c), which integrates to 1 - ln 2.
TEST(RoughConductor, FullyRoughMirrorReflectsOneMinusLogTwo) {
  const RoughConductor mirror{Spectrum(0.0f), Spectrum(0.0f), {1.0f, 1.0f}};
  HashStream rng(0);
  double sum = 0;
  int failures = 0;
  const int n = 400;
  for (int i = 0; i < n * n; ++i) {
    const Vec3 u{(static_cast<float>(i % n) + 0.5f) / n, (static_cast<float>(i / n) + 0.5f) / n, 0.5f};
    const auto s = mirror.sample({0, 0, 1}, u, TransportMode::kRadiance, rng, kBothSides);
    if (!s) {
      ++failures;
      continue;
    }
    EXPECT_NEAR(s->pdf, 1.0 / (4.0 * kPiD), 1e-5);
    sum += s->weight[0];
  }
  EXPECT_NEAR(sum / (n * n), 1.0 - std::log(2.0), 1e-4);
  EXPECT_NEAR(static_cast<double>(failures) / (n * n), 0.5, 1.0 / n);
}

// The mean weight of the samples against the reflectance integrated over microfacet normals in double.
TEST(RoughConductor, ReflectanceAgreesWithIntegrationOverNormals) {
  const float eta = 0.21f, k = 3.45f;
  for (const auto& [ax, ay] : {std::pair{0.1f, 0.1f}, {0.5f, 0.5f}, {1.0f, 1.0f}, {0.1f, 0.6f}}) {
    const RoughConductor copper{Spectrum(eta), Spectrum(k), {ax, ay}};
    const GgxReference reference{ax, ay};
    for (double c : {1.0, 0.7, 0.2}) {
      const Vec3d wo = direction(c, 0.4);
      double expected = 0;
      for_each_normal(reference, 1000, [&](Vec3d h, double dh) {
        const double cos_d = dot(wo, h);
        const Vec3d wi = h * (2.0 * cos_d) - wo;
        if (cos_d <= 0.0 || wi.z <= 0.0) return;
        const double g2 = 1.0 / (1.0 + reference.lambda(wo) + reference.lambda(wi));
        const double f = fresnel_conductor(static_cast<float>(cos_d), eta, k);
        expected += f * reference.d(h) * g2 * cos_d / wo.z * dh;
      });
      HashStream rng(0);
      double mean = 0;
      const int n = 500;
      for (int i = 0; i < n * n; ++i) {
        const Vec3 u{(static_cast<float>(i % n) + 0.5f) / n, (static_cast<float>(i / n) + 0.5f) / n, 0.5f};
        if (const auto s = copper.sample(to_float(wo), u, TransportMode::kRadiance, rng, kBothSides))
          mean += static_cast<double>(s->weight[0]) / (n * n);
      }
      EXPECT_NEAR(mean, expected, 1e-3) << ax << ' ' << ay << ' ' << c;
    }
  }
}

TEST(Roughness, RemapsAndDecidesWhatIsSmooth) {
  EXPECT_FALSE(microfacet_alpha(0.0f, 0.0f, true));
  EXPECT_FALSE(microfacet_alpha(9e-4f, 1e-5f, false));
  EXPECT_FALSE(microfacet_alpha(-1.0f, std::nanf(""), true));
  EXPECT_EQ(*microfacet_alpha(0.25f, 0.01f, true), (Vec2{0.5f, 0.1f}));
  EXPECT_EQ(*microfacet_alpha(0.25f, 0.0f, false), (Vec2{0.25f, 1e-4f}));
  EXPECT_EQ(*microfacet_alpha(1e-3f, 1e-3f, false), (Vec2{1e-3f, 1e-3f}));
}

}  // namespace
}  // namespace etd
