// A small scene from text to film: what the whole chain promises.
#include "render/session.h"

#include <gtest/gtest.h>

#include "formats/pbrt/reader.h"
#include "render_helper.h"
#include "scene/scene.h"

namespace etd {
namespace {

constexpr const char* kScene = R"(
Film "rgb" "integer xresolution" 30 "integer yresolution" 20
LookAt 0 0 -3  0 0 0  0 1 0
Camera "perspective" "float fov" 60
WorldBegin
LightSource "infinite" "rgb L" [ 0.2 0.2 0.3 ]
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 5 4 3 ]
  Translate 1 1.5 0
  Shape "sphere" "float radius" 0.3
AttributeEnd
Material "diffuse" "rgb reflectance" [ 0.5 0.6 0.7 ]
Shape "sphere"
Material "conductor" "float roughness" 0.2
Translate -1.2 0 0
Shape "sphere" "float radius" 0.6
)";

void expect_same_bits(const Film& a, const Film& b, const PixelBounds& where) {
  for (int y = where.y0; y < where.y1; ++y)
    for (int x = where.x0; x < where.x1; ++x)
      for (uint32_t r = 0; r < a.settings().replicates; ++r) {
        const PixelSums p = a.sums(x, y, r), q = b.sums(x, y, r);
        ASSERT_EQ(p.emission, q.emission) << x << ' ' << y;
        ASSERT_EQ(p.direct, q.direct) << x << ' ' << y;
        ASSERT_EQ(p.indirect, q.indirect) << x << ' ' << y;
        ASSERT_EQ(p.squares, q.squares) << x << ' ' << y;
        ASSERT_EQ(p.normal, q.normal) << x << ' ' << y;
        ASSERT_EQ(p.depth, q.depth) << x << ' ' << y;
        ASSERT_EQ(p.rays, q.rays) << x << ' ' << y;
      }
}

TEST(Session, BitsDoNotDependOnThreadsTilesOrCrop) {
  for (const char* sampler : {"sobol", "independent"}) {
    RenderOverrides one;
    one.spp = 12, one.seed = 7, one.threads = 1, one.sampler = sampler;
    const Film reference = render_text(kScene, ".", one);
    const PixelBounds all{0, 0, 30, 20};
    RenderOverrides other = one;
    other.threads = 2;
    expect_same_bits(reference, render_text(kScene, ".", other), all);
    other.threads = 3, other.tile_size = 5;
    expect_same_bits(reference, render_text(kScene, ".", other), all);
    other.crop = PixelBounds{7, 4, 23, 19};
    expect_same_bits(reference, render_text(kScene, ".", other), *other.crop);
  }
}

TEST(Session, EverythingWrongIsReportedTogether) {
  Diagnostics diagnostics;
  const std::string text = std::string(kScene) + "Shape \"sphere\" \"float radios\" 1\n";
  RenderOverrides overrides;
  overrides.set = {{"integrator.mode", "misty"}};
  EXPECT_FALSE(prepare_render(read_pbrt_text(text, "test", ".", diagnostics), overrides, diagnostics));
  const std::string all = diagnostics.format_all();
  EXPECT_NE(all.find("radios"), std::string::npos) << all;
  EXPECT_NE(all.find("misty"), std::string::npos) << all;
}

TEST(Session, TheImageCarriesItsStory) {
  Diagnostics diagnostics;
  RenderOverrides overrides;
  overrides.spp = 2;
  std::optional<PreparedRender> prepared =
      prepare_render(read_pbrt_text(kScene, "test", ".", diagnostics), overrides, diagnostics);
  ASSERT_TRUE(prepared) << diagnostics.format_all();
  RenderObserver nobody;
  const FinishedRender finished = run_render(*prepared, nobody);
  const LayeredImage image = finished_image(*prepared, finished);
  for (const char* name : {"etendue:version", "etendue:scene", "etendue:integrator.maxdepth", "etendue:biased"})
    EXPECT_TRUE(image.find_metadata(name)) << name;
  const RenderStats stats = finished_stats(*prepared, finished);
  EXPECT_EQ(stats.paths, 30u * 20u * 2u);
  EXPECT_EQ(stats.spp, 2u);
  EXPECT_EQ(stats.rays.camera, stats.paths);
  EXPECT_NEAR(stats.rays_per_pixel_mean * 600, static_cast<double>(stats.rays.total()), 1e-6);
}

}  // namespace
}  // namespace etd
