// What a film makes of radiance: exposure, white balance, clamping, 16-bit floats, and the layers of a gbuffer.
#include "film/sensor.h"

#include <gtest/gtest.h>

#include "film/rgb.h"
#include "formats/pbrt/reader.h"
#include "io/image_write.h"
#include "model_uses.h"
#include "render/session.h"
#include "render_helper.h"
#include "spectrum/color_space.h"
#include "spectrum/white_balance.h"
#include "temp_folder.h"

namespace etd {
namespace {

Sensor sensor(std::vector<Param> params, std::string* problems = nullptr, double shutter = 1) {
  Diagnostics diagnostics;
  const ModelUse use = use_of("rgb", std::move(params));
  check_params(RgbFilm::decl(), use, diagnostics);
  const Sensor s = Sensor::create(ParamReader(RgbFilm::decl(), use, diagnostics), shutter);
  if (problems)
    *problems = diagnostics.format_all();
  else
    EXPECT_EQ(diagnostics.format_all(), "");
  return s;
}

PixelSample sample_of(Vec3 emission, Vec3 direct, Vec3 indirect) {
  const auto spectrum = [](Vec3 v) { return Spectrum::rgb(v.x, v.y, v.z); };
  PixelSample s;
  s.emission = spectrum(emission), s.direct = spectrum(direct), s.indirect = spectrum(indirect);
  s.albedo = Spectrum(0.25f);
  return s;
}

TEST(Sensor, ImagingRatioIsExposureTimesSensitivity) {
  EXPECT_EQ(sensor({}).imaging_ratio, 1.0);
  EXPECT_EQ(sensor({number("iso", 400)}).imaging_ratio, 4.0);
  EXPECT_EQ(sensor({number("iso", 400)}, nullptr, 0.125).imaging_ratio, 0.5);
  EXPECT_EQ(sensor({number("iso", 400), number("exposuretime", 0.5)}, nullptr, 0.125).imaging_ratio, 2.0);
  PixelSample s = sample_of({1, 2, 3}, {4, 5, 6}, {7, 8, 9});
  EXPECT_EQ(sensor({number("imagingratio", 3)}, nullptr, 0.125).imaging_ratio, 3.0);
  sensor({number("iso", 50)}).expose(s);
  EXPECT_EQ(s.emission[2], 1.5f);
  EXPECT_EQ(s.direct[0], 2.0f);
  EXPECT_EQ(s.indirect[1], 4.0f);
  EXPECT_EQ(s.albedo[0], 0.25f);  // no light
}

TEST(Sensor, WhiteBalanceMakesItsLightWhite) {
  for (const double kelvin : {2000.0, 4500.0, 6504.0, 12000.0}) {
    const Vec3d light = xyz_to_rec709(white_of_temperature(kelvin));
    PixelSample s = sample_of(to_float(light), {}, {});
    sensor({number("whitebalance", kelvin), number("iso", 200)}).expose(s);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(s.emission[c], 2.0f, 1e-3f) << kelvin;
  }
}

TEST(Sensor, ClampScalesTheWholeSample) {
  const Sensor limited = sensor({number("maxcomponentvalue", 4), number("iso", 200)});
  PixelSample bright = sample_of({1, 0, 0}, {2, 1, 0}, {1, 0, 2});  // 4 1 2, exposed 8 2 4
  limited.expose(bright);
  EXPECT_EQ(bright.emission[0] + bright.direct[0] + bright.indirect[0], 4.0f);
  EXPECT_EQ(bright.direct[1], 1.0f);
  EXPECT_EQ(bright.indirect[2], 2.0f);
  PixelSample dark = sample_of({1, 0, 0}, {0, 2, 0}, {});
  limited.expose(dark);
  EXPECT_EQ(dark.direct[1], 4.0f);
  EXPECT_NE(limited.bias(), "");
  EXPECT_EQ(sensor({}).bias(), "");
}

TEST(Sensor, WhatCannotBeExposed) {
  std::string problems;
  sensor({text("sensor", "canon_eos_5d")}, &problems);
  EXPECT_NE(problems.find("sensor \"canon_eos_5d\" is not supported yet"), std::string::npos) << problems;
  sensor({number("whitebalance", 900)}, &problems);
  EXPECT_NE(problems.find("valid: 0, or 1500 to 25000"), std::string::npos) << problems;
  sensor({number("imagingratio", 2), number("iso", 200)}, &problems);
  EXPECT_NE(problems.find("beside what it stands for"), std::string::npos) << problems;
  sensor({number("iso", -1)}, &problems);
  EXPECT_NE(problems.find("out of range"), std::string::npos) << problems;
}

// Filter weights apply to everything, after the sensor.
TEST(PixelSums, WeightsMayBeNegative) {
  PixelSample s = sample_of({1, 0, 0}, {2, 1, 0}, {1, 0, 2});
  s.weight = -0.5f;
  s.normal = {0, 0, 1}, s.depth = 3, s.coverage = 1;
  PixelSums sums;
  sums.add(s);
  EXPECT_EQ(sums.direct[0], -1.0);
  EXPECT_EQ(sums.mean_radiance()[0], -2.0);
  EXPECT_EQ(sums.squares[0], 4.0);
  EXPECT_EQ(sums.albedo[1], -0.125);
  EXPECT_EQ(sums.normal[2], -0.5);
  EXPECT_EQ(sums.depth, -1.5);
  EXPECT_EQ(sums.coverage, -0.5);
  EXPECT_EQ(sums.count, 1.0);
}

struct Rendered {
  LayeredImage image;
  Film film;
};

Rendered render(const std::string& film, const std::string& options = "") {
  const std::string text = "Film " + film +
                           " \"integer xresolution\" 12 \"integer yresolution\" 8\n"
                           "PixelFilter \"box\"\n" +
                           options +
                           "WorldBegin\nLightSource \"infinite\" \"rgb L\" [ 1 0.8 0.5 ]\n"
                           "Material \"diffuse\" \"rgb reflectance\" [ 0.5 0.25 0.75 ]\n"
                           "Shape \"sphere\"\nTranslate 0 -2 0\nShape \"sphere\" \"float radius\" 1.2\n";
  Diagnostics diagnostics;
  RenderOverrides o;
  o.spp = 32;
  o.replicates = 4;
  auto prepared = prepare_render(read_pbrt_text(text, "test", ".", diagnostics), o, diagnostics);
  if (!prepared) throw std::runtime_error(diagnostics.format_all());
  RenderObserver nobody;
  FinishedRender finished = run_render(*prepared, nobody);
  LayeredImage image = finished_image(*prepared, finished);
  return {std::move(image), std::move(finished.film)};
}

const char* const kView = "LookAt 1 2 -5  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" 50\n";

// Powers of two are exact: radiance and its errors are all multiplied, everything else stays, bit for bit.
TEST(Film, ExposureMultipliesEveryLayerOfLight) {
  const LayeredImage plain = render("\"rgb\"", kView).image;
  const LayeredImage exposed = render("\"rgb\" \"float iso\" 50 \"float exposuretime\" 4", kView).image;
  ASSERT_EQ(plain.channels, exposed.channels);
  for (const std::string& channel : plain.channels) {
    const std::string layer = channel.substr(0, channel.find('.'));
    const bool is_light = layer != "albedo" && layer != "normal" && layer != "depth" && layer != "coverage";
    const std::vector<float> a = plain.plane(channel), b = exposed.plane(channel);
    for (size_t i = 0; i < a.size(); ++i) EXPECT_EQ(b[i], is_light ? 2 * a[i] : a[i]) << channel;
  }
}

TEST(Film, WhiteBalanceIsOneMatrixForAllLayers) {
  const LayeredImage plain = render("\"rgb\"", kView).image;
  const LayeredImage balanced = render("\"rgb\" \"float whitebalance\" 3200", kView).image;
  const std::array<Vec3d, 3> rows = adapt_rec709(white_of_temperature(3200));
  for (const std::string layer : {"", "emission.", "direct.", "indirect."}) {
    const std::vector<float> r = plain.plane(layer + "R"), g = plain.plane(layer + "G"), b = plain.plane(layer + "B");
    for (int c = 0; c < 3; ++c) {
      const std::vector<float> ours = balanced.plane(layer + std::string(1, "RGB"[c]));
      for (size_t i = 0; i < r.size(); ++i)
        EXPECT_NEAR(ours[i], dot(rows[static_cast<size_t>(c)], Vec3d{r[i], g[i], b[i]}), 2e-6);
    }
  }
  EXPECT_NE(plain.plane("stderr.R"), balanced.plane("stderr.R"));
}

TEST(Film, ClampIsLabelledBiased) {
  const LayeredImage clamped = render("\"rgb\" \"float maxcomponentvalue\" 0.4", kView).image;
  const MetadataValue* biased = clamped.find_metadata("etendue:biased");
  ASSERT_TRUE(biased);
  EXPECT_NE(std::get<std::string>(*biased).find("samples brighter than 0.4 are scaled down"), std::string::npos);
  for (const float v : clamped.plane("R")) EXPECT_LE(v, 0.4f * (1 + 1e-6f));
}

TEST(Film, HalfFloatsAreRoundedAndStayFinite) {
  LayeredImage image = render("\"rgb\" \"bool savefp16\" true", kView).image;
  EXPECT_TRUE(image.half);
  image.pixels[0] = 1e6f;
  image.pixels[1] = -1e6f;
  image.pixels[2] = HUGE_VALF;
  const TempFolder folder;
  ASSERT_EQ(write_layers(folder.path() / "half.exr", image), "");
  const LayersResult read = read_layers(folder.path() / "half.exr");
  ASSERT_TRUE(read.image) << read.error;
  const std::vector<float> ours = image.plane("B"), theirs = read.image->plane("B");
  EXPECT_EQ(read.image->plane(image.channels[0])[0], 65504.0f);
  EXPECT_EQ(read.image->plane(image.channels[1])[0], -65504.0f);
  EXPECT_EQ(read.image->plane(image.channels[2])[0], HUGE_VALF);
  for (size_t i = 1; i < ours.size(); ++i) EXPECT_NEAR(theirs[i], ours[i], std::abs(ours[i]) * 0x1p-11f);
  LayeredImage full = image;
  full.half = false;
  ASSERT_EQ(write_layers(folder.path() / "full.exr", full), "");
  EXPECT_LT(std::filesystem::file_size(folder.path() / "half.exr"),
            std::filesystem::file_size(folder.path() / "full.exr"));
}

// A camera that looks along world -x at the plane x = -3 (distance 5 from x = 2), half of whose picture misses it:
// means over samples where misses count 0, so positions divided by coverage lie on the plane.
TEST(Film, GBufferHasPositionsInItsSpace) {
  for (const bool world : {false, true}) {
    const std::string text = std::string("Film \"gbuffer\" \"integer xresolution\" 16 \"integer yresolution\" 16") +
                             (world ? " \"string coordinatesystem\" \"world\"" : "") +
                             "\nPixelFilter \"box\"\nIntegrator \"path\" \"integer maxdepth\" 0\n"
                             "Scale 0.5 0.5 0.5\nLookAt 2 0 0  -3 0 0  0 1 0\nCamera \"orthographic\"\nWorldBegin\n"
                             "Shape \"trianglemesh\" \"point3 P\" [ -3 0 -9  -3 0 9  -3 9 9  -3 9 -9 ]\n"
                             "\"integer indices\" [ 0 1 2  0 2 3 ]\n";
    RenderOverrides o;
    o.spp = 16;
    const LayeredImage image = render_image(text, ".", o);
    const auto at = [&](const char* channel, size_t pixel) { return image.plane(channel)[pixel]; };
    for (const size_t pixel : {size_t{3 * 16 + 2}, size_t{6 * 16 + 13}}) {
      const float x = 2 * (static_cast<float>(pixel % 16) + 0.5f) / 16 - 1;  // on the film
      const float y = 1 - 2 * (static_cast<float>(pixel / 16) + 0.5f) / 16;
      ASSERT_EQ(at("coverage.A", pixel), 1.0f);
      // The scene's unit is half of the camera's. Camera space is left-handed: looking along -x with y up, z is left.
      EXPECT_NEAR(at("position.X", pixel), world ? -3.0f : x, 0.01f);
      EXPECT_NEAR(at("position.Y", pixel), world ? 2 * y : y, 0.02f);
      EXPECT_NEAR(std::abs(at("position.Z", pixel)), world ? std::abs(2 * x) : 2.5f, 0.02f);
      EXPECT_NEAR(at("normal.X", pixel), world ? 1.0f : 0.0f, 1e-5f);
      EXPECT_NEAR(at("normal.Y", pixel), 0.0f, 1e-5f);
      EXPECT_NEAR(at("normal.Z", pixel), world ? 0.0f : -1.0f, 1e-5f);
    }
    EXPECT_EQ(at("coverage.A", 15 * 16), 0.0f);
    for (const char* channel : {"position.X", "position.Y", "position.Z"}) EXPECT_EQ(at(channel, 15 * 16), 0.0f);
  }
}

}  // namespace
}  // namespace etd
