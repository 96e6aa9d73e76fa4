// Metrics on pictures whose answers can be worked out by hand, and FLIP against its authors' own program.
#include "metrics/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "metrics/mae.h"
#include "metrics/psnr.h"
#include "metrics/rel_mse.h"
#include "metrics/rmse.h"
#include "metrics/ssim.h"
#include "spectrum/srgb.h"

namespace etd {
namespace {

Picture constant(int width, int height, std::array<float, 3> rgb) {
  Picture p{width, height, {}};
  for (size_t i = 0; i < p.pixels(); ++i) p.rgb.insert(p.rgb.end(), rgb.begin(), rgb.end());
  return p;
}

TEST(Metrics, PointwiseOnesByHand) {
  const std::vector<float> x = {1, 2, 3, 4}, r = {1, 0, 3, 1};
  EXPECT_DOUBLE_EQ(mse(x, r), (4 + 9) / 4.0);
  EXPECT_DOUBLE_EQ(rmse(x, r), std::sqrt(13.0 / 4));
  EXPECT_DOUBLE_EQ(mae(x, r), 5 / 4.0);
  EXPECT_DOUBLE_EQ(psnr(x, r), -10 * std::log10(13.0 / 4));
  EXPECT_DOUBLE_EQ(rel_mse(x, r).plain, (4 / 0.01 + 9 / 1.01) / 4);
  EXPECT_EQ(psnr(x, x), HUGE_VAL);
  EXPECT_EQ(mse({}, {}), 0);
}

TEST(Metrics, TrimmingDropsTheWorstThousandthOfThePixels) {
  std::vector<float> x(2999, 1.1f), r(2999, 1.0f);
  x[7] = x[2000] = 100;  // of 2999 pixels 2 are dropped
  const double small = rel_mse(std::vector<float>{1.1f}, std::vector<float>{1.0f}).plain;
  EXPECT_NEAR(rel_mse(x, r).trimmed, small, 1e-12);
  EXPECT_NEAR(rel_mse(x, r).plain, (2997 * small + 2 * 99 * 99 / 1.01) / 2999, 1e-9);
  x[100] = 100;
  EXPECT_NEAR(rel_mse(x, r).trimmed, (2996 * small + 99 * 99 / 1.01) / 2997, 1e-9);
  // Of interleaved channels whole pixels are dropped, those with the largest mean over the channels.
  std::vector<float> rgb(3000, 1), ref(3000, 1);
  rgb[0] = rgb[1] = rgb[2] = 2;
  rgb[3] = 2.5f;
  EXPECT_DOUBLE_EQ(rel_mse(rgb, ref, 3).trimmed, 2.25 / 1.01 / 3 / 999);
}

TEST(Metrics, SsimOfConstantsIsTheLuminanceTerm) {
  Plane a(16, 12), b(16, 12);
  for (float& v : a.values) v = 0.25f;
  for (float& v : b.values) v = 0.5f;
  EXPECT_NEAR(*ssim(a, a), 1, 1e-6);
  EXPECT_NEAR(*ssim(a, b), (2 * 0.25 * 0.5 + 1e-4) / (0.0625 + 0.25 + 1e-4), 1e-4);
  EXPECT_FALSE(ssim(Plane(10, 50), Plane(10, 50)));
}

// With x = mean + s and y = mean - s the covariance is minus the variance, whatever the window.
TEST(Metrics, SsimOfANegativeIsNegative) {
  Plane a(11, 11), b(11, 11);
  double m1 = 0, m2 = 0, sum = 0;
  for (int y = 0; y < 11; ++y)
    for (int x = 0; x < 11; ++x) {
      const double s = (x + y) % 2 == 0 ? 0.2 : -0.2;
      a.at(x, y) = static_cast<float>(0.5 + s), b.at(x, y) = static_cast<float>(0.5 - s);
      const double w = std::exp(-((x - 5) * (x - 5) + (y - 5) * (y - 5)) / 4.5);
      sum += w, m1 += w * s, m2 += w * s * s;
    }
  m1 /= sum, m2 /= sum;
  const double variance = m2 - m1 * m1, mx = 0.5 + m1, mr = 0.5 - m1;
  EXPECT_NEAR(*ssim(a, b),
              (2 * mx * mr + 1e-4) * (-2 * variance + 9e-4) / ((mx * mx + mr * mr + 1e-4) * (2 * variance + 9e-4)),
              1e-5);
}

TEST(Metrics, TheTableHasChannelsAndLuminance) {
  const Picture r = constant(12, 11, {0.5f, 0.5f, 0.5f}), x = constant(12, 11, {0.5f, 0.75f, 0.5f});
  const MetricTable table = compute_metrics(x, r);
  EXPECT_EQ(table.find("MSE", "R"), 0);
  EXPECT_DOUBLE_EQ(*table.find("MSE", "G"), 0.0625);
  EXPECT_DOUBLE_EQ(*table.find("MSE"), 0.0625 / 3);
  EXPECT_NEAR(*table.find("RMSE", "luminance"), 0.7152 * 0.25, 1e-7);
  EXPECT_NEAR(*table.find("PSNR", "G"), -20 * std::log10(linear_to_srgb(0.75f) - linear_to_srgb(0.5f)), 1e-5);
  EXPECT_EQ(table.find("PSNR", "B"), HUGE_VAL);
  EXPECT_NEAR(*table.find("SSIM", "R"), 1, 1e-6);
  EXPECT_TRUE(table.find("LDR-FLIP"));
  EXPECT_TRUE(table.find("HDR-FLIP"));
  EXPECT_FALSE(table.find("LDR-FLIP", "R"));
  EXPECT_FALSE(table.find("DSSIM"));
  // Two stops darker on the screen: 0.5 and 0.75 become 0.125 and 0.1875.
  EXPECT_NEAR(*compute_metrics(x, r, {.exposure = -2}).find("PSNR", "G"),
              -20 * std::log10(linear_to_srgb(0.1875f) - linear_to_srgb(0.125f)), 1e-5);
}

TEST(Metrics, PixelsThatAreNotFiniteAreLeftOutAndCounted) {
  const Picture r = constant(12, 12, {0.5f, 0.5f, 0.5f});
  Picture x = r;
  x.rgb[3] = NAN;
  x.rgb[7] = HUGE_VALF;
  const MetricTable table = compute_metrics(x, r);
  EXPECT_EQ(table.not_finite, 2u);
  EXPECT_EQ(table.find("MSE"), 0);
  EXPECT_NEAR(*table.find("HDR-FLIP"), 0, 1e-6);
}

// Pictures with edges, points and noise that a few lines make in any language; `test` moves edges and noise.
Picture pattern(bool test, bool high_range) {
  Picture p{40, 32, {}};
  for (int y = 0; y < p.height; ++y)
    for (int x = 0; x < p.width; ++x)
      for (int c = 0; c < 3; ++c) {
        const int ramp = (x * (c + 1) + 2 * y + (!test && x > 20 ? 1 : 0)) % 40;
        const int noise = (x * 73 + y * 151 + c * 37 + (x * y) % 11 * 19 + (test ? (x * 31 + y * 17) % 23 : 0)) % 64;
        double v = 0.675 * (0.5 + 0.5 * ramp / 40.0) + 0.25 * noise / 64.0;
        if (high_range) v *= v * ((x / 8 + y / 8) % 3 == 0 ? 8.0 : 0.25);
        p.rgb.push_back(static_cast<float>(v));
      }
  return p;
}

// The numbers are those of flip-evaluator 1.7 (PyPI, by the papers' authors), evaluate(reference, test, "LDR" or "HDR",
// applyMagma=False), of the patterns above; LDR values are taken for sRGB there.
struct Published {
  int x, y;
  double ldr, hdr;
};
constexpr Published kPublished[] = {{0, 0, 0.22897835075855255, 0.24691803753376007},
                                    {20, 16, 0.2197573482990265, 0.1691405326128006},
                                    {21, 3, 0.4001917839050293, 0.4084952771663666},
                                    {39, 31, 0.17776831984519958, 0.14746198058128357},
                                    {7, 25, 0.1997581422328949, 0.1449279934167862}};

TEST(Metrics, LdrFlipIsThatOfItsAuthors) {
  Picture test = pattern(true, false), reference = pattern(false, false);
  for (Picture* p : {&test, &reference})
    for (float& v : p->rgb) v = srgb_to_linear(v);
  const Plane map = ldr_flip(test, reference, flip_default_pixels_per_degree());
  EXPECT_NEAR(mean(map), 0.18479356169700623, 2e-5);
  for (const Published& p : kPublished) EXPECT_NEAR(map.at(p.x, p.y), p.ldr, 1e-4) << p.x << ' ' << p.y;
  EXPECT_EQ(mean(ldr_flip(test, test, flip_default_pixels_per_degree())), 0);
}

TEST(Metrics, LdrFlipOfPlainColours) {
  using Rgb = std::array<float, 3>;
  const auto flip = [](Rgb r, Rgb t) {
    for (Rgb* c : {&r, &t})
      for (float& v : *c) v = srgb_to_linear(v);
    return mean(ldr_flip(constant(32, 32, t), constant(32, 32, r), flip_default_pixels_per_degree()));
  };
  EXPECT_NEAR(flip({1, 0, 0}, {0, 1, 0}), 0.986678957939148, 2e-5);
  EXPECT_NEAR(flip({1, 1, 1}, {0, 0, 0}), 0.9673951268196106, 2e-5);
  EXPECT_NEAR(flip({0.5f, 0.5f, 0.5f}, {0.6f, 0.5f, 0.5f}), 0.249648317694664, 1e-4);
  EXPECT_NEAR(flip({0, 1, 0}, {0, 0, 1}), 1, 1e-6);
}

TEST(Metrics, HdrFlipIsThatOfItsAuthors) {
  const Picture test = pattern(true, true), reference = pattern(false, true);
  const FlipExposures e = flip_exposures(reference);
  EXPECT_NEAR(e.start, -1.372191309928894, 1e-5);
  EXPECT_NEAR(e.stop, 4.133407115936279, 1e-5);
  EXPECT_EQ(e.count, 6);
  const Plane map = hdr_flip(test, reference, e, flip_default_pixels_per_degree());
  EXPECT_NEAR(mean(map), 0.15048623085021973, 2e-5);
  for (const Published& p : kPublished) EXPECT_NEAR(map.at(p.x, p.y), p.hdr, 1e-4) << p.x << ' ' << p.y;
}

TEST(Metrics, HdrFlipOfBlackPicturesExists) {
  const Picture black = constant(12, 12, {0, 0, 0}), grey = constant(12, 12, {0.5f, 0.5f, 0.5f});
  EXPECT_EQ(mean(hdr_flip(black, black, flip_exposures(black), 67)), 0);
  EXPECT_GT(mean(hdr_flip(grey, black, flip_exposures(black), 67)), 0.5);
  Picture mostly_black = black;
  mostly_black.rgb[0] = 1;
  EXPECT_TRUE(std::isfinite(mean(hdr_flip(grey, mostly_black, flip_exposures(mostly_black), 67))));
}

}  // namespace
}  // namespace etd
