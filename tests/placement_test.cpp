// Images do not depend on the scale of a scene (1e-3 to 1e5) or its distance from the origin (1e4 sizes).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "expect_agreement.h"

namespace etd {
namespace {

struct Placement {
  double scale;
  Vec3d sizes_away;  // distance of the origin in units of the scale
};
const Placement kPlacements[] = {{1, {0, 0, 0}},        {1e-3, {0, 0, 0}},        {1e5, {0, 0, 0}},
                                 {1, {1e4, -7e3, 5e3}}, {1e-3, {1e4, -7e3, 5e3}}, {1e5, {1e4, -7e3, 5e3}}};

// The scene under another scale and place; `world` is what follows WorldBegin.
std::string placed_scene(const Placement& p, const std::string& head, const std::string& look_at,
                         const std::string& world) {
  const double s = p.scale;
  const Vec3d t = p.sizes_away * s;
  // The current transform goes from the world to the camera: back from the place and the scale first.
  return fmt::format(
      "{0}\n{1}\nScale {2} {2} {2}\nTranslate {3} {4} {5}\nCamera \"perspective\" \"float fov\" 75\nWorldBegin\n"
      "Translate {6} {7} {8}\nScale {9} {9} {9}\n{10}\n",
      head, look_at, 1 / s, -t.x, -t.y, -t.z, t.x, t.y, t.z, s, world);
}

RenderOverrides placed_overrides(uint32_t spp, uint64_t seed) {
  RenderOverrides o;
  o.spp = spp;
  o.replicates = 32;
  o.seed = seed;
  o.tile_size = 4;
  o.features = false;
  return o;
}

// In a closed furnace every path adds up to the same, so that a single ray which leaves the box or meets the surface it
// starts on would change a pixel.
TEST(Placement, NoPathLeaksFromATurnedFurnace) {
  const std::string head =
      "Integrator \"path\" \"integer maxdepth\" 30 \"integer roulettedepth\" 100 \"string mode\" \"naive\"\n"
      "Film \"rgb\" \"integer xresolution\" 24 \"integer yresolution\" 24\nPixelFilter \"box\"";
  const std::string look_at = "LookAt 0.1 -0.2 0.15  0.7 0.5 0.4  0 0 1";
  const std::string emitter =
      "Material \"diffuse\" \"rgb reflectance\" [ 0.9 0.9 0.9 ]\n"
      "AreaLightSource \"diffuse\" \"rgb L\" [ 1 1 1 ]\nRotate 37 1 2 3\n";
  const double answer = (1 - std::pow(0.9, 31)) / (1 - 0.9);
  for (const char* shape : {"Include \"parts/box.pbrt\"", "ReverseOrientation\nShape \"sphere\" \"float radius\" 1"})
    for (const Placement& p : kPlacements) {
      const Film film =
          render_text(placed_scene(p, head, look_at, emitter + shape), "tests/scenes/closed", placed_overrides(32, 9));
      for (int y = 0; y < film.settings().height; ++y)
        for (int x = 0; x < film.settings().width; ++x)
          ASSERT_NEAR(value(film.total(x, y), {}), answer, answer * 1e-5)
              << fmt::format("{} at scale {}, {} sizes away: pixel {},{}", shape, p.scale, length(p.sizes_away), x, y);
    }
}

// What a scene file says after WorldBegin.
std::string world_of(const std::string& file) {
  std::ifstream in(source_path(file));
  const std::string text{std::istreambuf_iterator<char>(in), {}}, begin = "WorldBegin\n";
  return text.substr(text.find(begin) + begin.size());
}

// Each placement has its own random numbers: with the same ones nearly all paths would be the same.
void expect_placements_agree(const std::string& scene, const std::string& look_at, uint32_t spp) {
  const std::string head =
      "Integrator \"path\" \"integer maxdepth\" 5\n"
      "Film \"rgb\" \"integer xresolution\" 48 \"integer yresolution\" 48\nPixelFilter \"box\"";
  const std::string world = world_of("tests/scenes/agree/" + scene);
  const double level = repeated_level(1e-4, 2 * std::size(kPlacements), film_test_count(48, 48));
  const auto render_placed = [&](size_t i, const TestRun& run) {
    return render_text(placed_scene(kPlacements[i], head, look_at, world), "tests/scenes/agree",
                       placed_overrides(spp * run.more, 50 + i + run.fresh_seeds));
  };
  const Film at_home = render_placed(0, {});
  for (size_t i = 1; i < std::size(kPlacements); ++i) {
    const Placement& p = kPlacements[i];
    expect_agreement(fmt::format("{} at scale {}, {} sizes away", scene, p.scale, length(p.sizes_away)), level,
                     [&](const TestRun& run) {
                       return std::pair(run.is_first() ? at_home : render_placed(0, run), render_placed(i, run));
                     });
  }
}

TEST(SlowPlacement, GlassCaustic) {
  expect_placements_agree("glass_caustic.pbrt", "LookAt 0 -0.95 -0.2  0 0 -0.4  0 0 1", 512);
}
TEST(StatisticalPlacement, ConductorBox) {
  expect_placements_agree("conductor_box.pbrt", "LookAt 0 -0.95 -0.1  0 0 -0.2  0 0 1", 256);
}

}  // namespace
}  // namespace etd
