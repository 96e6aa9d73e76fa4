// Estimators of one image must agree: naive = next_event = mis, roulette early, late or never, independent numbers or
// Sobol's. Compared are the means of blocks of 8 x 8 pixels and of the whole image, by Welch tests that together raise
// a false alarm with a probability of at most 1e-4; what differs is rendered once more. That they would find an error
// of 1 % in the image is tested too.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <iostream>

#include "compare_films.h"

namespace etd {
namespace {

constexpr double kFamilyLevel = 1e-4;
constexpr uint32_t kReplicates = 32;

// One way to make the image; what differs from the scene's own way is named.
struct Variant {
  std::string name;
  std::vector<std::pair<std::string, std::string>> set;
  std::string sampler = "sobol";
  uint32_t spp = 0;
};

struct Scene {
  std::string name;
  uint32_t spp_naive, spp_next_event, spp_mis;
};
const Scene kScenes[] = {{"conductor_box", 1024, 512, 256}, {"textured_room", 1024, 256, 256},
                         {"sky_instances", 512, 512, 128},  {"glass_caustic", 1024, 512, 512},
                         {"lamps", 2048, 1024, 1024},       {"window_room", 2048, 384, 384},
                         {"moving_lamps", 1024, 1024, 1024}};

// All are compared with the first.
std::vector<Variant> variants(const Scene& s) {
  return {{"mis", {}, "sobol", s.spp_mis},
          {"naive", {{"integrator.mode", "naive"}}, "sobol", s.spp_naive},
          {"next_event", {{"integrator.mode", "next_event"}}, "sobol", s.spp_next_event},
          {"independent", {}, "independent", s.spp_mis},
          {"roulette from 1", {{"integrator.roulettedepth", "1"}}, "sobol", s.spp_mis},
          {"no roulette", {{"integrator.roulettedepth", "1000"}}, "sobol", s.spp_mis}};
}

// The level of one test: scenes, pairs of films, regions.
double level() { return bonferroni_level(kFamilyLevel, std::size(kScenes) * 5 * film_test_count(48, 48)); }

Film render_variant(const Scene& scene, const Variant& variant, uint64_t seed, uint32_t more) {
  RenderOverrides o;
  o.spp = variant.spp * more;
  o.replicates = kReplicates;
  o.seed = seed;
  o.sampler = variant.sampler;
  o.tile_size = 4;
  o.features = false;
  o.set = variant.set;
  return render_scene(source_path("tests/scenes/agree/" + scene.name + ".pbrt"), o);
}

void expect_all_agree(const Scene& scene, uint32_t more = 1) {
  const std::vector<Variant> all = variants(scene);
  ASSERT_EQ(all.size(), 6u);
  const Film reference = render_variant(scene, all[0], 100, more);
  for (size_t i = 1; i < all.size(); ++i) {
    const std::string name = fmt::format("{}, {} against {}", scene.name, all[i].name, all[0].name);
    const Film film = render_variant(scene, all[i], 100 + i, more);
    if (films_agree(reference, film, level())) {
      expect_agreement(name, reference, film, level());  // that it would have seen an error
      continue;
    }
    // Once more with fresh seeds: an error stays, and shows the better for four times the samples.
    std::cout << name << ": differ, once more with four times the samples\n";
    expect_agreement(name, render_variant(scene, all[0], 1100, 4 * more),
                     render_variant(scene, all[i], 1100 + i, 4 * more), level());
  }
}

TEST(StatisticalAgreement, ConductorBox) { expect_all_agree(kScenes[0]); }
TEST(StatisticalAgreement, TexturedRoom) { expect_all_agree(kScenes[1]); }
TEST(StatisticalAgreement, SkyAndInstances) { expect_all_agree(kScenes[2]); }
TEST(StatisticalAgreement, GlassCaustic) { expect_all_agree(kScenes[3]); }
TEST(StatisticalAgreement, Lamps) { expect_all_agree(kScenes[4]); }
TEST(StatisticalAgreement, WindowRoom) { expect_all_agree(kScenes[5]); }
TEST(StatisticalAgreement, MovingLamps) { expect_all_agree(kScenes[6]); }

TEST(SlowAgreement, ConductorBox) { expect_all_agree(kScenes[0], 32); }
TEST(SlowAgreement, TexturedRoom) { expect_all_agree(kScenes[1], 32); }
TEST(SlowAgreement, SkyAndInstances) { expect_all_agree(kScenes[2], 32); }
TEST(SlowAgreement, GlassCaustic) { expect_all_agree(kScenes[3], 32); }
TEST(SlowAgreement, Lamps) { expect_all_agree(kScenes[4], 32); }
TEST(SlowAgreement, WindowRoom) { expect_all_agree(kScenes[5], 32); }
TEST(SlowAgreement, MovingLamps) { expect_all_agree(kScenes[6], 32); }

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

}  // namespace
}  // namespace etd
