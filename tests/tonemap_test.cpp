#include "render/tonemap.h"

#include <gtest/gtest.h>

#include <cmath>

#include "spectrum/color_space.h"
#include "spectrum/colorimetry.h"
#include "spectrum/white_balance.h"

namespace etd {
namespace {

std::vector<float> mapped(std::vector<float> rgb, const ToneMapping& mapping) {
  EXPECT_EQ(tone_map(rgb, mapping), 0u);
  return rgb;
}

TEST(ToneMap, ExposureMultipliesAndTheScreenClips) {
  const std::vector<float> in = {0.1f, 0.2f, 0.3f, 0.6f, -1, 4};
  EXPECT_EQ(mapped(in, {}), (std::vector<float>{0.1f, 0.2f, 0.3f, 0.6f, 0, 1}));
  EXPECT_EQ(mapped(in, {.exposure = 1}), (std::vector<float>{0.2f, 0.4f, 0.6f, 1, 0, 1}));
}

TEST(ToneMap, FilmicRisesFromBlackToWhite) {
  const ToneMapping film{.exposure = -1, .curve = ToneOperator::kFilmic};
  // Narkowicz's curve at 0.5 and 1, by hand: 0.5 * 1.285 / (0.5 * 1.805 + 0.14), 2.54 / 3.16.
  const std::vector<float> out = mapped({1, 2, 0, 1e30f, INFINITY, -1}, film);
  EXPECT_NEAR(out[0], 0.6425 / 1.0425, 1e-6);
  EXPECT_NEAR(out[1], 2.54 / 3.16, 1e-6);
  EXPECT_EQ(out[2], 0);
  EXPECT_EQ(out[3], 1);
  EXPECT_EQ(out[4], 1);
  EXPECT_EQ(out[5], 0);
  float last = 0;
  for (float x = 0.01f; x < 40; x *= 1.1f) {
    const float y = mapped({x, x, x}, film)[1];
    EXPECT_GE(y, last) << x;
    last = y;
  }
}

TEST(ToneMap, WhatIsNoNumberIsBlackAndCounted) {
  std::vector<float> rgb = {1, NAN, 0.5f, 0.1f, 0.1f, 0.1f, NAN, NAN, NAN};
  EXPECT_EQ(tone_map(rgb, {}), 2u);
  EXPECT_EQ(rgb, (std::vector<float>{0, 0, 0, 0.1f, 0.1f, 0.1f, 0, 0, 0}));
}

TEST(WhiteBalance, TemperaturesAreThoseOfTheTables) {
  const auto xy = [](double kelvin) {
    const Vec3d w = white_of_temperature(kelvin);
    return std::pair(w.x / (w.x + w.y + w.z), w.y / (w.x + w.y + w.z));
  };
  // CIE 15: illuminant A (a black body of 2856 K), D55, D65, D75.
  for (const auto& [kelvin, x, y] : {std::tuple(2856.0, 0.44757, 0.40745), std::tuple(5503.0, 0.33242, 0.34743),
                                     std::tuple(6504.0, 0.31272, 0.32903), std::tuple(7504.0, 0.29902, 0.31485)}) {
    EXPECT_NEAR(xy(kelvin).first, x, 3e-4) << kelvin;
    EXPECT_NEAR(xy(kelvin).second, y, 3e-4) << kelvin;
  }
  for (const double edge : {4000.0, 5000.0, 7000.0}) {
    EXPECT_NEAR(xy(edge - 0.01).first, xy(edge + 0.01).first, 2e-5);
    EXPECT_NEAR(xy(edge - 0.01).second, xy(edge + 0.01).second, 2e-5);
  }
  for (double kelvin = kCoolestWhite; kelvin < 24000; kelvin *= 1.05)
    EXPECT_GT(xy(kelvin).first, xy(kelvin * 1.05).first) << kelvin;
}

std::vector<float> balanced(const std::vector<float>& rgb, const std::array<Vec3d, 3>& balance) {
  return mapped(rgb, {.balance = balance});
}

TEST(WhiteBalance, LightOfTheTemperatureBecomesWhiteOfItsLuminance) {
  for (const double kelvin : {1800.0, 3200.0, 4500.0, 6504.0, 12000.0}) {
    const Vec3d white = xyz_to_rec709(white_of_temperature(kelvin) * 0.25);
    std::vector<float> rgb;
    for (const double v : {white.x, white.y, white.z}) rgb.push_back(static_cast<float>(v));
    for (const float v : balanced(rgb, adapt_rec709(white_of_temperature(kelvin))))
      EXPECT_NEAR(v, 0.25, 1e-5) << kelvin;
  }
  // The white of Rec.709 itself changes nothing.
  const std::vector<float> any = {0.1f, 0.5f, 0.3f};
  const std::vector<float> same = balanced(any, adapt_rec709(rec709_to_xyz({1, 1, 1})));
  const std::vector<float> nearly = balanced(any, adapt_rec709(white_of_temperature(6504)));
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(same[i], any[i], 1e-6);
    EXPECT_NEAR(nearly[i], any[i], 1e-3);
  }
}

TEST(WhiteBalance, GreyWorldMakesTheMeanGrey) {
  const std::vector<float> rgb = {0.4f, 0.2f, 0.1f, 0.2f, 0.3f, 0.1f, INFINITY, 0, 0, NAN, 1, 1};
  const auto balance = grey_world_balance(rgb);
  ASSERT_TRUE(balance);
  const std::vector<float> out = balanced({0.3f, 0.25f, 0.1f}, *balance);
  EXPECT_NEAR(out[0], out[1], 1e-6);
  EXPECT_NEAR(out[1], out[2], 1e-6);
  EXPECT_TRUE(grey_world_balance(std::vector<float>{0, 0, 1}));
  EXPECT_FALSE(grey_world_balance(std::vector<float>{0, 0, 0}));
  EXPECT_FALSE(grey_world_balance(std::vector<float>{1, -0.1f, 1}));
}

}  // namespace
}  // namespace etd
