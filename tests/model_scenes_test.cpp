// Every model and every parameter that changes the picture, against stored means (model_scenes.h has the names and the
// files): the mean of the whole picture and of each block of 4 x 4 pixels, in R, G and B, by Welch tests in every mode
// that converges, of which one must fail in both of two runs (second_run.h). All together raise a false alarm with a
// probability of at most 1e-4. With ETENDUE_UPDATE_EXPECTED set, the stored means are made anew instead.
//
// Power, which is asserted: with a probability of 9 in 10 the fast test finds an error of 12 % in the mean of a picture
// and one of 50 % in a block (the median one of those that are tested); the slow test of 2.5 % and 10 %.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <regex>
#include <set>

#include "formats/pbrt/reader.h"
#include "model_scenes.h"
#include "render/registry.h"
#include "render/session.h"
#include "second_run.h"

namespace etd {
namespace {

constexpr double kFamilyLevel = 1e-4;
constexpr double kLevel = 1e-6;     // of one test; fixed, so that a new scene does not change the verdict on the others
constexpr double kRounding = 2e-5;  // relative: of the stored numbers and of float arithmetic along a path
constexpr uint32_t kReplicates = 32;
constexpr uint32_t kStoredSpp = 4096;
constexpr uint32_t kSlowFactor = 32;  // how many more samples the slow test takes

const std::vector<ModelScene>& scenes() {
  static const std::vector<ModelScene> all = model_scenes();
  return all;
}

std::filesystem::path expected_file(const ModelScene& scene) {
  return std::filesystem::path(scene.file).replace_extension(".expected");
}

SceneDescription read_scene(const std::filesystem::path& file) {
  Diagnostics diagnostics;
  SceneDescription scene = read_pbrt(file, diagnostics);
  if (diagnostics.has_errors()) throw std::runtime_error(diagnostics.format_all());
  return scene;
}

std::string slurp(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::vector<RegionMeans> render_means(const SceneDescription& scene, const std::string& mode, uint32_t spp,
                                      uint64_t seed) {
  RenderOverrides o;
  o.spp = spp;
  o.replicates = kReplicates;
  o.seed = seed;
  o.tile_size = 4;
  o.features = false;
  o.set = {{"integrator.mode", mode}};
  return region_means(render_description(scene, o));
}

// `spp` are the samples of `ours`. Its error is at least what the stored one lets expect: few samples may all have
// missed what makes them differ, and then show none.
TestResult compare(MeanEstimate ours, MeanEstimate stored, uint32_t spp) {
  const double slack = std::abs(stored.mean) * kRounding;
  stored.mean = std::clamp(ours.mean, stored.mean - slack, stored.mean + slack);
  ours.variance_of_mean = std::max(ours.variance_of_mean, stored.variance_of_mean * kStoredSpp / spp);
  return welch_test(ours, stored);
}

// Whether the fast test has enough samples for the mean of a region to be normally distributed: in mode "mis" about a
// hundred that find the light. Asked of the stored means, since what was found must not choose what is tested.
// Other regions are tested as part of the picture, and those that no light reaches must stay black.
bool is_tested(const MeanEstimate& stored, uint32_t spp) {
  const double variance = stored.variance_of_mean * kStoredSpp / spp;
  return std::sqrt(variance) <= 0.1 * std::abs(stored.mean);
}

bool is_tested(const RegionMeans& stored, const ModelScene& scene) {
  const auto mis =
      std::find_if(scene.modes.begin(), scene.modes.end(), [](const SceneMode& m) { return m.name == "mis"; });
  return std::all_of(stored.rgb.begin(), stored.rgb.end(),
                     [&](const MeanEstimate& e) { return is_tested(e, mis->spp); });
}

// The relative error of the mean of R, G and B that a test would find with a probability of 9 in 10.
double visible_error(const RegionMeans& ours) {
  double mean = 0, variance = 0;
  for (const MeanEstimate& e : ours.rgb) {
    mean += e.mean / 3;
    variance = std::max(variance, e.variance_of_mean);
  }
  double relative = 1e-3;
  while (relative < 100 && !would_be_seen(relative, mean, std::sqrt(variance), kReplicates - 1, kLevel))
    relative *= 1.05;
  return relative;
}

double median(std::vector<double> numbers) {
  const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
  std::nth_element(numbers.begin(), middle, numbers.end());
  return *middle;
}

void find_differences(const RegionMeans& ours, const RegionMeans& stored, uint32_t spp, Objections& differences) {
  const PixelBounds& region = ours.region;
  for (size_t c = 0; c < 3; ++c) {
    const MeanEstimate &a = ours.rgb[c], &b = stored.rgb[c];
    const TestResult test = compare(a, b, spp);
    if (test.p_value < kLevel)
      differences.push_back(
          fmt::format("x {} to {}, y {} to {}, {}: {:.6g} +- {:.2g}, stored {:.6g} +- {:.2g}, {:+.3f} %, t = {:.2f}",
                      region.x0, region.x1, region.y0, region.y1, "RGB"[c], a.mean, std::sqrt(a.variance_of_mean),
                      b.mean, std::sqrt(b.variance_of_mean), 100 * (a.mean / b.mean - 1), test.statistic));
  }
}

void expect_stored_means(const ModelScene& scene, uint32_t more, double of_picture, double of_block) {
  ASSERT_EQ(scene.problem, "");
  const SceneDescription description = read_scene(scene.file);
  if (std::getenv("ETENDUE_UPDATE_EXPECTED"))
    write_means(expected_file(scene), render_means(description, "mis", kStoredSpp, 1));
  const std::vector<RegionMeans> stored = read_means(expected_file(scene));
  ASSERT_FALSE(stored.empty()) << "no stored means; make them with ETENDUE_UPDATE_EXPECTED=1";
  for (size_t m = 0; m < scene.modes.size(); ++m) {
    const SceneMode& mode = scene.modes[m];
    expect_in_two_runs(mode.name, [&](const TestRun& run) {
      const uint32_t spp = mode.spp * more * run.more;
      const std::vector<RegionMeans> ours = render_means(description, mode.name, spp, 2 + m + run.fresh_seeds);
      if (ours.size() != stored.size()) return Objections{"another number of regions than stored"};
      Objections differences;
      std::vector<double> blocks;
      for (size_t i = 0; i < ours.size(); ++i) {
        EXPECT_EQ(ours[i].region, stored[i].region);
        if (i > 0 && !is_tested(stored[i], scene)) continue;
        find_differences(ours[i], stored[i], spp, differences);
        if (i > 0) blocks.push_back(visible_error(ours[i]));
      }
      EXPECT_LE(visible_error(ours[0]), of_picture) << mode.name << ": too few samples to see such an error";
      if (blocks.empty()) return Objections{"too few samples to test any block"};
      EXPECT_LE(median(blocks), of_block) << mode.name << ": too few samples to see such an error of a block";
      return differences;
    });
  }
}

std::string scene_name(const testing::TestParamInfo<ModelScene>& info) {
  std::string name = info.param.file.stem().string();
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '-' || c == '.'; }, '_');
  return name;
}

}  // namespace

void PrintTo(const ModelScene& scene, std::ostream* out) { *out << scene.file.filename().string(); }

namespace {

class StatisticalModelScenes : public testing::TestWithParam<ModelScene> {};
TEST_P(StatisticalModelScenes, GiveTheStoredMeans) { expect_stored_means(GetParam(), 1, 0.12, 0.5); }

class SlowModelScenes : public testing::TestWithParam<ModelScene> {};
TEST_P(SlowModelScenes, GiveTheStoredMeans) { expect_stored_means(GetParam(), kSlowFactor, 0.03, 0.1); }

// The scene without the parameter that it shows is another picture.
TEST_P(SlowModelScenes, AreOtherPicturesWithoutTheirParameter) {
  const ModelScene& shown = GetParam();
  const ModelDecl* model = find_any_model(shown.family, shown.model);
  ASSERT_NE(model, nullptr);
  if (shown.parameter.empty() || model->find(shown.parameter)->required) return;
  const std::regex parameter("\"\\w+ " + shown.parameter + "\"\\s+(\\[[^\\]]*\\]|\"[^\"]*\"|\\S+)");
  Diagnostics diagnostics;
  const SceneDescription scene = read_pbrt_text(std::regex_replace(slurp(shown.file), parameter, ""), "test",
                                                shown.file.parent_path(), diagnostics);
  const bool compiles = !diagnostics.has_errors() && prepare_render(scene, {}, diagnostics);
  if (shown.parameter == "indices") {  // meshes of several faces cannot do without
    EXPECT_FALSE(compiles);
    return;
  }
  ASSERT_TRUE(compiles) << diagnostics.format_all();
  const std::vector<RegionMeans> stored = read_means(expected_file(shown));
  const std::vector<RegionMeans> without = render_means(scene, "mis", kStoredSpp, 7);
  if (without.size() != stored.size()) return;  // of another size
  double smallest = 1;
  for (size_t i = 0; i < without.size(); ++i)
    for (size_t c = 0; c < 3; ++c)
      smallest = std::min(smallest, compare(without[i].rgb[c], stored[i].rgb[c], kStoredSpp).p_value);
  EXPECT_LT(smallest, kLevel) << "nothing changes without the parameter";
}

INSTANTIATE_TEST_SUITE_P(All, StatisticalModelScenes, testing::ValuesIn(scenes()), scene_name);
INSTANTIATE_TEST_SUITE_P(All, SlowModelScenes, testing::ValuesIn(scenes()), scene_name);

// Both runs are compared with the same stored means, whose errors are therefore theirs in common. With n and 4 n
// samples against kStoredSpp the statistics of a test correlate by at most r = sqrt(n / (n + s) * 4 n / (4 n + s)), and
// where the first exceeded its bound z, the second does so by chance with the probability that a normal number of mean
// r z and variance 1 - r^2 exceeds z. (Of the slow test, which has more samples than the stored means, this is not
// claimed.)
TEST(ModelScenes, AreNotTooManyForTheFamilyLevel) {
  double alarms = 0;
  for (const ModelScene& scene : scenes())
    for (const SceneMode& mode : scene.modes) {
      const double first = static_cast<double>(read_means(expected_file(scene)).size() * 3) * kLevel;
      const double n = mode.spp, r = std::sqrt(n / (n + kStoredSpp) * 4 * n / (4 * n + kStoredSpp));
      constexpr double kBound = 4.89;  // exceeded in absolute value with probability kLevel
      alarms += first * (first + normal_sf(kBound * (1 - r) / std::sqrt(1 - r * r)));
    }
  EXPECT_LE(alarms, kFamilyLevel);
}

TEST(ModelScenes, ShowWhatTheirNamesSay) {
  for (const ModelScene& shown : scenes()) {
    ASSERT_EQ(shown.problem, "") << shown.file.filename();
    const ModelDecl* model = find_any_model(shown.family, shown.model);
    ASSERT_NE(model, nullptr) << shown.file.filename() << ": there is no such model";
    EXPECT_TRUE(shown.parameter.empty() || model->find(shown.parameter)) << shown.file.filename();
    const std::string text = slurp(shown.file);
    const auto has = [&](const std::string& s) { return text.find(s) != std::string::npos; };
    EXPECT_TRUE(has('"' + shown.model + '"') && (shown.parameter.empty() || has(' ' + shown.parameter + '"')) &&
                (shown.value.empty() || has('"' + shown.value + '"')))
        << shown.file.filename();
  }
}

// What no scene can show, and why. An empty model stands for all of the family.
struct Unseen {
  Family family;
  const char *model, *parameter, *why;
};
const Unseen kUnseen[] = {
    {Family::kSampler, "", "",
     "samplers change the noise, not the mean; the closed forms are rendered with all of them"},
    {Family::kSampler, "", "pixelsamples", "the noise"},
    {Family::kSampler, "", "seed", "the noise"},
    {Family::kIntegrator, "path", "mode", "never changes the mean; every scene is rendered in all that converge"},
    {Family::kIntegrator, "path", "roulettedepth", "never changes the mean; the agreement tests vary it"},
    {Family::kIntegrator, "path", "misheuristic", "never changes the mean; the agreement tests vary it"},
    {Family::kIntegrator, "path", "lightsampler", "never changes the mean; the agreement tests vary it"},
    {Family::kIntegrator, "path", "guiding", "never changes the mean; the agreement tests vary it"},
    {Family::kIntegrator, "path", "guidingpaths", "never changes the mean; the tests of guiding vary it"},
    {Family::kIntegrator, "path", "paths", "the agreement tests compare light with it"},
    {Family::kIntegrator, "light", "", "shows the picture of path, with which tests of its own compare it"},
    {Family::kIntegrator, "light", "maxdepth", "the tests of light vary it"},
    {Family::kIntegrator, "light", "components", "the tests of light vary it"},
    {Family::kIntegrator, "light", "roulettedepth", "as of the integrator path"},
    {Family::kIntegrator, "light", "lightsampler", "as of the integrator path"},
    {Family::kIntegrator, "light", "paths", "as of the integrator path"},
    {Family::kIntegrator, "sppm", "", "shows the picture of path, with which tests of its own compare it"},
    {Family::kIntegrator, "sppm", "maxdepth", "the tests of sppm vary it"},
    {Family::kIntegrator, "sppm", "components", "the tests of sppm vary it"},
    {Family::kIntegrator, "sppm", "radius", "the tests of sppm vary it"},
    {Family::kIntegrator, "sppm", "radiusscale", "the tests of sppm vary it"},
    {Family::kIntegrator, "sppm", "photonsperiteration", "the tests of sppm vary it"},
    {Family::kIntegrator, "sppm", "directlight", "the tests of sppm vary it"},
    {Family::kIntegrator, "sppm", "photonmemory", "the tests of sppm vary it"},
    {Family::kIntegrator, "sppm", "neardelta", "the tests of sppm vary it"},
    {Family::kIntegrator, "sppm", "roulettedepth", "as of the integrator path"},
    {Family::kIntegrator, "sppm", "lightsampler", "as of the integrator path"},
    {Family::kIntegrator, "sppm", "paths", "as of the integrator path"},
    {Family::kMaterial, "", "nsamples", "the noise"},
    {Family::kTexture, "imagemap", "layer", "which picture of a file; the tests of image kinds look at it"},
    {Family::kLight, "infinite", "layer", "the same as of the texture \"imagemap\""},
    {Family::kLight, "goniometric", "layer", "the same as of the texture \"imagemap\""},
    {Family::kLight, "projection", "layer", "the same as of the texture \"imagemap\""},
    {Family::kAreaLight, "diffuse", "layer", "the same as of the texture \"imagemap\""},
    {Family::kMaterial, "", "layer", "which picture of a file; the tests of image parts look at it"},
    {Family::kCamera, "", "layer", "which picture of a file; the tests of image parts look at it"},
    {Family::kCamera, "orthographic", "shutteropen", "the same as of the camera \"perspective\""},
    {Family::kCamera, "orthographic", "shutterclose", "the same as of the camera \"perspective\""},
    {Family::kCamera, "spherical", "shutteropen", "the same as of the camera \"perspective\""},
    {Family::kCamera, "spherical", "shutterclose", "the same as of the camera \"perspective\""},
    {Family::kFilm, "", "filename", "where the picture goes"},
    {Family::kFilm, "", "savefp16", "how the picture is written"},
    {Family::kFilm, "", "sensor", "there is one only"},
    {Family::kFilm, "gbuffer", "coordinatesystem", "changes no light; the tests of sensors look at its layers"},
    {Family::kFilm, "gbuffer", "xresolution", "the same as of the film \"rgb\""},
    {Family::kFilm, "gbuffer", "yresolution", "the same as of the film \"rgb\""},
    {Family::kFilm, "gbuffer", "cropwindow", "the same as of the film \"rgb\""},
    {Family::kFilm, "gbuffer", "pixelbounds", "the same as of the film \"rgb\""},
    {Family::kFilm, "gbuffer", "iso", "the same as of the film \"rgb\""},
    {Family::kFilm, "gbuffer", "exposuretime", "the same as of the film \"rgb\""},
    {Family::kFilm, "gbuffer", "imagingratio", "the same as of the film \"rgb\""},
    {Family::kFilm, "gbuffer", "whitebalance", "the same as of the film \"rgb\""},
    {Family::kFilm, "gbuffer", "maxcomponentvalue", "the same as of the film \"rgb\""},
};

using Shown = std::array<std::string, 4>;  // family, model, parameter, value

const Unseen* find_unseen(const Shown& s) {
  for (const Unseen& u : kUnseen)
    if (s[0] == file_word(u.family) && (*u.model == 0 || s[1] == u.model) && s[2] == u.parameter) return &u;
  return nullptr;
}

// What occurs in the scenes of a folder; of a string also its value.
void add_uses(const std::string& folder, std::set<Shown>& shown) {
  for (const auto& entry : std::filesystem::directory_iterator(source_path(folder))) {
    if (entry.path().extension() != ".pbrt") continue;
    SceneDescription scene = read_scene(entry.path());
    for_each_use(scene, [&](Family family, ModelUse& use) {
      shown.insert({file_word(family), use.model, "", ""});
      for (const Param& p : use.params) {
        shown.insert({file_word(family), use.model, p.name, ""});
        if (p.strings.size() == 1) shown.insert({file_word(family), use.model, p.name, p.strings[0]});
      }
    });
  }
}

// What a model must show: itself with what it requires, its other parameters, and of those with choices each but the
// default.
std::vector<Shown> to_show(const ModelDecl& model) {
  const std::string family = file_word(model.family);
  std::vector<Shown> all = {{family, model.name, "", ""}};
  for (const ParamDecl& p : model.params) {
    if (p.required) continue;
    all.push_back({family, model.name, p.name, ""});
    const std::string* standard = std::get_if<std::string>(&p.default_value);
    for (const std::string& choice : p.choices)
      if (!standard || choice != *standard) all.push_back({family, model.name, p.name, choice});
  }
  return all;
}

TEST(ModelScenes, ShowEveryModelAndParameter) {
  std::set<Shown> shown;
  for (const ModelScene& s : scenes()) {
    shown.insert({file_word(s.family), s.model, s.parameter, s.value});
    shown.insert({file_word(s.family), s.model, s.parameter, ""});
  }
  add_uses("tests/scenes/closed", shown);
  add_uses("tests/scenes/agree", shown);
  std::string missing;
  std::set<const Unseen*> used;
  for (Family family : kAllFamilies)
    for (const ModelDecl* model : all_models(family))
      for (const Shown& s : to_show(*model)) {
        if (const Unseen* u = find_unseen(s))
          used.insert(u);
        else if (!shown.count(s))
          missing += fmt::format("  {}-{}{}{}{}{}.pbrt\n", s[0], s[1], s[2].empty() ? "" : "-", s[2],
                                 s[3].empty() ? "" : "-", s[3]);
      }
  EXPECT_EQ(missing, "") << "no scene in tests/scenes/models shows these (model_scenes.h says how to add one)";
  for (const Unseen& u : kUnseen)
    EXPECT_TRUE(used.count(&u)) << "no such parameter: " << family_name(u.family) << " " << u.model << " "
                                << u.parameter;
}

// The false alarms of the tests above, counted: p-values of right means are uniform. Measured once over
// 1768 tests: chi-square 20.6 with 19 degrees of freedom, 3 p-values below 0.001.
TEST(SlowModelScenesLevel, PValuesOfRightMeansAreUniform) {
  constexpr size_t kBins = 20;
  constexpr uint64_t kSeeds = 4;
  std::vector<double> observed(kBins), tail(2);
  uint64_t seed = 1000;
  for (const ModelScene& scene : scenes()) {
    const SceneDescription description = read_scene(scene.file);
    const std::vector<RegionMeans> stored = read_means(expected_file(scene));
    for (const SceneMode& mode : scene.modes)
      for (uint64_t i = 0; i < kSeeds; ++i) {
        const size_t region = ++seed % stored.size(), channel = seed % 3;
        if (!is_tested(stored[region], scene)) continue;
        const MeanEstimate ours = render_means(description, mode.name, mode.spp, seed)[region].rgb[channel];
        if (std::sqrt(ours.variance_of_mean) <= std::abs(ours.mean) * kRounding) continue;  // nothing random here
        const double p = compare(ours, stored[region].rgb[channel], mode.spp).p_value;
        ++observed[std::min(static_cast<size_t>(p * kBins), kBins - 1)];
        ++tail[p < 0.001];
      }
  }
  const double tests = tail[0] + tail[1];
  const TestResult uniform = chi_square_test(observed, std::vector<double>(kBins, tests / kBins), 5);
  EXPECT_GT(uniform.p_value, kFamilyLevel) << "chi-square " << uniform.statistic;
  const TestResult tails = chi_square_test(tail, std::vector<double>{0.999 * tests, 0.001 * tests}, 1);
  EXPECT_GT(tails.p_value, kFamilyLevel) << tail[1] << " p-values below 0.001 among " << tests;
  std::cout << fmt::format(
      "{} tests: chi-square of the p-values {:.1f} with {} degrees of freedom, p = {:.3f}; {} below 0.001\n", tests,
      uniform.statistic, uniform.dof, uniform.p_value, tail[1]);
}

}  // namespace
}  // namespace etd
