// Guiding: trees whose samples follow their density, cells that know their light, and a path tracer that it makes
// better without a change of what it promises.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/warp.h"
#include "expect_agreement.h"
#include "formats/pbrt/reader.h"
#include "integrators/guiding/training.h"
#include "integrators/path_record.h"
#include "render/memory.h"
#include "render/session.h"
#include "render_helper.h"
#include "same_bits.h"
#include "verify/battery/direction_histogram.h"

namespace etd {
namespace {

// Light of n photons; a share of them comes from within a cone of this cosine about (1, 2, -2).
std::vector<DirectedFlux> lobe(size_t n, float share, float cosine) {
  const Frame frame = Frame::from_z(normalize(Vec3{1, 2, -2}));
  HashStream random(7);
  std::vector<DirectedFlux> light;
  for (size_t i = 0; i < n; ++i) {
    const float which = random.next_float(), x = random.next_float(), y = random.next_float();
    const float x_in_cone = x * 0.5f * (1.0f - cosine);  // z = 1 - 2 x is at least the cosine
    const Vec3 w =
        which < share ? frame.to_world(sample_sphere_uniform({x_in_cone, y})) : sample_sphere_uniform({x, y});
    light.push_back({DirectedFlux::encode(w), 0.5f + random.next_float()});
  }
  return light;
}

// Level 1e-4 for each of the three; no false alarm in 100 seeds.
TEST(Guiding, DirectionsFollowTheirDensity) {
  DirectionTrees trees;
  for (const float share : {0.0f, 0.5f, 1.0f}) {
    std::vector<DirectedFlux> light = lobe(3000, share, 0.995f);
    const uint32_t root = trees.add(light);
    size_t drawn = 0, other = 0;
    WorstP chi_square("direction tree", "samples follow the density"), mass("direction tree", "its integral is 1");
    check_direction_density({.draw = [&](HashStream& u) -> std::optional<Vec3> {
                               const float x = u.next_float(), y = u.next_float();
                               const GuidedDirection d = trees.sample(root, {x, y});
                               EXPECT_NEAR(length(d.w), 1.0f, 1e-5f);
                               ++drawn, other += std::abs(trees.pdf(root, d.w) / d.pdf - 1.0f) > 1e-3f;
                               return d.w;
                             },
                             .pdf = [&](Vec3 w) { return static_cast<double>(trees.pdf(root, w)); },
                             .jumps = true,
                             .cells = 64,
                             .integration_error = 1e-3},
                            fmt::format("share {}", share), 100000, 5, chi_square, mass);
    for (const CheckResult& r : {chi_square.result(), mass.result()}) EXPECT_GT(*r.p_value, 1e-4) << r.name << r.text;
    EXPECT_LT(other, drawn / 1000) << "but at the edges of quadrants, sample() says what pdf() says";
    // A cone of .03 sr that half of the light comes from is found.
    const float inside = trees.pdf(root, normalize(Vec3{1, 2, -2}));
    EXPECT_GT(inside, share > 0 ? 0.5f * share / (2 * kPi * 0.005f) : 0.15f * kInvPi);
    EXPECT_LT(inside, share > 0 ? 2.0f * share / (2 * kPi * 0.005f) : 0.4f * kInvPi);
  }
}

// Two parallel squares of 1 m^2 and 4 m^2 that face up and down.
TEST(Guiding, CellsKnowTheIrradianceOfTheirSide) {
  Guide guide;
  guide.start(2);
  HashStream random(3);
  const auto add = [&](size_t item, float size, float z, Vec3 normal, bool direct) {
    const float x = size * random.next_float(), y = size * random.next_float();
    guide.add(item, {{x, y, z}, DirectedFlux::encode(normal), 0.01f, Guide::side_of(normal), direct});
  };
  for (int i = 0; i < 40000; ++i) add(0, 1.0f, 0.0f, {0, 0, 1}, i % 4 == 0);
  for (int i = 0; i < 10000; ++i) add(1, 2.0f, 0.0f, {0, 0, -1}, false);
  guide.begin_build();
  for (size_t part = guide.parts(); part-- > 0;) guide.build(part);
  guide.end_build();
  double up = 0, down = 0;
  for (int i = 0; i < 100; ++i) {
    const float x = random.next_float(), y = random.next_float();
    const GuideCell* above = guide.find({x, y, 0}, {0, 0, 1});
    const GuideCell* below = guide.find({2 * x, 2 * y, 0}, {0, 0, -1});
    ASSERT_TRUE(above && below);
    EXPECT_NEAR(above->irradiance, 400, 40);
    EXPECT_NEAR(below->irradiance, 25, 3);
    up += above->indirect / 100, down += below->indirect / 100;
  }
  EXPECT_NEAR(up, 300, 10);
  EXPECT_NEAR(down, 25, 1);
  EXPECT_EQ(guide.find({0.5f, 0.5f, 0}, {1, 0, 0}), nullptr) << "nothing is known of that side";
}

// A room that light reaches through a gap alone: from a lamp behind a wall.
const char* const kGap = R"(
LookAt 0 1 4.5  0 1 0  0 1 0
Camera "perspective" "float fov" 50
Film "rgb" "integer xresolution" 16 "integer yresolution" 16
Integrator "path" "integer maxdepth" 12
WorldBegin
Material "diffuse" "rgb reflectance" [.8 .7 .6]
Shape "trianglemesh" "point3 P" [-2 0 -2 2 0 -2 2 0 5 -2 0 5  -2 2 -2 2 2 -2 2 2 5 -2 2 5]
  "integer indices" [0 2 1 0 3 2  4 5 6 4 6 7  0 1 5 0 5 4  3 7 6 3 6 2  0 4 7 0 7 3  1 2 6 1 6 5]
Shape "trianglemesh" "point3 P" [-2 0 -1 1.7 0 -1 1.7 2 -1 -2 2 -1] "integer indices" [0 1 2 0 2 3]
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [20 20 20]
  Shape "trianglemesh" "point3 P" [-1.5 .5 -1.9 -1 .5 -1.9 -1 1 -1.9 -1.5 1 -1.9] "integer indices" [0 1 2 0 2 3]
AttributeEnd
)";

RenderOverrides guided(uint32_t spp, uint64_t seed, uint32_t replicates = 1) {
  RenderOverrides o;
  o.spp = spp, o.seed = seed, o.replicates = replicates;
  o.set = {{"integrator.guiding", "sdtree"}, {"integrator.guidingpaths", "60000"}};
  return o;
}

TEST(Guiding, BitsDoNotDependOnThreadsOrTiles) {
  RenderOverrides o = guided(8, 3);
  o.threads = 1;
  const Film one = render_text(kGap, "tests/scenes", o);
  o.threads = 3, o.tile_size = 5;
  expect_same_bits(one, render_text(kGap, "tests/scenes", o));
  EXPECT_GT(one.total(8, 12).indirect[1], 0.0);
}

std::optional<PreparedRender> prepare(const RenderOverrides& o) {
  Diagnostics diagnostics;
  auto prepared =
      prepare_render(read_pbrt_text(kGap, "test", source_path("tests/scenes"), diagnostics), o, diagnostics);
  EXPECT_TRUE(prepared) << diagnostics.format_all();
  return prepared;
}

TEST(Guiding, SamplesAreDrawnAgainAlone) {
  auto prepared = prepare(guided(1, 4)), again = prepare(guided(1, 4));
  RenderObserver nobody;
  const FinishedRender finished = run_render(*prepared, nobody);
  for (const int x : {2, 7, 13}) {
    PathRecord record;
    ASSERT_TRUE(again->integrator->replay({x, 9, 0}, record));
    PixelSums sums;
    sums.add(record.sample);
    EXPECT_EQ(sums.indirect, finished.film.sums(x, 9, 0).indirect);
  }
}

// A hall whose whole back wall shines: light that is sampled is found by scattering as well, so that a wrong density
// shows. False alarms: in one of 10^4 seeds, as the level says; none in 100 seeds.
TEST(StatisticalGuiding, WeighsWithTheDensityOfBoth) {
  const std::string hall = R"(
LookAt 0 1 1.9  0 1 0  0 1 0
Camera "perspective" "float fov" 70
Film "rgb" "integer xresolution" 16 "integer yresolution" 16
Integrator "path" "integer maxdepth" 6
WorldBegin
Material "diffuse" "rgb reflectance" [.8 .7 .6]
Shape "trianglemesh" "point3 P" [-2 0 -2 2 0 -2 2 0 2 -2 0 2  -2 2 -2 2 2 -2 2 2 2 -2 2 2]
  "integer indices" [0 2 1 0 3 2  4 5 6 4 6 7  3 7 6 3 6 2  0 4 7 0 7 3  1 2 6 1 6 5]
AreaLightSource "diffuse" "rgb L" [2 2 2]
Shape "trianglemesh" "point3 P" [-2 0 -2 2 0 -2 2 2 -2 -2 2 -2] "integer indices" [0 1 2 0 2 3]
)";
  const auto films = [&](const TestRun& run) {
    RenderOverrides plain = guided(256 * run.more, 300 + run.fresh_seeds, 16);
    plain.set = {};
    return std::pair(render_text(hall, "tests/scenes", plain),
                     render_text(hall, "tests/scenes", guided(256 * run.more, 301 + run.fresh_seeds, 16)));
  };
  expect_agreement("hall, guided", repeated_level(1e-4, 1, film_test_count(16, 16)), films);
}

// The ratio of variances at equal samples is 1.8 to 3.5 over eight seeds.
TEST(Guiding, HelpsWhereLightComesThroughAGap) {
  const auto variance = [](const RenderOverrides& o) {
    const Film film = render_text(kGap, "tests/scenes", o);
    double sum = 0;
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x) {
        const PixelSums total = film.total(x, y);
        const double mean = total.indirect[1] / total.count;
        sum += total.squares[1] / total.count - mean * mean;
      }
    return sum;
  };
  RenderOverrides plain = guided(64, 1);
  plain.set = {};
  EXPECT_GT(variance(plain) / variance(guided(64, 1)), 1.5);
}

TEST(Guiding, MemoryIsBoundedAndForecast) {
  auto prepared = prepare(guided(1, 1));
  const Scene& scene = *prepared->compiled.scene;
  IntegratorContext context;
  context.width = context.height = 16;
  GuideTraining training(scene, scene.light_sampler, {.paths = 60000, .max_depth = 1000}, context);
  EXPECT_EQ(forecast_memory(*prepared).integrator, prepared->integrator->bytes());
  EXPECT_EQ(prepared->integrator->bytes(), training.most_bytes());
  for (const uint32_t phase : {0u, 1u}) {
    training.begin(phase);
    for (size_t item = 0; item < training.work_items(phase); ++item) training.run(phase, item);
    EXPECT_LE(training.guide().bytes(), training.most_bytes());
    EXPECT_GT(training.guide().bytes(), training.most_bytes() / 8);
  }
  training.end();
  EXPECT_LT(training.guide().bytes(), training.most_bytes() / 4) << "the photons stay";
}

}  // namespace
}  // namespace etd
