// Light tracing, against path tracing from the camera: every kind of camera, lens and filter, every kind of light, and
// scenes that are much larger than what is seen of them. The scenes of tests/scenes/agree are compared in
// agreement_test.cpp, where an error of 1 % would be seen; here it takes 5 %.
#include "integrators/light.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "expect_agreement.h"
#include "formats/pbrt/reader.h"
#include "render/session.h"

namespace etd {
namespace {

constexpr double kFamilyLevel = 1e-4;
constexpr const char* kPinhole = R"(LookAt 0 -5 2  0 0 0.8  0 0 1  Camera "perspective" "float fov" 30 )";
constexpr const char* kLamp = R"(
AttributeBegin
AreaLightSource "diffuse" "rgb L" [ 4 3 2 ]
Shape "trianglemesh" "point3 P" [ -2 -2 4  2 -2 4  2 2 4  -2 2 4 ] "integer indices" [ 0 2 1 0 3 2 ]
AttributeEnd
)";
constexpr const char* kSky = R"(LightSource "infinite" "rgb L" [ 0.3 0.4 0.5 ])";

struct Case {
  const char* name;
  std::string camera = kPinhole;
  std::string lights = kLamp;
  uint32_t spp_path = 512, spp_light = 4096;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

// A rough metal ball with a glass ball before it on a diffuse floor.
std::string scene_of(const Case& c) {
  return c.camera + R"(
Film "rgb" "integer xresolution" 16 "integer yresolution" 16
Integrator "path" "integer maxdepth" 4
WorldBegin
)" + c.lights +
         R"(
Material "diffuse" "rgb reflectance" [ 0.5 0.4 0.3 ]
Shape "trianglemesh" "point3 P" [ -2.2 -2.2 0  2.2 -2.2 0  2.2 2.2 0  -2.2 2.2 0 ] "integer indices" [ 0 1 2 0 2 3 ]
AttributeBegin
Material "conductor" "float roughness" 0.3
Translate 0 0 1
Shape "sphere"
AttributeEnd
Material "dielectric"
Translate -0.5 -1.5 0.5
Shape "sphere" "float radius" 0.4
)";
}

const std::vector<Case>& cases() {
  static const std::vector<Case> all = [] {
    const std::string at = "LookAt 0 -5 2  0 0 0.8  0 0 1 ", inside = "LookAt 1 -2 0.5  0 0 0.8  0 0 1 ";
    std::vector<Case> c;
    c.push_back({"pinhole_box", std::string(kPinhole) + R"(PixelFilter "box")"});
    c.push_back({"pinhole_mitchell", std::string(kPinhole) + R"(PixelFilter "mitchell")"});
    c.push_back(
        {"pinhole_wide_gaussian",
         std::string(kPinhole) + R"(PixelFilter "gaussian" "float xradius" 6 "float yradius" 3 "float sigma" 2)"});
    c.push_back(
        {"thin_lens", at + R"(Camera "perspective" "float fov" 30 "float lensradius" 0.3 "float focaldistance" 4)"});
    c.push_back({"orthographic", at + R"(Camera "orthographic" "float screenwindow" [ -2 2 -2 2 ])"});
    c.push_back({"orthographic_lens", at + R"(Camera "orthographic" "float screenwindow" [ -2 2 -2 2 ]
        "float lensradius" 0.3 "float focaldistance" 4)"});
    c.push_back({"equal_area", inside + R"(Camera "spherical" PixelFilter "gaussian" "float xradius" 3 "float yradius" 3
        "float sigma" 1.5)",
                 kLamp, 512, 1024});
    c.push_back({"equirectangular", inside + R"(Camera "spherical" "string mapping" "equirectangular"
        PixelFilter "gaussian" "float xradius" 3 "float yradius" 3 "float sigma" 1.5)",
                 kLamp, 512, 2048});
    c.push_back({"sky", kPinhole, kSky});
    c.push_back({"points", kPinhole, R"(
        LightSource "point" "point3 from" [ 1 -2 3 ] "rgb I" [ 8 9 9 ]
        LightSource "spot" "point3 from" [ -2 -2 3 ] "point3 to" [ 0 0 1 ] "rgb I" [ 30 20 20 ])"});
    c.push_back({"sun", kPinhole, R"(LightSource "distant" "point3 from" [ 1 -2 3 ] "rgb L" [ 2 2 1 ])"});
    c.push_back({"mixed", kPinhole, std::string(kLamp) + kSky});
    // What is seen is a millionth of the scene.
    const std::string far = R"(AttributeBegin Material "diffuse" Translate 1e6 3e5 -2e5 Shape "sphere" AttributeEnd)";
    c.push_back({"sky_and_something_far", kPinhole, kSky + far, 512, 8192});
    c.push_back({"sun_and_something_far", kPinhole,
                 R"(LightSource "distant" "point3 from" [ 1 -2 3 ] "rgb L" [ 2 2 1 ])" + far});
    // A roof far above what is seen hides a part of the sky.
    c.push_back({"under_a_far_roof", kPinhole, std::string(kSky) + R"(
        AttributeBegin Material "diffuse" "rgb reflectance" [ 0 0 0 ]
        Shape "disk" "float height" 300 "float radius" 200 AttributeEnd)"});
    return c;
  }();
  return all;
}

class StatisticalLight : public testing::TestWithParam<Case> {};

TEST_P(StatisticalLight, AgreesWithPathsFromTheCamera) {
  const Case& c = GetParam();
  const std::string scene = scene_of(c);
  const auto render = [&](const char* integrator, uint32_t spp, uint64_t seed) {
    RenderOverrides o;
    o.integrator = integrator;
    o.replicates = 16;
    o.spp = spp;
    o.seed = seed;
    o.features = false;
    o.set = {{"integrator.paths", o.integrator == "path" ? "from_lights" : "from_camera"}};
    return render_text(scene, "tests/scenes", o);
  };
  const auto films = [&](const TestRun& run) {
    return std::pair(render("path", c.spp_path * run.more, 1 + run.fresh_seeds),
                     render("light", c.spp_light * run.more, 2 + run.fresh_seeds));
  };
  expect_agreement(c.name, repeated_level(kFamilyLevel, cases().size(), film_test_count(16, 16)), films, 0.05);
}

INSTANTIATE_TEST_SUITE_P(All, StatisticalLight, testing::ValuesIn(cases()),
                         [](const auto& each) { return std::string(each.param.name); });

Film render_light(uint32_t threads, const std::optional<PixelBounds>& crop = {}, const char* sampler = "sobol") {
  RenderOverrides o;
  o.integrator = "light";
  o.spp = 32;
  o.seed = 7;
  o.threads = static_cast<int>(threads);
  o.crop = crop;
  o.sampler = sampler;
  return render_text(scene_of({"", kPinhole, std::string(kLamp) + kSky}), "tests/scenes", o);
}

TEST(LightTracing, BitsDoNotDependOnThreadsOrCrop) {
  const Film one = render_light(1);
  const PixelBounds part{3, 5, 12, 16};
  const Film others[] = {render_light(2), render_light(5), render_light(2, part)};
  bool any_light = false;
  for (const Film& film : others) {
    const PixelBounds& c = film.settings().crop;
    for (int y = c.y0; y < c.y1; ++y)
      for (int x = c.x0; x < c.x1; ++x)
        for (uint32_t r = 0; r < 8; ++r) {
          const PixelSums a = one.sums(x, y, r), b = film.sums(x, y, r);
          ASSERT_EQ(a.emission, b.emission);
          ASSERT_EQ(a.direct, b.direct);
          ASSERT_EQ(a.indirect, b.indirect);
          ASSERT_EQ(a.count, b.count);
          any_light |= a.direct[1] > 0;
        }
  }
  EXPECT_TRUE(any_light);
  EXPECT_EQ(one.total(0, 0).count, 32.0);
}

// Each component alone is what it is among all of them; so are paths up to a length.
TEST(LightTracing, ComponentsAreThoseOfTheWhole) {
  for (const char* integrator : {"light", "sppm"}) {
    const auto render = [&](const char* parameter, const char* value) {
      RenderOverrides o;
      o.integrator = integrator;
      o.spp = 16, o.replicates = 4;
      o.set = {{std::string("integrator.") + parameter, value}};
      return render_text(scene_of({"", kPinhole, std::string(kLamp) + kSky}), "tests/scenes", o);
    };
    const Film all = render("components", "all"), emission = render("components", "emission"),
               direct = render("components", "direct"), indirect = render("components", "indirect"),
               short_paths = render("maxdepth", "1");
    double sum = 0;
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x) {
        const PixelSums a = all.light(x, y), e = emission.light(x, y), d = direct.light(x, y), n = indirect.light(x, y),
                        s = short_paths.light(x, y);
        const std::array<double, 3> black{};
        ASSERT_EQ(e.emission, a.emission) << integrator;
        ASSERT_EQ(d.direct, a.direct) << integrator;
        ASSERT_EQ(n.indirect, a.indirect) << integrator;
        ASSERT_EQ(s.direct, a.direct) << integrator;
        ASSERT_EQ(s.indirect, black) << integrator;
        ASSERT_EQ(e.direct, black) << integrator;
        ASSERT_EQ(d.emission, black) << integrator;
        ASSERT_EQ(n.direct, black) << integrator;
        sum += a.indirect[1];
      }
    EXPECT_GT(sum, 0.0) << integrator;
  }
}

// The messages that the settings of a scene with these overrides bring.
std::string messages(const std::string& integrator_line, const RenderOverrides& o, RenderSettings* settings = nullptr) {
  Diagnostics diagnostics;
  std::string text = scene_of({""});
  text.replace(text.find("Integrator"), text.find("WorldBegin") - text.find("Integrator"), integrator_line + "\n");
  const SceneDescription scene = read_pbrt_text(text, "scene.pbrt", {}, diagnostics);
  const RenderSettings made = make_settings(scene, o, diagnostics);
  if (settings) *settings = made;
  return diagnostics.format_all();
}

TEST(LightTracing, TakesTheParametersOfTheScenesLineThatItHas) {
  RenderOverrides o;
  o.integrator = "light";
  RenderSettings s;
  const std::string notes = messages(
      R"(Integrator "path" "integer maxdepth" 9 "string mode" "naive" "string misheuristic" "balance")", o, &s);
  EXPECT_EQ(s.integrator.model, "light");
  EXPECT_EQ(s.integrator.find("maxdepth")->integers[0], 9);
  EXPECT_EQ(s.integrator.find("mode"), nullptr);
  EXPECT_NE(notes.find("integrator \"light\" has none of these parameters, which the scene sets for \"path\": mode, "
                       "misheuristic"),
            std::string::npos)
      << notes;
  EXPECT_EQ(notes.find("error"), std::string::npos) << notes;
  EXPECT_EQ(s.film.replicates, 8u);
  EXPECT_FALSE(s.film.features);
}

TEST(LightTracing, IsNamedByScenesToo) {
  for (const char* name : {"light", "lightpath"}) {
    RenderSettings s;
    const std::string notes = messages(fmt::format("Integrator \"{}\" \"integer maxdepth\" 3", name), {}, &s);
    EXPECT_EQ(s.integrator.model, "light");
    EXPECT_EQ(s.integrator.find("maxdepth")->integers[0], 3);
    EXPECT_EQ(notes.find("error"), std::string::npos) << notes;
  }
}

TEST(LightTracing, RefusesWhatItCannotDo) {
  const auto expect = [](const RenderOverrides& o, const std::string& message) {
    const std::string text = messages(R"(Integrator "light")", o);
    EXPECT_NE(text.find(message), std::string::npos) << text;
    EXPECT_NE(text.find("1 error"), std::string::npos) << text;
  };
  RenderOverrides o;
  o.set = {{"integrator.mode", "naive"}};
  expect(o, "integrator \"light\" has no parameter \"mode\"");
  expect(o, "those that have it: path; \"light\" has maxdepth, components, roulettedepth, lightsampler, paths");
  o = {};
  o.replicates = 2;
  expect(o, "integrator \"light\" needs at least 4 replicates");
  o = {};
  o.alpha = true;
  expect(o, "does not look at the scene from the camera, so there is no alpha");
  o = {};
  o.integrator = "ligth";
  expect(o, "did you mean \"light\"?");
}

}  // namespace
}  // namespace etd
