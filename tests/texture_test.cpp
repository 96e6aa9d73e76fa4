// The textures: what lies where in uv, wrapping, encodings, composition, and coordinates that are no sensible numbers.
#include "textures/texture.h"

#include <gtest/gtest.h>

#include "spectrum/srgb.h"
#include "texture_table.h"

namespace etd {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// 3 x 2 texels of 8 bits; the file's rows go from the top down.
//   10 20 30
//   40 50 60
std::string grey_image() { return std::string("P5 3 2 255\n") + "\x0a\x14\x1e\x28\x32\x3c"; }

ModelUse image_use(const std::string& file, std::vector<Param> more = {}) {
  ModelUse use = use_of("imagemap", {text("filename", file), text("encoding", "linear")});
  use.params.insert(use.params.end(), more.begin(), more.end());
  return use;
}

// The value in bytes of the grey image under a uv.
float byte_at(const Textures& t, const SpectrumSource& s, float u, float v) { return t.at(s, u, v)[0] * 255; }

TEST(Checkerboard, ParityOnBothSidesOfZero) {
  Textures t;
  const SpectrumSource board = t.add("board", use_of("checkerboard"));
  EXPECT_EQ(t.at(board, 0.5f, 0.5f)[0], 1.0f);
  EXPECT_EQ(t.at(board, 1.5f, 0.5f)[0], 0.0f);
  EXPECT_EQ(t.at(board, -0.5f, 0.5f)[0], 0.0f);
  EXPECT_EQ(t.at(board, -0.5f, -0.5f)[0], 1.0f);
  EXPECT_EQ(t.at(board, -1.5f, -0.5f)[0], 0.0f);
  EXPECT_EQ(t.at(board, 1, 0)[0], 0.0f);
  EXPECT_EQ(t.at(board, 1, 1)[0], 1.0f);
  for (int i = -40; i < 40; ++i)
    for (int j = -40; j < 40; ++j)
      EXPECT_EQ(t.at(board, static_cast<float>(i) + 0.25f, static_cast<float>(j) + 0.75f)[0],
                ((i + j) % 2 + 2) % 2 == 0 ? 1.0f : 0.0f);
  EXPECT_EQ(t.at(board, 16777215.0f, 0)[0], 0.0f);  // the last odd float
  EXPECT_EQ(t.at(board, 16777216.0f, 0)[0], 1.0f);
}

TEST(Checkerboard, MappingAndChildren) {
  Textures t;
  t.add("red", use_of("constant", {rgb("value", 1, 0, 0)}));
  const SpectrumSource board =
      t.add("board", use_of("checkerboard", {texture("tex1", "red"), rgb("tex2", 0, 0.5, 0), number("uscale", 10),
                                             number("vscale", 2), number("udelta", 1), number("vdelta", -3)}));
  ASSERT_FALSE(t.diagnostics.has_errors());
  // (0.05, 0.2) -> (1.5, -2.6): cells 1 and -3, an even sum.
  EXPECT_EQ(t.at(board, 0.05f, 0.2f)[0], 1.0f);
  EXPECT_EQ(t.at(board, 0.15f, 0.2f)[1], 0.5f);
}

TEST(Textures, NestedScalesAndFloatTextures) {
  Textures t;
  t.add("half", use_of("constant", {number("value", 0.5)}), true);
  t.add("quarter", use_of("scale", {texture("tex", "half"), texture("scale", "half")}), true);
  const SpectrumSource s = t.add("s", use_of("scale", {rgb("tex", 1, 2, 4), texture("scale", "quarter")}));
  t.add("s2", use_of("scale", {texture("tex", "s"), number("scale", 2)}));
  const SpectrumSource board = t.add("board", use_of("checkerboard", {texture("tex1", "s2"), texture("tex2", "s")}));
  ASSERT_FALSE(t.diagnostics.has_errors()) << t.diagnostics.format_all();
  EXPECT_EQ(t.at(s, 0, 0)[2], 1.0f);
  EXPECT_EQ(t.at(board, 0.5f, 0.5f)[2], 2.0f);
  EXPECT_EQ(t.at(board, 1.5f, 0.5f)[1], 0.5f);
  EXPECT_EQ(t.table.eval(FloatSource{0, 1}, {}, {}), 0.25f);
}

TEST(ImageMap, LowerLeftCornerIsTheOrigin) {
  Textures t;
  t.folder.write("a.pgm", grey_image());
  for (const char* filter : {"point", "bilinear"}) {
    const SpectrumSource s = t.add(filter, image_use("a.pgm", {text("filter", filter)}));
    ASSERT_FALSE(t.diagnostics.has_errors()) << t.diagnostics.format_all();
    // At the centres of texels both filters give the texel.
    EXPECT_NEAR(byte_at(t, s, 1 / 6.0f, 0.25f), 40, 1e-3f);
    EXPECT_NEAR(byte_at(t, s, 5 / 6.0f, 0.25f), 60, 1e-3f);
    EXPECT_NEAR(byte_at(t, s, 1 / 6.0f, 0.75f), 10, 1e-3f);
    EXPECT_NEAR(byte_at(t, s, 0.5f, 0.75f), 20, 1e-3f);
  }
  EXPECT_EQ(t.table.images.size(), 1u);  // one file, one image
}

TEST(ImageMap, BilinearBetweenCentres) {
  Textures t;
  t.folder.write("a.pgm", grey_image());
  const SpectrumSource s = t.add("s", image_use("a.pgm"));
  EXPECT_NEAR(byte_at(t, s, 1 / 3.0f, 0.25f), 45, 1e-3f);
  EXPECT_NEAR(byte_at(t, s, 1 / 3.0f, 0.5f), 30, 1e-3f);
  EXPECT_NEAR(byte_at(t, s, 0.25f + 1 / 6.0f, 0.375f), 47.5f - 7.5f, 1e-3f);
  const SpectrumSource moved = t.add("m", image_use("a.pgm", {number("uscale", 0.5), number("vdelta", 0.25)}));
  EXPECT_NEAR(byte_at(t, moved, 2 / 3.0f, 0), 45, 1e-3f);
}

TEST(ImageMap, Wraps) {
  Textures t;
  t.folder.write("a.pgm", grey_image());
  const auto with = [&](const char* wrap) {
    return t.add(wrap, image_use("a.pgm", {text("wrap", wrap), text("filter", "point")}));
  };
  const SpectrumSource repeat = with("repeat"), black = with("black"), clamped = with("clamp"),
                       octahedral = with("octahedralsphere");
  ASSERT_FALSE(t.diagnostics.has_errors()) << t.diagnostics.format_all();
  const float left = -0.1f, right = 1.1f, low = 0.25f, high = 0.75f;
  EXPECT_NEAR(byte_at(t, repeat, left, low), 60, 1e-3f);
  EXPECT_NEAR(byte_at(t, repeat, right, high), 10, 1e-3f);
  EXPECT_NEAR(byte_at(t, repeat, 0.5f, 1.25f), 50, 1e-3f);
  EXPECT_NEAR(byte_at(t, repeat, -99.5f, -7.25f), 20, 1e-3f);
  EXPECT_EQ(byte_at(t, black, left, low), 0);
  EXPECT_EQ(byte_at(t, black, 0.5f, 1.01f), 0);
  EXPECT_NEAR(byte_at(t, black, 0.5f, low), 50, 1e-3f);
  EXPECT_NEAR(byte_at(t, clamped, -50, low), 40, 1e-3f);
  EXPECT_NEAR(byte_at(t, clamped, right, 1e9f), 30, 1e-3f);
  // Past an edge lies the same edge, mirrored about its middle: the rows of the sides change places.
  EXPECT_NEAR(byte_at(t, octahedral, left, low), 10, 1e-3f);
  EXPECT_NEAR(byte_at(t, octahedral, right, low), 30, 1e-3f);
  EXPECT_NEAR(byte_at(t, octahedral, 1 / 6.0f, 1.1f), 30, 1e-3f);
  EXPECT_NEAR(byte_at(t, octahedral, 5 / 6.0f, -0.1f), 40, 1e-3f);
}

// Across any edge of an octahedral map, the bilinear value is continuous with that of the point it stands for.
TEST(ImageMap, OctahedralWrapIsContinuous) {
  Textures t;
  t.folder.write("b.pgm", std::string("P5 4 4 255\n") + "abcdefghijklmnop");
  const SpectrumSource s = t.add("s", image_use("b.pgm", {text("wrap", "octahedralsphere")}));
  for (int i = 0; i <= 20; ++i) {
    const float x = static_cast<float>(i) / 20;
    EXPECT_NEAR(byte_at(t, s, x, 0), byte_at(t, s, 1 - x, 0), 1e-3f);
    EXPECT_NEAR(byte_at(t, s, x, 1), byte_at(t, s, 1 - x, 1), 1e-3f);
    EXPECT_NEAR(byte_at(t, s, 0, x), byte_at(t, s, 0, 1 - x), 1e-3f);
    EXPECT_NEAR(byte_at(t, s, 1, x), byte_at(t, s, 1, 1 - x), 1e-3f);
    EXPECT_NEAR(byte_at(t, s, x, 1.02f), byte_at(t, s, 1 - x, 0.98f), 1e-2f);
    EXPECT_NEAR(byte_at(t, s, -0.02f, x), byte_at(t, s, 0.02f, 1 - x), 1e-2f);
  }
}

TEST(ImageMap, ScaleComesBeforeInvert) {
  Textures t;
  t.folder.write("a.pgm", grey_image());
  const SpectrumSource scaled = t.add("s", image_use("a.pgm", {number("scale", 3)}));
  EXPECT_NEAR(byte_at(t, scaled, 0.5f, 0.25f), 150, 1e-3f);
  const SpectrumSource inverted = t.add("i", image_use("a.pgm", {number("scale", 3), boolean("invert", true)}));
  EXPECT_NEAR(byte_at(t, inverted, 0.5f, 0.25f), 255 - 150, 1e-3f);
  const SpectrumSource negative = t.add("n", image_use("a.pgm", {number("scale", 10), boolean("invert", true)}));
  EXPECT_EQ(byte_at(t, negative, 0.5f, 0.25f), 0);
}

TEST(ImageMap, EncodingsOfIntegers) {
  Textures t;
  t.folder.write("a.pgm", grey_image());
  const auto with = [&](const char* encoding) {
    return use_of("imagemap", {text("filename", "a.pgm"), text("encoding", encoding)});
  };
  const SpectrumSource plain = t.add("d", use_of("imagemap", {text("filename", "a.pgm")})),
                       srgb = t.add("s", with("sRGB")), gamma = t.add("g", with("gamma 3")),
                       linear = t.add("l", with("linear"));
  EXPECT_NEAR(t.at(plain, 0.5f, 0.25f)[0], srgb_to_linear(50 / 255.0f), 1e-6f);
  EXPECT_NEAR(t.at(srgb, 0.5f, 0.25f)[0], srgb_to_linear(50 / 255.0f), 1e-6f);
  EXPECT_NEAR(t.at(gamma, 0.5f, 0.25f)[0], std::pow(50 / 255.0f, 3.0f), 1e-6f);
  EXPECT_NEAR(t.at(linear, 0.5f, 0.25f)[0], 50 / 255.0f, 1e-6f);
  EXPECT_FALSE(t.diagnostics.has_errors());
  EXPECT_EQ(t.table.images.size(), 4u);  // without an encoding, only the file can tell that it is sRGB
  t.add("x", with("Adobe"));
  t.add("y", use_of("imagemap", {text("filename", "missing.png")}));
  EXPECT_EQ(t.diagnostics.error_count(), 2);
}

TEST(ImageMap, FloatTexturesOfColours) {
  Textures t;
  t.folder.write("c.ppm", std::string("P6 1 1 255\n") + "\x1e\x3c\x5a");  // 30 60 90
  const SpectrumSource color = t.add("c", image_use("c.ppm"));
  EXPECT_NEAR(t.at(color, 0.5f, 0.5f)[2] * 255, 90, 1e-3f);
  const SpectrumSource mean = t.add("m", image_use("c.ppm"), true);
  EXPECT_NEAR(byte_at(t, mean, 0.5f, 0.5f), 60, 1e-3f);
  // An uncompressed TGA with 8 bits of alpha, stored from the top: blue, green, red, alpha.
  const char header[18] = {0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 1, 0, 32, 0x28};
  t.folder.write("solid.tga", std::string(header, 18) + "\x5a\x3c\x1e\xff");
  t.folder.write("alpha.tga", std::string(header, 18) + "\x5a\x3c\x1e\x80");
  EXPECT_NEAR(byte_at(t, t.add("s", image_use("solid.tga"), true), 0.5f, 0.5f), 60, 1e-3f);
  EXPECT_NEAR(byte_at(t, t.add("a", image_use("alpha.tga"), true), 0.5f, 0.5f), 128, 1e-3f);
  ASSERT_FALSE(t.diagnostics.has_errors()) << t.diagnostics.format_all();
}

// Coordinates that are huge or no numbers give some value of the image; those of a diverging image give none below 0.
TEST(ImageMap, WildCoordinatesAndValues) {
  Textures t;
  t.folder.write("a.pgm", grey_image());
  const float values[6] = {kNan, kInfinity, -kInfinity, 1e30f, -2, 0.5f};  // rows from the bottom, as PFM has them
  std::string pfm = "Pf\n3 2\n-1.0\n";
  pfm.append(reinterpret_cast<const char*>(values), sizeof values);
  t.folder.write("wild.pfm", pfm);
  const float coordinates[] = {0, 1, -1, 0.999999f, 1e9f, -1e9f, 3e38f, -3e38f, kInfinity, -kInfinity, kNan, 1e-40f};
  std::vector<SpectrumSource> sources{t.add("board", use_of("checkerboard", {number("uscale", 1e30)}))};
  for (const char* wrap : {"repeat", "black", "clamp", "octahedralsphere"})
    for (const char* filter : {"point", "bilinear"})
      for (const char* file : {"a.pgm", "wild.pfm"})
        sources.push_back(t.add(std::string(wrap) + filter + file,
                                image_use(file, {text("wrap", wrap), text("filter", filter), number("vscale", -2)})));
  ASSERT_FALSE(t.diagnostics.has_errors()) << t.diagnostics.format_all();
  for (const SpectrumSource& s : sources)
    for (const float u : coordinates)
      for (const float v : coordinates) {
        const Spectrum value = t.at(s, u, v);
        for (int lane = 0; lane < 3; ++lane) EXPECT_GE(value[lane], 0.0f) << s.texture << ' ' << u << ' ' << v;
      }
}

TEST(SpectrumValue, ClampsWhereDeclaredAndDropsNaN) {
  EXPECT_EQ(clamp(Spectrum(kNan), 0, 1)[0], 0.0f);
  EXPECT_EQ(clamp(Spectrum(kInfinity), 0, 1)[1], 1.0f);
  EXPECT_EQ(max(Spectrum(kNan), 0)[2], 0.0f);
}

}  // namespace
}  // namespace etd
