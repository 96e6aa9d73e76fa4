// A small scene from text to film: what the whole chain promises.
#include "render/session.h"

#include <gtest/gtest.h>

#include "formats/pbrt/reader.h"
#include "render_helper.h"
#include "same_bits.h"
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

TEST(Session, BitsDoNotDependOnThreadsTilesOrCrop) {
  for (const char* sampler : {"sobol", "independent"}) {
    RenderOverrides one;
    one.spp = 12, one.seed = 7, one.threads = 1, one.sampler = sampler;
    const Film reference = render_text(kScene, ".", one);
    RenderOverrides other = one;
    other.threads = 2;
    expect_same_bits(reference, render_text(kScene, ".", other));
    other.threads = 3, other.tile_size = 5;
    expect_same_bits(reference, render_text(kScene, ".", other));
    other.crop = PixelBounds{7, 4, 23, 19};
    expect_same_bits(reference, render_text(kScene, ".", other));
  }
}

TEST(Session, ReplicatesAreThoseOfTheWholeImageWhereverTheyAreRendered) {
  for (const char* integrator : {"path", "light"}) {
    RenderOverrides o;
    o.spp = 40, o.replicates = 8, o.seed = 5, o.integrator = integrator;
    const Film whole = render_text(kScene, ".", o);
    for (const auto& [first, count] : {std::pair(0u, 3u), std::pair(3u, 4u), std::pair(7u, 1u)}) {
      o.replicate_range = {first, count};
      const Film part = render_text(kScene, ".", o);
      ASSERT_EQ(part.settings().replicates, count);
      EXPECT_EQ(part.total(0, 0).count, 5.0 * count);
      for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 30; ++x)
          for (uint32_t r = 0; r < count; ++r) {
            const PixelSums a = whole.sums(x, y, first + r), b = part.sums(x, y, r);
            ASSERT_EQ(a.emission, b.emission) << integrator << ' ' << x << ' ' << y;
            ASSERT_EQ(a.direct, b.direct) << integrator << ' ' << x << ' ' << y;
            ASSERT_EQ(a.indirect, b.indirect) << integrator << ' ' << x << ' ' << y;
            ASSERT_EQ(a.count, b.count);
          }
      // A sample keeps its name.
      const uint32_t strongest = part.strongest(12, 9).number;
      if (strongest > 0) {
        EXPECT_GE(strongest % 8, first);
        EXPECT_LT(strongest % 8, first + count);
      }
    }
  }
  Diagnostics diagnostics;
  RenderOverrides o;
  o.replicates = 8, o.replicate_range = {6, 3};
  EXPECT_FALSE(prepare_render(read_pbrt_text(kScene, "test", ".", diagnostics), o, diagnostics));
  EXPECT_NE(diagnostics.format_all().find("there are no replicates 6 to 8: the image has 8"), std::string::npos);
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
