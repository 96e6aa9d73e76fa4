// Estimators of one image must agree: naive = next_event = mis, roulette early, late or never, independent numbers or
// Sobol's, each heuristic, each choice of lights. Compared are the means of blocks of 8 x 8 pixels and of the whole
// image, by Welch tests that together raise a false alarm with a probability of at most 1e-4; what differs is rendered
// once more (second_run.h). That they would find an error of 1 % in the image is tested too. The results are a table in
// docs/verification.md.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>

#include "document_block.h"
#include "expect_agreement.h"
#include "light_sampling/light_sampler.h"
#include "samplers/sampler.h"

namespace etd {
namespace {

constexpr double kFamilyLevel = 1e-4;
constexpr uint32_t kReplicates = 32;
// Paths from lights are spread over all of a scene: where the camera sees little of it, or grazing light on bumps
// brings rare bright ones, errors of light are seen from 3 or 5 % on. The slow set has 32 times the samples.

// One way to make the image; what differs from the scene's own way is named.
struct Variant {
  std::string name;
  std::vector<std::pair<std::string, std::string>> set;
  std::string sampler = "sobol";
  uint32_t spp = 0;
  std::string integrator = "path";
  double visible = 0.01;  // share of the image that an error would have to be to be seen
};

// All that paths from lights can bring, by paths from the camera: what they are compared with.
Variant seen_by_light(uint32_t spp) { return {"mis", {{"integrator.paths", "from_lights"}}, "sobol", spp}; }

struct Scene {
  std::string name;
  uint32_t spp_naive, spp_next_event, spp_mis, spp_light;
  uint32_t spp_heuristics = 0, spp_uniform = 0;  // of the other heuristics and of lights all alike; 0: not compared
  double visible_light = 0.01;  // share of the image that an error of light would have to be to be seen
  bool costly = false;          // its other samplers and roulettes are left to the slow set
};
const Scene kScenes[] = {{"conductor_box", 160, 64, 64, 128, 128},
                         {"textured_room", 208, 96, 128, 64, 0, 96, 0.01, true},
                         {"sky_instances", 128, 352, 128, 256, 160, 96, 0.05, true},
                         {"glass_caustic", 320, 128, 144, 128, 0, 0, 0.01, true},
                         {"lamps", 320, 352, 512, 256, 0, 176, 0.03, true},
                         {"moving_lamps", 448, 896, 640, 640, 0, 0, 0.03, true},
                         {"window_room", 768, 160, 320, 128, 0, 0, 0.03, true},
                         {"bumpy_room", 640, 608, 288, 288, 0, 0, 0.05, true},
                         {"bumpy_glass", 256, 192, 160, 144}};

// All are compared with the first, light with what it can see of it. The slow set leaves nothing out.
std::vector<Variant> variants(const Scene& s, bool slow = false) {
  std::vector<Variant> all{{"mis", {}, "sobol", s.spp_mis},
                           {"naive", {{"integrator.mode", "naive"}}, "sobol", s.spp_naive},
                           {"next_event", {{"integrator.mode", "next_event"}}, "sobol", s.spp_next_event}};
  if (slow || !s.costly) {
    for (const ModelDecl* sampler : sampler_models())
      if (sampler->name != SamplerKind().name()) all.push_back({sampler->name, {}, sampler->name, s.spp_mis});
    all.push_back({"roulette from 1", {{"integrator.roulettedepth", "1"}}, "sobol", s.spp_mis});
    all.push_back({"no roulette", {{"integrator.roulettedepth", "1000"}}, "sobol", s.spp_mis});
  }
  if (s.spp_heuristics > 0)
    for (const std::string name : {"balance", "maximum", "uniform"})
      all.push_back({name + " heuristic", {{"integrator.misheuristic", name}}, "sobol", s.spp_heuristics});
  if (s.spp_uniform > 0)
    for (const LightSamplerModel& m : light_sampler_models())
      if (m.name != LightSampler().name())
        all.push_back({"lights " + m.doc, {{"integrator.lightsampler", m.name}}, "sobol", s.spp_uniform});
  all.push_back({"light", {{"integrator.paths", "from_camera"}}, "sobol", s.spp_light, "light", s.visible_light});
  all.push_back(
      {"guided", {{"integrator.guiding", "sdtree"}, {"integrator.guidingpaths", "5000"}}, "sobol", s.spp_mis});
  return all;
}

// The level of one test: both runs of a pair of films must find a difference.
double level() {
  size_t pairs = 0;
  for (const Scene& s : kScenes) pairs += variants(s, true).size() - 1;
  return repeated_level(kFamilyLevel, pairs, film_test_count(48, 48));
}

Film render_variant(const Scene& scene, const Variant& variant, uint64_t seed, uint32_t more) {
  RenderOverrides o;
  o.spp = variant.spp * more;
  o.replicates = kReplicates;
  o.seed = seed;
  o.sampler = variant.sampler;
  o.integrator = variant.integrator;
  o.tile_size = 4;
  o.features = false;
  o.set = variant.set;
  return render_scene(source_path("tests/scenes/agree/" + scene.name + ".pbrt"), o);
}

// Rows of the table, by scene and variant.
std::map<std::string, std::string>& results() {
  static std::map<std::string, std::string> rows;
  return rows;
}
std::string row_name(const Scene& s, const Variant& v) { return fmt::format("| {} | {} |", s.name, v.name); }

std::string row(const Scene& scene, const Variant& v, const std::vector<FilmTest>& tests) {
  const FilmTest& g = tests[1];
  double smallest = 1;
  for (const FilmTest& t : tests) smallest = std::min(smallest, t.result.p_value);
  const double error = std::sqrt(g.a.variance_of_mean() + g.b.variance_of_mean());
  return fmt::format("{} {} | {:.5f} | {:+.3f} ± {:.3f} % | {:.2g} |", row_name(scene, v), v.spp, g.b.mean(),
                     100 * (g.b.mean() / g.a.mean() - 1), 100 * error / g.a.mean(),
                     sidak_combined(smallest, tests.size()));
}

void expect_all_agree(const Scene& scene, uint32_t more = 1) {
  const std::vector<Variant> all = variants(scene, more > 1);
  const Film reference = render_variant(scene, all[0], 100, more);
  for (size_t i = 1; i < all.size(); ++i) {
    const std::string name = fmt::format("{}, {} against {}", scene.name, all[i].name, all[0].name);
    const bool sees_all = all[i].integrator == "path";
    const Variant against = sees_all ? all[0] : seen_by_light(scene.spp_mis);
    const auto films = [&](const TestRun& run) {
      const uint64_t seed = 100 + run.fresh_seeds;
      return std::pair(run.is_first() && sees_all ? reference : render_variant(scene, against, seed, more * run.more),
                       render_variant(scene, all[i], seed + i, more * run.more));
    };
    const std::vector<FilmTest> tests = expect_agreement(name, level(), films, all[i].visible);
    if (more == 1) results()[row_name(scene, all[i])] = row(scene, all[i], tests);
  }
}

TEST(StatisticalAgreement, ConductorBox) { expect_all_agree(kScenes[0]); }
TEST(StatisticalAgreement, TexturedRoom) { expect_all_agree(kScenes[1]); }
TEST(StatisticalAgreement, SkyAndInstances) { expect_all_agree(kScenes[2]); }
TEST(StatisticalAgreement, GlassCaustic) { expect_all_agree(kScenes[3]); }
TEST(StatisticalAgreement, Lamps) { expect_all_agree(kScenes[4]); }
TEST(StatisticalAgreement, MovingLamps) { expect_all_agree(kScenes[5]); }
TEST(StatisticalAgreement, WindowRoom) { expect_all_agree(kScenes[6]); }
TEST(StatisticalAgreement, BumpyRoom) { expect_all_agree(kScenes[7]); }
TEST(StatisticalAgreement, BumpyGlass) { expect_all_agree(kScenes[8]); }

TEST(SlowAgreement, ConductorBox) { expect_all_agree(kScenes[0], 32); }
TEST(SlowAgreement, TexturedRoom) { expect_all_agree(kScenes[1], 32); }
TEST(SlowAgreement, SkyAndInstances) { expect_all_agree(kScenes[2], 32); }
TEST(SlowAgreement, GlassCaustic) { expect_all_agree(kScenes[3], 32); }
TEST(SlowAgreement, Lamps) { expect_all_agree(kScenes[4], 32); }
TEST(SlowAgreement, MovingLamps) { expect_all_agree(kScenes[5], 32); }
TEST(SlowAgreement, WindowRoom) { expect_all_agree(kScenes[6], 32); }
TEST(SlowAgreement, BumpyRoom) { expect_all_agree(kScenes[7], 32); }
TEST(SlowAgreement, BumpyGlass) { expect_all_agree(kScenes[8], 32); }

TEST(StatisticalAgreement, FindsAPlantedErrorOfOnePercent) {
  const Scene& scene = kScenes[2];
  const std::vector<Variant> all = variants(scene);
  const Film a = render_variant(scene, all[0], 200, 1), b = render_variant(scene, all[2], 201, 1);
  for (const double factor : {0.99, 1.01}) {
    double smallest = 1;
    for (const FilmTest& t : compare_films(a, b, factor)) smallest = std::min(smallest, t.result.p_value);
    EXPECT_LT(smallest, level()) << "an image scaled by " << factor << " was not told from the other";
  }
}

// Rows of the table as they stand in the page, by their first two columns.
std::map<std::string, std::string> committed_rows() {
  std::map<std::string, std::string> rows;
  const std::string text = read_document_block("verification.md", "agreement").value_or("");
  size_t line = 0;
  for (size_t begin = 0, end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
    const std::string row = text.substr(begin, end - begin);
    if (++line <= 2) continue;  // the head
    size_t cut = 0;
    for (int bars = 0; cut < row.size() && bars < 3; ++cut) bars += row[cut] == '|';
    rows[row.substr(0, cut)] = row;
  }
  return rows;
}

// Numbers differ between machines and compilers, so that what is compared is which rows there are. Runs last, after the
// tests whose results it writes; rows of scenes that did not run stay as they are.
TEST(StatisticalAgreement, TheTableListsEveryComparison) {
  const std::map<std::string, std::string> committed = committed_rows();
  std::string table =
      "| scene | estimator | spp | mean of G | difference from `mis` | smallest p |\n"
      "|---|---|---|---|---|---|\n";
  size_t count = 0;
  for (const Scene& scene : kScenes) {
    const std::vector<Variant> all = variants(scene);
    for (size_t i = 1; i < all.size(); ++i, ++count) {
      const std::string name = row_name(scene, all[i]);
      const auto now = results().find(name);
      const auto before = committed.find(name);
      const bool known = before != committed.end();
      table += (now != results().end() ? now->second : known ? before->second : name) + "\n";
      EXPECT_TRUE(known || updates_expected())
          << name << ": run StatisticalAgreement with ETENDUE_UPDATE_EXPECTED=1 and commit the page";
    }
  }
  if (updates_expected()) return write_document_block("verification.md", "agreement", table);
  EXPECT_EQ(committed.size(), count) << "the page has rows that are compared no more";
}

}  // namespace
}  // namespace etd
