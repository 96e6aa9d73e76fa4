// Lights as scenes describe them: what their parameters mean, and what may be wrong with them.
#include <gtest/gtest.h>

#include "core/hash.h"
#include "formats/pbrt/reader.h"
#include "io/pfm.h"
#include "lights/light_data.h"
#include "render/session.h"
#include "scene/compile.h"
#include "scene/scene.h"
#include "temp_folder.h"

namespace etd {
namespace {

// The lights of a scene that has nothing else, with a file "map.pfm" of 2 x 2 texels and "wide.pfm" of 4 x 2.
struct Lights {
  explicit Lights(const std::string& text) {
    const std::vector<float> square{1, 2, 3, 4, 5, 6, 0, 0, 0, 7, 1, 1};
    std::vector<float> wide(24, 0.5f);
    wide[4] = 9.0f;
    folder.write("map.pfm", encode_pfm(2, 2, square));
    folder.write("wide.pfm", encode_pfm(4, 2, wide));
    folder.write("odd.pfm", encode_pfm(4, 3, std::vector<float>(36, 1.0f)));
    wide[7] = kInfinity;
    folder.write("infinite.pfm", encode_pfm(4, 2, wide));
    scene = compile(read_pbrt_text("WorldBegin\n" + text, "test.pbrt", folder.path(), diagnostics), {8, 8}, diagnostics)
                .scene;
  }
  const Light& only() const { return scene->lights.at(0); }

  TempFolder folder;
  Diagnostics diagnostics;
  std::shared_ptr<const Scene> scene;
};

std::string messages(const std::string& text) { return Lights(text).diagnostics.format_all(); }

TEST(LightParameters, PowerIsTheLuminanceOfWhatIsEmitted) {
  for (const char* text : {
           R"(LightSource "point" "rgb I" [1 2 3] "float power" 50)",
           R"(LightSource "spot" "rgb I" [1 2 3] "float power" 25 "float scale" 2)",
           R"(LightSource "goniometric" "rgb I" [1 2 3] "string filename" "map.pfm" "float power" 50)",
           R"(LightSource "projection" "string filename" "wide.pfm" "float power" 50 "float scale" 1)",
       }) {
    SCOPED_TRACE(text);
    const Lights lights(text);
    ASSERT_TRUE(lights.scene) << lights.diagnostics.format_all();
    EXPECT_NEAR(luminance(lights.only().power()), 50.0f, 1e-3f);
  }
}

TEST(LightParameters, PositionsFollowTheTransform) {
  const Lights lights(R"(Translate 1 2 3 Scale 2 2 2 LightSource "point" "point3 from" [1 0 0])");
  const auto s = lights.only().sample_li({3, 2, 0}, {}, {});
  ASSERT_TRUE(s);
  EXPECT_NEAR(length(s->wi - Vec3{0, 0, 1}), 0.0f, 1e-6f);
  EXPECT_NEAR(s->radiance[0], 1.0f / 9.0f, 1e-6f);
}

TEST(LightParameters, MistakesAreExplained) {
  const auto expect = [](const std::string& text, const std::string& message) {
    const std::string all = messages(text);
    EXPECT_NE(all.find(message), std::string::npos) << text << "\n" << all;
  };
  expect(R"(LightSource "infinite" "float L" 1 "string filename" "map.pfm")", "can't have both an L and a file");
  expect(R"(LightSource "infinite" "string filename" "odd.pfm")", "4 x 3 texels is no map of directions");
  expect(R"(LightSource "infinite" "string filename" "infinite.pfm")", "its texel (2, 0) is not finite: it becomes");
  expect(R"(LightSource "infinite" "string filename" "none.pfm")", "cannot read image \"none.pfm\"");
  expect(R"(Scale 1 2 1 LightSource "infinite" "string filename" "map.pfm")", "distorts angles");
  expect(R"(LightSource "goniometric")", "filename");
  expect(R"(LightSource "projection" "string filename" "map.pfm" "float fov" 180)", "below 180 degrees");
  expect(R"(LightSource "spot" "float coneangle" 10 "float conedeltaangle" 20)", "can't fade over 20 degrees");
  expect(R"(LightSource "spot" "point3 from" [1 2 3] "point3 to" [1 2 3])", "are the same point");
  expect(R"(LightSource "point" "rgb I" [0 0 0] "float power" 10)", "a black light can't have a power of 10");
}

// What rays meet and what lights send is the same sky.
TEST(ImageInfiniteLight, SamplesCarryWhatRaysFind) {
  const Lights lights(R"(Rotate 30 1 2 3 Scale 1 1 -1 LightSource "infinite" "string filename" "wide.pfm")");
  ASSERT_EQ(lights.scene->infinite_lights.size(), 1u);
  const Light& light = lights.only();
  HashStream numbers(12);
  for (int i = 0; i < 10000; ++i) {
    const float x = numbers.next_float(), y = numbers.next_float();
    for (const LightSampling sampling : {LightSampling::kComplete, LightSampling::kCompensated}) {
      const auto s = light.sample_li({}, {x, y}, {}, sampling);
      ASSERT_TRUE(s);
      ASSERT_EQ(light.pdf_li({}, s->wi, nullptr, {}, sampling), s->pdf);
      ASSERT_EQ(light.emitted(nullptr, -s->wi, {})[1], s->radiance[1]);
    }
  }
}

TEST(PathBias, NaiveSaysThatItCannotFindDeltaLights) {
  TempFolder folder;
  Diagnostics diagnostics;
  const SceneDescription d =
      read_pbrt_text("WorldBegin\nLightSource \"point\"", "test.pbrt", folder.path(), diagnostics);
  RenderOverrides overrides;
  overrides.set = {{"integrator.mode", "naive"}};
  auto prepared = prepare_render(d, overrides, diagnostics);
  ASSERT_TRUE(prepared) << diagnostics.format_all();
  EXPECT_NE(prepared->integrator->bias().find("lights that no ray meets"), std::string::npos);
}

}  // namespace
}  // namespace etd
