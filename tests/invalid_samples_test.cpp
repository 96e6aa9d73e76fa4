// Samples that are not light: kept out of the film, counted by kind, and named.
#include "film/invalid_samples.h"

#include <gtest/gtest.h>

#include <limits>

#include "integrators/pixel_integrator.h"
#include "render/driver.h"

namespace etd {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

PixelSample grey(float v) {
  PixelSample s;
  s.direct = Spectrum(v);
  s.albedo = Spectrum(0.5f);
  s.depth = 2, s.coverage = 1;
  s.rays = {1, 2, 3};
  return s;
}

TEST(InvalidSamples, EveryValueIsLookedAt) {
  const float huge = std::numeric_limits<float>::max();
  EXPECT_TRUE(is_sound(grey(0)));
  EXPECT_TRUE(is_sound(grey(-0.0f)));
  EXPECT_TRUE(is_sound(grey(huge)));
  for (const float v : {kNan, kInfinity, -kInfinity, -1e-30f}) {
    for (const int part : {0, 1, 2})
      for (const int lane : {0, 1, 2}) {
        PixelSample s = grey(1);
        (part == 0 ? s.emission : part == 1 ? s.direct : s.indirect).v[lane] = v;
        EXPECT_FALSE(is_sound(s)) << v << ' ' << part << ' ' << lane;
      }
    if (std::isfinite(v)) continue;
    PixelSample albedo = grey(1), normal = grey(1), depth = grey(1), weight = grey(1);
    albedo.albedo.v[2] = v, normal.normal.y = v, depth.depth = v, weight.weight = v;
    for (const PixelSample& s : {albedo, normal, depth, weight}) EXPECT_FALSE(is_sound(s)) << v;
  }
  // The padding lane is read by nothing, and a filter may have a negative weight.
  PixelSample s = grey(1);
  s.direct.v[3] = kNan;
  s.weight = -0.1f;
  EXPECT_TRUE(is_sound(s));
  s = grey(huge);
  s.emission = Spectrum(huge);
  EXPECT_FALSE(is_sound(s));
}

TEST(InvalidSamples, AreCountedByKindAndTheFirstIsKept) {
  InvalidSamples a, b;
  const auto take_out = [](InvalidSamples& counts, const SampleId& id, float x, float y) {
    PixelSample s = grey(1);
    s.emission = Spectrum::rgb(x, y, 1);
    EXPECT_FALSE(is_sound(s));
    counts.take_out(id, s);
    EXPECT_TRUE(is_sound(s));
    EXPECT_TRUE(is_black(s.emission + s.direct + s.indirect));
    EXPECT_EQ(s.coverage, 0.0f);
    EXPECT_EQ(s.rays.total(), 6u);
  };
  take_out(a, {3, 1, 5}, kNan, kInfinity);
  take_out(a, {2, 2, 5}, -1, kInfinity);
  take_out(b, {9, 0, 5}, -1, 0);
  take_out(b, {0, 9, 6}, 1e38f, -1);
  PixelSample overflow = grey(3e38f);
  overflow.indirect = overflow.direct;
  b.take_out({0, 9, 8}, overflow);
  EXPECT_EQ(*a.first, (SampleId{3, 1, 5}));
  EXPECT_EQ(*b.first, (SampleId{9, 0, 5}));
  InvalidSamples ab = a, ba = b;
  ab += b, ba += a;
  for (const InvalidSamples& sum : {ab, ba}) {
    EXPECT_EQ(sum.nan, 1u);
    EXPECT_EQ(sum.infinite, 2u);
    EXPECT_EQ(sum.negative, 2u);
    EXPECT_EQ(sum.total(), 5u);
    EXPECT_EQ(*sum.first, (SampleId{9, 0, 5}));
  }
}

// A good renderer with a planted defect: in every pixel the samples of one number are wrong, differently in each
// column; the strongest of the others is known.
class Defective : public PixelIntegrator {
 public:
  Defective(const IntegratorContext& context, float bad) : PixelIntegrator(context), bad_(bad) {}

  IntegratorTraits traits() const override { return {}; }

 protected:
  PixelSample sample_pixel(int x, int, Sampler& sampler) const override {
    const float u = sampler.get_1d();
    if (u < 0.1f) return grey(x % 4 == 3 ? 1.0f : bad_);
    return grey(u);
  }

 private:
  float bad_;
};

TEST(InvalidSamples, NeverReachTheFilm) {
  const IntegratorContext context{
      .sampler = sampler_kind("independent"), .seed = 5, .width = 20, .crop = {2, 1, 20, 12}, .tile_size = 4};
  const FilmSettings settings{.width = 20, .height = 12, .crop = context.crop};
  RenderObserver nobody;
  for (const float bad : {kNan, kInfinity, -1.0f}) {
    Defective integrator(context, bad);
    // What is expected is found by drawing each sample alone.
    InvalidSamples expected;
    for (int y = 1; y < 12; ++y)
      for (int x = 2; x < 20; ++x)
        for (uint32_t n = 0; n < 16; ++n) {
          PixelSample s = integrator.sample(x, y, n % 2, n / 2);
          if (!is_sound(s)) expected.take_out({x, y, n}, s);
        }
    ASSERT_GT(expected.total(), 100u);
    for (const int threads : {1, 4}) {
      Film film(settings);
      const RenderResult result = render(integrator, film, {.spp = 16, .threads = threads}, nobody);
      EXPECT_EQ(result.invalid.nan, expected.nan);
      EXPECT_EQ(result.invalid.infinite, expected.infinite);
      EXPECT_EQ(result.invalid.negative, expected.negative);
      EXPECT_EQ(*result.invalid.first, *expected.first);
      uint64_t left_out = 0;
      for (int y = 1; y < 12; ++y)
        for (int x = 2; x < 20; ++x) {
          const PixelSums sums = film.total(x, y);
          EXPECT_EQ(sums.count, 16.0);
          for (const double v : sums.mean_radiance()) EXPECT_TRUE(v > 0 && v <= 1) << v;
          left_out += static_cast<uint64_t>(16 - sums.coverage);
        }
      EXPECT_EQ(left_out, expected.total());
    }
  }
}

}  // namespace
}  // namespace etd
