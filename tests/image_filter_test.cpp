// Levels of images and filters over footprints, against what they are made to approximate.
#include "textures/image_filter.h"

#include <gtest/gtest.h>

#include <functional>

#include "core/hash.h"
#include "textures/pyramid.h"
#include "textures/texture_image.h"

namespace etd {
namespace {

Image make_image(int width, int height, int channels, const std::function<float(int, int, int)>& value) {
  std::vector<float> texels;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < channels; ++c) texels.push_back(value(x, y, c));
  return Image(width, height, channels, texels);
}

Image random_image(int width, int height, int channels) {
  HashStream rng(3);
  return make_image(width, height, channels, [&](int, int, int) { return rng.next_float(); });
}

double mean_of(const Image& image, int c) {
  double sum = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) sum += double(image.texel(x, y, c));
  return sum / image.width() / image.height();
}

TEST(Half, EveryOneIsExactAndRoundTrips) {
  for (uint32_t bits = 0; bits < 0x10000; ++bits) {
    const auto h = static_cast<uint16_t>(bits);
    const int exponent = static_cast<int>(bits >> 10 & 31), fraction = static_cast<int>(bits & 1023);
    const float f = half_to_float(h);
    if (exponent == 31) {
      EXPECT_EQ(std::isnan(f), fraction != 0);
      if (fraction == 0) {
        EXPECT_EQ(float_to_half(f), h);
      }
      continue;
    }
    const double size = exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
    ASSERT_EQ(double(f), bits & 0x8000 ? -size : size);
    ASSERT_EQ(float_to_half(f), h);
  }
}

TEST(Half, RoundsToTheNearest) {
  EXPECT_EQ(float_to_half(1.0f + 0x1p-11f), float_to_half(1.0f));  // ties to even
  EXPECT_EQ(float_to_half(1.0f + 3 * 0x1p-11f), float_to_half(1 + 0x1p-9f));
  EXPECT_EQ(half_to_float(float_to_half(1e9f)), 65504.0f);
  EXPECT_EQ(half_to_float(float_to_half(-65519.0f)), -65504.0f);
  EXPECT_EQ(float_to_half(0x1p-25f), 0u);
  HashStream rng(1);
  for (int i = 0; i < 10000; ++i) {
    const float f = std::ldexp(rng.next_float() + 0.5f, static_cast<int>(rng.next_u32() % 24) - 12);
    EXPECT_LE(std::abs(half_to_float(float_to_half(f)) - f), f * 0x1p-11f);
  }
}

TEST(Pyramid, KeepsMeansAndConstants) {
  for (const auto& [width, height] : {std::pair(64, 64), {37, 22}, {5, 1}, {1, 9}, {128, 3}, {1, 1}}) {
    const Image image = random_image(width, height, 3);
    const std::vector<Image> levels = coarser_levels(image, ImageWrap::kRepeat);
    int w = width, h = height;
    for (const Image& level : levels) {
      w = std::max(1, w / 2), h = std::max(1, h / 2);
      ASSERT_EQ(level.width(), w);
      ASSERT_EQ(level.height(), h);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean_of(level, c), mean_of(image, c), 2e-6) << width << ' ' << height;
    }
    EXPECT_EQ(w * h, 1);
    const Image flat = make_image(width, height, 1, [](int, int, int) { return 0.7f; });
    for (const auto wrap : {ImageWrap::kRepeat, ImageWrap::kClamp, ImageWrap::kOctahedralSphere})
      for (const Image& level : coarser_levels(flat, wrap))
        for (int x = 0; x < level.width(); ++x) EXPECT_NEAR(level.texel(x, level.height() - 1, 0), 0.7f, 1e-5f);
  }
}

// Encoded bytes are averaged as light, and the average is not rounded to a byte again.
TEST(Pyramid, FiltersInLinearLight) {
  const Image image(2, 2, 1, std::vector<uint8_t>{0, 255, 255, 0}, ImageEncoding());
  const std::vector<Image> levels = coarser_levels(image, ImageWrap::kRepeat);
  ASSERT_EQ(levels.size(), 1u);
  EXPECT_EQ(levels[0].format().kind(), TexelFormat::Kind::kHalf);
  EXPECT_NEAR(levels[0].texel(0, 0, 0), 0.5f, 1e-3f);
}

// Waves that the coarser level can't show are taken away, others stay.
TEST(Pyramid, IsALowPass) {
  const auto amplitude = [](double period) {
    const Image wave = make_image(
        200, 1, 1, [&](int x, int, int) { return static_cast<float>(std::sin(2 * 3.14159265358979 * x / period)); });
    const Image level = coarser_level(wave, ImageWrap::kRepeat);
    double square = 0;
    for (int x = 0; x < level.width(); ++x) square += sqr(double(level.texel(x, 0, 0)));
    return std::sqrt(2 * square / level.width());
  };
  EXPECT_GT(amplitude(20), 0.95);
  EXPECT_GT(amplitude(10), 0.85);
  EXPECT_LT(amplitude(2.5), 0.05);
  EXPECT_LT(amplitude(2.2222222), 0.05);
}

// A level wraps as the image does: rolling the image by two texels rolls the level by one.
TEST(Pyramid, KnowsWhatLiesBeyondTheEdge) {
  const Image image = random_image(16, 8, 1);
  const Image rolled =
      make_image(16, 8, 1, [&](int x, int y, int) { return image.texel((x + 2) % 16, (y + 6) % 8, 0); });
  const Image a = coarser_level(image, ImageWrap::kRepeat), b = coarser_level(rolled, ImageWrap::kRepeat);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 8; ++x) EXPECT_NEAR(a.texel((x + 1) % 8, (y + 3) % 4, 0), b.texel(x, y, 0), 1e-6f);
  const Image white = make_image(16, 16, 1, [](int, int, int) { return 1.0f; });
  EXPECT_LT(coarser_level(white, ImageWrap::kBlack).texel(0, 0, 0), 0.95f);
}

TextureImage with_levels(Image finest, ImageWrap wrap) {
  std::vector<Image> coarser = coarser_levels(finest, wrap);
  return TextureImage(std::make_shared<const Image>(std::move(finest)), std::move(coarser));
}

// Where a texel is larger than the footprint, filters show what interpolation shows.
TEST(ImageFilters, DoNotBlurMagnifiedImages) {
  const TextureImage image = with_levels(random_image(32, 16, 3), ImageWrap::kRepeat);
  HashStream rng(8);
  for (int i = 0; i < 200; ++i) {
    ImageLookup at{{3 * rng.next_float() - 1, 3 * rng.next_float() - 1},
                   {0.3f / 32 * rng.next_float(), 0.3f / 16 * rng.next_float()},
                   {-0.3f / 32 * rng.next_float(), 0.3f / 16 * rng.next_float()}};
    const Spectrum bilinear = image.lookup(at);
    for (const ImageFilter filter : {ImageFilter::kTrilinear, ImageFilter::kEwa}) {
      at.filter = filter;
      const Spectrum value = image.lookup(at);
      for (int c = 0; c < 3; ++c) EXPECT_EQ(value[c], bilinear[c]);
    }
  }
}

TEST(ImageFilters, ContinuousInTheFootprint) {
  const TextureImage image = with_levels(random_image(64, 64, 1), ImageWrap::kRepeat);
  for (const ImageFilter filter : {ImageFilter::kTrilinear, ImageFilter::kEwa}) {
    float last = -1;
    for (float size = 0.05f / 64; size < 3; size *= 1.002f) {
      const float v = image.lookup({{0.31f, 0.77f}, {size, 0.4f * size}, {-0.1f * size, 0.3f * size}, filter})[0];
      if (last >= 0) {
        EXPECT_NEAR(v, last, 0.03) << size;
      }
      last = v;
    }
    EXPECT_NEAR(last, image.coarser().back().texel(0, 0, 0), 1e-5);
  }
}

// A plane with a checkerboard that runs to the horizon, seen through square pixels. The truth is the mean of a pixel.
TEST(ImageFilters, EwaIsNearTheMeanOfAPixel) {
  const TextureImage board =
      with_levels(make_image(64, 64, 1, [](int x, int y, int) { return (x / 8 + y / 8) % 2 == 0 ? 1.0f : 0.0f; }),
                  ImageWrap::kRepeat);
  // The camera is 1 above the plane and looks along it; a pixel is 0.02 wide at distance 1.
  const float pixel = 0.02f, repeats = 0.5f;
  const auto plane = [&](float x, float y) {
    const float distance = 1.0f / (y * pixel);
    return Vec2{repeats * x * pixel * distance, repeats * distance};
  };
  double errors[4] = {0, 0, 0, 0};
  for (int row = 1; row < 30; ++row)
    for (int column = -20; column < 20; ++column) {
      const float x = static_cast<float>(column) + 0.5f, y = static_cast<float>(row) + 0.5f, h = 0.01f;
      const Vec2 st = plane(x, y), right = plane(x + h, y), down = plane(x, y + h);
      ImageLookup at{st, {(right.x - st.x) / h, (right.y - st.y) / h}, {(down.x - st.x) / h, (down.y - st.y) / h}};
      at.max_anisotropy = 32;
      double truth = 0;
      constexpr int kSide = 24;
      for (int i = 0; i < kSide * kSide; ++i) {
        const Vec2 p = plane(x + (static_cast<float>(i % kSide) + 0.5f) / kSide - 0.5f,
                             y + (static_cast<float>(i / kSide) + 0.5f) / kSide - 0.5f);
        truth += double(board.lookup({p, {}, {}, ImageFilter::kPoint})[0]) / (kSide * kSide);
      }
      for (size_t f = 0; f < 4; ++f) {
        at.filter = static_cast<ImageFilter>(f);
        errors[f] += sqr(double(board.lookup(at)[0]) - truth);
      }
    }
  const auto rms = [&](ImageFilter f) { return std::sqrt(errors[static_cast<size_t>(f)] / (29 * 40)); };
  RecordProperty("ewa", std::to_string(rms(ImageFilter::kEwa)));
  RecordProperty("trilinear", std::to_string(rms(ImageFilter::kTrilinear)));
  RecordProperty("bilinear", std::to_string(rms(ImageFilter::kBilinear)));
  EXPECT_LT(rms(ImageFilter::kEwa), 0.33 * rms(ImageFilter::kBilinear));
  EXPECT_LT(rms(ImageFilter::kEwa), 0.5 * rms(ImageFilter::kTrilinear));
}

TEST(ImageFilters, WildFootprintsGiveNumbers) {
  const float wild[] = {0, 1e-38f, 1e-3f, 1, 1e9f, 3e38f};
  for (const auto wrap : {ImageWrap::kRepeat, ImageWrap::kBlack, ImageWrap::kClamp, ImageWrap::kOctahedralSphere}) {
    const TextureImage image = with_levels(random_image(19, 8, 4), wrap);
    for (const ImageFilter filter : {ImageFilter::kTrilinear, ImageFilter::kEwa})
      for (const float a : wild)
        for (const float b : wild)
          for (const float c : wild) {
            const Spectrum v = image.lookup({{-1e9f, 7.3f}, {a, -b}, {c, a}, filter, wrap, 1024});
            for (int lane = 0; lane < 4; ++lane) {
              EXPECT_GE(v[lane], -0.2f) << a << ' ' << b << ' ' << c;
              EXPECT_LE(v[lane], 1.2f);
            }
          }
  }
}

}  // namespace
}  // namespace etd
