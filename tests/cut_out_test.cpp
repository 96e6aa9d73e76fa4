// What surfaces show without what is behind everything: the layer foreground, and pictures with alpha.
#include "io/cut_out.h"

#include <gtest/gtest.h>

#include "cli_fixture.h"
#include "io/image.h"
#include "render/output.h"
#include "render_helper.h"
#include "spectrum/srgb.h"

namespace etd {
namespace {

// A diffuse sphere, a mirror and a lamp in front of a sky.
constexpr const char* kThings = R"(
Film "rgb" "integer xresolution" 32 "integer yresolution" 24
LookAt 0 0 -4  0 0 0  0 1 0
Camera "perspective" "float fov" 60
WorldBegin
LightSource "infinite" "rgb L" [ 0.5 0.25 1 ]
Material "diffuse" "rgb reflectance" [ 0.5 0.6 0.7 ]
Shape "sphere"
AttributeBegin
  Translate -2 0 0
  Material "conductor" "float roughness" 0
  Shape "sphere" "float radius" 0.8
AttributeEnd
Translate 2 0 0
AreaLightSource "diffuse" "rgb L" [ 3 2 1 ]
Shape "sphere" "float radius" 0.7
)";

LayeredImage render_layers(const std::string& filter, bool alpha) {
  RenderOverrides overrides;
  overrides.spp = 16;
  overrides.alpha = alpha;
  return render_image(filter + kThings, ".", overrides);
}

constexpr float kSky[] = {0.5f, 0.25f, 1.0f};

// Over what was behind it, what was cut out makes the picture again, also with filters that have negative weights.
TEST(CutOut, OverItsBackgroundItIsThePicture) {
  for (const char* filter : {"PixelFilter \"box\"", "PixelFilter \"gaussian\"", "PixelFilter \"mitchell\""}) {
    const LayeredImage image = render_layers(filter, true);
    const std::vector<float> alpha = image.plane("foreground.A");
    ASSERT_EQ(alpha.size(), 32u * 24u);
    size_t edges = 0;
    for (const float a : alpha) edges += a > 0.05f && a < 0.95f;
    EXPECT_GT(edges, 40u);
    // What is missing is the sky, times the weights of the samples that met it: 1 - alpha where all weights are 1.
    const std::vector<float> red = image.plane("R"), front_red = image.plane("foreground.R");
    for (int c = 0; c < 3; ++c) {
      const std::string name = std::string(1, "RGB"[c]);
      const std::vector<float> picture = image.plane(name), front = image.plane("foreground." + name);
      for (size_t i = 0; i < picture.size(); ++i) {
        const float behind = has(filter, "box") ? 1 - alpha[i] : (red[i] - front_red[i]) / kSky[0];
        EXPECT_NEAR(front[i] + behind * kSky[c], picture[i], 1e-5f) << filter << ' ' << i;
        if (alpha[i] == 0 || alpha[i] == 1) {
          EXPECT_EQ(front[i], alpha[i] * picture[i]) << filter << ' ' << i;
        }
      }
    }
  }
}

TEST(CutOut, MirrorsAndLampsAreThere) {
  const LayeredImage image = render_layers("PixelFilter \"box\"", true);
  const size_t row = 12 * 32;
  for (const size_t x : {4u, 16u, 27u}) EXPECT_EQ(image.plane("foreground.A")[row + x], 1.0f) << x;
  EXPECT_EQ(image.plane("coverage.A")[row + 4], 0.0f);     // a mirror has no first vertex that is not one
  EXPECT_GT(image.plane("foreground.R")[row + 27], 3.0f);  // that of the lamp, and what it reflects
  EXPECT_GT(image.plane("foreground.B")[row + 4], 0.4f);
  EXPECT_EQ(render_layers("", false).find("foreground.A"), -1);
}

TEST(CutOut, PngHoldsColoursThatAreNotMultiplied) {
  const TempFolder folder;
  const LayeredImage image = render_layers("", true);
  const auto path = folder.path() / "a.png";
  ASSERT_EQ(write_output(path, image, 0.5, true), "");
  CutOut cut = cut_out(image);
  EXPECT_EQ(cut.note + cut.error, "");
  divide_by_alpha(cut);
  const ImageResult read = read_image(path, {ImageEncoding{ImageEncoding::Kind::kLinear, 1}, ""});
  ASSERT_TRUE(read.image) << read.error;
  ASSERT_EQ(read.image->channels(), 4);
  const float scale = std::exp2(0.5f);
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 32; ++x) {
      const auto i = static_cast<size_t>(32 * y + x);
      for (int c = 0; c < 3; ++c)
        ASSERT_EQ(read.image->texel(x, y, c) * 255, linear_to_srgb8(cut.rgb[3 * i + static_cast<size_t>(c)] * scale))
            << x << ' ' << y << ' ' << c;
      ASSERT_NEAR(read.image->texel(x, y, 3), cut.alpha[i], 0.51 / 255) << x << ' ' << y;
    }
}

LayeredImage one_row(std::vector<std::string> channels, std::vector<float> pixels) {
  LayeredImage image;
  image.width = image.full_width = static_cast<int>(pixels.size() / channels.size());
  image.height = image.full_height = 1;
  image.channels = std::move(channels);
  image.pixels = std::move(pixels);
  return image;
}

TEST(CutOut, OtherFilesHaveAlphaInTheirOwnWay) {
  const CutOut premultiplied = cut_out(one_row({"A", "R", "G", "B"}, {0.5f, 0.2f, 0.3f, 0.4f}));
  EXPECT_EQ(premultiplied.alpha, std::vector<float>{0.5f});
  EXPECT_EQ(premultiplied.rgb, (std::vector<float>{0.2f, 0.3f, 0.4f}));
  EXPECT_EQ(premultiplied.note, "");
  const std::vector<std::string> layers = {"R", "G", "B", "emission.R", "emission.G", "emission.B", "coverage.A"};
  // Background alone, half covered, covered by something that shines.
  const CutOut guessed =
      cut_out(one_row(layers, {1, 2, 3, 1, 2, 3, 0, 0.75f, 1, 2, 0.5f, 1, 1.5f, 0.5f, 4, 4, 4, 3, 3, 3, 1}));
  EXPECT_EQ(guessed.rgb, (std::vector<float>{0, 0, 0, 0.25f, 0, 0.5f, 4, 4, 4}));
  EXPECT_NE(guessed.note, "");
  // Where nothing is behind, the edge of a lamp is all its own.
  const CutOut lamp = cut_out(one_row(layers, {0, 0, 0, 0, 0, 0, 0, 2, 2, 2, 2, 2, 2, 0.5f}));
  EXPECT_EQ(lamp.rgb, (std::vector<float>{0, 0, 0, 2, 2, 2}));
  EXPECT_NE(cut_out(one_row({"R", "G", "B"}, {1, 1, 1})).error, "");
  CutOut odd{{1, 1, 1, 1, 1, 1, 1.1f, 1.1f, 1.1f}, {0, -0.1f, 1.1f}, {}, {}};
  divide_by_alpha(odd);
  EXPECT_EQ(odd.rgb, (std::vector<float>{0, 0, 0, 0, 0, 0, 1, 1, 1}));
}

class CliAlpha : public Cli {};

TEST_F(CliAlpha, RenderAndTonemapWriteTheSamePng) {
  folder_.write("s.pbrt", kScene);
  const Finished done = run("render s.pbrt --quiet -o a.png -o a.exr --alpha");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const Finished again = run("tonemap a.exr b.png --alpha");
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(again.err, "");
  const ImageResult a = read_image(folder_.path() / "a.png"), b = read_image(folder_.path() / "b.png");
  ASSERT_TRUE(a.image && b.image);
  ASSERT_EQ(a.image->channels(), 4);
  ASSERT_EQ(b.image->channels(), 4);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 24; ++x) ASSERT_EQ(a.image->rgba(x, y), b.image->rgba(x, y)) << x << ' ' << y;
  EXPECT_EQ(a.image->texel(0, 0, 3), 0.0f);
  EXPECT_EQ(a.image->texel(12, 8, 3), 1.0f);
  // A render that did not keep it: coverage is enough here.
  ASSERT_EQ(run("render s.pbrt --quiet -o plain.exr").exit_code, 0);
  const Finished guessed = run("tonemap plain.exr c.png --alpha");
  ASSERT_EQ(guessed.exit_code, 0) << guessed.err;
  EXPECT_TRUE(has(guessed.err, "note: plain.exr: it was rendered without --alpha")) << guessed.err;
  const ImageResult c = read_image(folder_.path() / "c.png");
  ASSERT_TRUE(c.image);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 24; ++x)
      for (int i = 0; i < 4; ++i) ASSERT_NEAR(a.image->texel(x, y, i), c.image->texel(x, y, i), 0.01f) << x << ' ' << y;
}

TEST_F(CliAlpha, FormatsWithoutAlphaAreErrors) {
  folder_.write("s.pbrt", kScene);
  for (const char* name : {"a.jpg", "a.jpeg", "a.hdr", "a.pfm"}) {
    const Finished refused = run(std::string("render s.pbrt --alpha -o b.png -o ") + name);
    EXPECT_EQ(refused.exit_code, 2) << name;
    EXPECT_TRUE(has(refused.err, std::string("cannot write ") + name + " with --alpha: .")) << refused.err;
    EXPECT_TRUE(has(refused.err, "files have no alpha; .png has it")) << refused.err;
  }
  EXPECT_EQ(folder_.entries(), 1);
  ASSERT_EQ(run("render s.pbrt --quiet --alpha -o a.exr").exit_code, 0);
  EXPECT_EQ(run("tonemap a.exr a.jpg --alpha").exit_code, 2);
  EXPECT_EQ(run("tonemap a.exr a.png --alpha --layer direct").exit_code, 2);
  ASSERT_EQ(run("tonemap a.exr plain.png").exit_code, 0);
  const Finished none = run("tonemap plain.png b.png --alpha");
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_TRUE(has(none.err, "plain.png: it has no alpha")) << none.err;
  EXPECT_EQ(folder_.entries(), 3);
}

}  // namespace
}  // namespace etd
