#include "render/settings.h"

#include <gtest/gtest.h>

#include "film/rgb.h"
#include "render/duration.h"
#include "render/registry.h"

namespace etd {
namespace {

Param integers(std::string name, std::vector<int32_t> values) {
  Param p;
  p.name = std::move(name);
  p.kind = ParamKind::kInteger;
  p.integers = std::move(values);
  return p;
}

Param floats(std::string name, std::vector<double> values) {
  Param p;
  p.name = std::move(name);
  p.kind = ParamKind::kFloat;
  p.numbers = std::move(values);
  return p;
}

SceneDescription scene_of(int width, int height, std::vector<Param> more = {}) {
  SceneDescription d;
  d.film.model = "rgb";
  d.film.params = {integers("xresolution", {width}), integers("yresolution", {height})};
  for (Param& p : more) d.film.params.push_back(std::move(p));
  d.sampler.model = "sobol";
  d.integrator.model = "path";
  return d;
}

RenderSettings good(const SceneDescription& d, const RenderOverrides& o = {}) {
  Diagnostics diagnostics;
  RenderSettings s = make_settings(d, o, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors()) << diagnostics.format_all();
  return s;
}

std::string bad(const SceneDescription& d, const RenderOverrides& o = {}) {
  Diagnostics diagnostics;
  make_settings(d, o, diagnostics);
  EXPECT_TRUE(diagnostics.has_errors());
  return diagnostics.format_all();
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Settings, DefaultsOfTheFormat) {
  const RenderSettings s = good(SceneDescription{});
  EXPECT_EQ(s.film.width, 1280);
  EXPECT_EQ(s.film.height, 720);
  EXPECT_EQ(s.film.crop, (PixelBounds{0, 0, 1280, 720}));
  EXPECT_EQ(s.spp, 16u);
  EXPECT_EQ(s.film.replicates, 1u);
  EXPECT_EQ(s.seed, 0u);
  EXPECT_EQ(s.sampler.name(), "sobol");
  EXPECT_EQ(s.integrator.model, "path");
  EXPECT_EQ(s.filename, "pbrt.exr");
}

TEST(Settings, TheSceneIsObeyed) {
  SceneDescription d = scene_of(100, 50);
  d.sampler = {"independent", {integers("pixelsamples", {6}), integers("seed", {9})}, {}};
  const RenderSettings s = good(d);
  EXPECT_EQ(s.film.width, 100);
  EXPECT_EQ(s.film.crop, (PixelBounds{0, 0, 100, 50}));
  EXPECT_EQ(s.spp, 6u);
  EXPECT_EQ(s.seed, 9u);
  EXPECT_EQ(s.sampler.name(), "independent");
}

TEST(Settings, SamplesAreRoundedUpToReplicates) {
  RenderOverrides o;
  o.spp = 5;
  EXPECT_EQ(good(scene_of(8, 8), o).spp, 5u);
  o.replicates = 2;
  EXPECT_EQ(good(scene_of(8, 8), o).spp, 6u);
  o.replicates = 4;
  EXPECT_EQ(good(scene_of(8, 8), o).spp, 8u);
  o.spp = 8;
  EXPECT_EQ(good(scene_of(8, 8), o).spp, 8u);
}

TEST(Settings, StopConditionsReplaceTheSamplesOfTheSceneButNotThoseGiven) {
  for (const bool time : {true, false}) {
    RenderOverrides o;
    if (time)
      o.seconds = 30;
    else
      o.error = 0.02;
    const RenderSettings s = good(scene_of(8, 8), o);
    EXPECT_TRUE(s.spp_unlimited);
    EXPECT_GT(s.spp, 1u << 29);
    EXPECT_EQ(s.driver.seconds, time ? 30 : HUGE_VAL);
    EXPECT_EQ(s.driver.error, time ? 0 : 0.02);
    o.replicates = 3;
    EXPECT_EQ(good(scene_of(8, 8), o).spp % 3, 0u);
    o.spp = 64;
    EXPECT_FALSE(good(scene_of(8, 8), o).spp_unlimited);
    EXPECT_EQ(good(scene_of(8, 8), o).spp, 66u);
    o.spp.reset();
    o.set = {{"sampler.pixelsamples", "9"}};
    EXPECT_EQ(good(scene_of(8, 8), o).spp, 9u);
  }
}

TEST(Settings, AnErrorThatIsNeverTestedIsAWarning) {
  RenderOverrides o;
  o.error = 0.02, o.spp = 16;
  Diagnostics diagnostics;
  make_settings(scene_of(8, 8), o, diagnostics);
  EXPECT_TRUE(has(diagnostics.format_all(), "warning: the error will never be tested")) << diagnostics.format_all();
}

TEST(Duration, IsReadAsPeopleWriteIt) {
  EXPECT_EQ(parse_duration("30"), 30.0);
  EXPECT_EQ(parse_duration("30s"), 30.0);
  EXPECT_EQ(parse_duration("2m"), 120.0);
  EXPECT_EQ(parse_duration("1h30m"), 5400.0);
  EXPECT_EQ(parse_duration("1h30m5.5s"), 5405.5);
  EXPECT_EQ(parse_duration("0.5h"), 1800.0);
  for (const char* text :
       {"", "s", "0", "0s", "-3s", "3d", "1m1h", "1m2m", "1h30", "30 s", "inf", "nan", "1e3s", "3s!"})
    EXPECT_FALSE(parse_duration(text)) << text;
}

TEST(Settings, CropWindowsAreAsInPbrt) {
  EXPECT_EQ(good(scene_of(10, 10, {floats("cropwindow", {0.25, 0.75, 0, 0.5})})).film.crop, (PixelBounds{3, 0, 8, 5}));
  EXPECT_EQ(good(scene_of(10, 10, {floats("cropwindow", {0.75, 0.25, 0.5, 0})})).film.crop, (PixelBounds{3, 0, 8, 5}));
  EXPECT_EQ(good(scene_of(10, 10, {integers("pixelbounds", {2, 20, 1, 4})})).film.crop, (PixelBounds{2, 1, 10, 4}));
  Diagnostics diagnostics;
  const SceneDescription both =
      scene_of(10, 10, {floats("cropwindow", {0, 1, 0, 1}), integers("pixelbounds", {2, 3, 1, 4})});
  EXPECT_EQ(make_settings(both, {}, diagnostics).film.crop, (PixelBounds{0, 0, 10, 10}));
  EXPECT_EQ(diagnostics.all().size(), 1u);
}

TEST(Settings, AnotherSizeTakesTheCropAlong) {
  RenderOverrides o;
  o.size = {20, 40};
  EXPECT_EQ(good(scene_of(10, 10, {floats("cropwindow", {0, 0.5, 0, 0.5})}), o).film.crop, (PixelBounds{0, 0, 10, 20}));
  EXPECT_EQ(good(scene_of(10, 10, {integers("pixelbounds", {2, 5, 1, 4})}), o).film.crop, (PixelBounds{4, 4, 10, 16}));
  o.crop = PixelBounds{1, 2, 20, 40};
  EXPECT_EQ(good(scene_of(10, 10, {integers("pixelbounds", {2, 5, 1, 4})}), o).film.crop, *o.crop);
}

TEST(Settings, OverridesOfDeclaredParameters) {
  RenderOverrides o;
  o.set = {{"integrator.maxdepth", "3"},
           {"integrator.maxdepth", "7"},
           {"film.filename", "a b.exr"},
           {"film.pixelbounds", "1,2,3,4"},
           {"sampler.pixelsamples", "32"}};
  SceneDescription d = scene_of(8, 8);
  d.integrator.params = {integers("maxdepth", {1})};
  const RenderSettings s = good(d, o);
  ASSERT_TRUE(s.integrator.find("maxdepth"));
  EXPECT_EQ(s.integrator.params.size(), 1u);
  EXPECT_EQ(s.integrator.find("maxdepth")->integers, std::vector<int32_t>{7});
  EXPECT_EQ(s.filename, "a b.exr");
  EXPECT_EQ(s.film.crop, (PixelBounds{1, 3, 2, 4}));
  EXPECT_EQ(s.spp, 32u);
  o.sampler = "independent";
  EXPECT_EQ(good(d, o).sampler.name(), "independent");
}

TEST(Settings, WrongOverridesAreErrorsThatSayWhatIsValid) {
  RenderOverrides o;
  o.set = {{"integrator.maxdept", "3"},
           {"integrator.maxdepth", "many"},
           {"integrator.mode", "misty"},
           {"camera.fov", "3"},
           {"nonsense", "1"}};
  const std::string message = bad(scene_of(8, 8), o);
  EXPECT_TRUE(has(message, "integrator \"path\" has no parameter \"maxdept\"")) << message;
  EXPECT_TRUE(has(message, "did you mean \"maxdepth\"?")) << message;
  EXPECT_TRUE(has(message, "\"many\" is not a value of type integer")) << message;
  EXPECT_TRUE(has(message, "cannot be \"misty\"")) << message;
  EXPECT_TRUE(has(message, "\"camera.fov\" names no setting")) << message;
  EXPECT_TRUE(has(message, "\"nonsense\" names no setting")) << message;
  EXPECT_TRUE(has(message, "command line:1:1: error")) << message;
}

TEST(Settings, WrongNumbersAndModelsAreErrors) {
  RenderOverrides o;
  o.size = {0, 10}, o.spp = 0, o.replicates = 0, o.threads = -1, o.tile_size = 0, o.seconds = 0, o.error = -1;
  o.sampler = "sobl";
  const std::string message = bad(scene_of(8, 8), o);
  for (const char* part : {"the image size must be", "spp must be", "replicates must be", "threads must be",
                           "the tile size must be", "the time limit must be", "the error to stop at must be",
                           "there is no sampler \"sobl\"", "did you mean \"sobol\"?"})
    EXPECT_TRUE(has(message, part)) << part << "\n" << message;
  RenderOverrides crop;
  crop.crop = PixelBounds{0, 0, 9, 8};
  EXPECT_TRUE(has(bad(scene_of(8, 8), crop), "the crop 0,9,0,8 is not a part of the image"));
  EXPECT_TRUE(has(bad(scene_of(8, 8, {floats("cropwindow", {0.5, 0.5, 0, 1})})), "leaves no pixel"));
  EXPECT_TRUE(has(bad(scene_of(8, 8, {integers("pixelbounds", {1, 2, 3})})), "takes 4 numbers"));
  EXPECT_TRUE(has(bad(scene_of(0, 8)), "xresolution"));
}

TEST(Registry, KnowsFilmSamplersAndIntegrators) {
  EXPECT_EQ(find_any_model(Family::kFilm, "rgb"), &RgbFilm::decl());
  EXPECT_TRUE(find_any_model(Family::kSampler, "sobol"));
  EXPECT_TRUE(find_any_model(Family::kSampler, "independent"));
  EXPECT_TRUE(find_any_model(Family::kIntegrator, "path"));
  EXPECT_FALSE(find_any_model(Family::kFilm, "path"));
  for (Family family : kAllFamilies) {
    for (const ModelDecl* model : all_models(family)) {
      EXPECT_EQ(model->family, family) << model->name;
      EXPECT_EQ(find_any_model(family, model->name), model) << model->name;
      EXPECT_FALSE(model->doc.empty()) << model->name;
      for (const ParamDecl& p : model->params) EXPECT_FALSE(p.doc.empty()) << model->name << '.' << p.name;
    }
  }
}

}  // namespace
}  // namespace etd
