// Layers of object and material ids, and what their manifests say.
#include "film/pixel_ids.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli_fixture.h"
#include "formats/pbrt/reader.h"
#include "render/session.h"
#include "scene/scene.h"

namespace etd {
namespace {

TEST(PixelIds, AreThoseOfTheNearestSampleInAnyOrder) {
  std::vector<PixelIds> samples = {{0.5f, 0, {1, 1}}, {0.1f, 1, {2, 1}}, {0.1f, 7, {3, 1}}, {0.3f, 2, {4, 1}}};
  std::sort(samples.begin(), samples.end(), [](const auto& a, const auto& b) { return a.number < b.number; });
  do {
    PixelIds all, one, two;
    for (size_t i = 0; i < 4; ++i) all.offer(samples[i]), (i < 2 ? one : two).offer(samples[i]);
    one.offer(two);
    ASSERT_EQ(all.ids, (SurfaceIds{2, 1}));
    ASSERT_EQ(one.ids, all.ids);
  } while (std::next_permutation(samples.begin(), samples.end(),
                                 [](const auto& a, const auto& b) { return a.number < b.number; }));
}

// Four things in a row before an empty sky: a sphere, an object of two shapes twice, one that moves.
constexpr const char* kRow = R"(Film "rgb" "integer xresolution" 40 "integer yresolution" 9
LookAt 0 0 -9  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [ -5 5 -1.125 1.125 ]
WorldBegin
LightSource "infinite"
MakeNamedMaterial "red" "string type" "diffuse" "rgb reflectance" [ 1 0 0 ]
ObjectBegin "pair"
  Material "conductor"
  Shape "sphere" "float radius" 0.9
  NamedMaterial "red"
  Translate 0 0 -1
  Shape "sphere" "float radius" 0.3
ObjectEnd
AttributeBegin
  NamedMaterial "red"
  Translate -3.75 0 0
  Shape "sphere" "float radius" 0.9
AttributeEnd
AttributeBegin
  Translate -1.25 0 0
  ObjectInstance "pair"
AttributeEnd
AttributeBegin
  Translate 1.25 0 0
  ObjectInstance "pair"
AttributeEnd
Translate 3.75 0 0
ActiveTransform EndTime Translate 0 0.01 0 ActiveTransform All
Shape "sphere" "float radius" 0.9
)";

struct Layers {
  LayeredImage image;
  int width;
  uint32_t at(const char* layer, int x, int y) const {
    return static_cast<uint32_t>(image.plane(layer)[static_cast<size_t>(y * width + x)]);
  }
  std::string label(const char* layer, int x, int y) const {
    const auto& text = std::get<std::string>(*image.find_metadata(std::string("etendue:") + layer));
    return nlohmann::json::parse(text).at(std::to_string(at(layer, x, y)));
  }
};

Layers render_row(RenderOverrides overrides, const std::string& text = kRow) {
  Diagnostics diagnostics;
  overrides.ids = true;
  auto prepared = prepare_render(read_pbrt_text(text, "row", ".", diagnostics), overrides, diagnostics);
  EXPECT_TRUE(prepared) << diagnostics.format_all();
  RenderObserver nobody;
  const FinishedRender finished = run_render(*prepared, nobody);
  return {finished_image(*prepared, finished), finished.film.settings().crop.width()};
}

TEST(PixelIds, ObjectsAreShapesOfTheWorldAndInstances) {
  const Layers row = render_row({});
  // Middles and sides of the four.
  for (const auto& [x, object] : {std::pair(5, "sphere, row:17"), std::pair(15, "pair (instance), row:21"),
                                  std::pair(25, "pair (instance), row:25"), std::pair(35, "sphere, row:29")})
    for (const int dx : {-2, 0, 2}) EXPECT_EQ(row.label("id.object", x + dx, 4), object) << x << ' ' << dx;
  EXPECT_EQ(row.label("id.material", 5, 4), "red (diffuse), row:6");
  EXPECT_EQ(row.label("id.material", 15, 4), "red (diffuse), row:6");
  EXPECT_EQ(row.label("id.material", 17, 4), "conductor, row:8");
  EXPECT_EQ(row.label("id.material", 35, 4), "diffuse");  // nobody named one
  EXPECT_EQ(row.at("id.material", 35, 4), 1u);
  for (const char* layer : {"id.object", "id.material"}) EXPECT_EQ(row.at(layer, 0, 0), 0u) << layer;
  EXPECT_EQ(row.at("id.object", 10, 4), 0u);
}

// Emission makes an object part of the world; its instances stay what they were.
TEST(PixelIds, ObjectsThatShineAreInstancesToo) {
  std::string text = kRow;
  const std::string from = "ObjectBegin \"pair\"\n";
  text.replace(text.find(from), from.size(), from + "AreaLightSource \"diffuse\" ");
  const Layers row = render_row({}, text);
  EXPECT_EQ(row.label("id.object", 15, 4), "pair (instance), row:21");
  EXPECT_EQ(row.label("id.object", 27, 4), "pair (instance), row:25");
  EXPECT_EQ(row.label("id.object", 35, 4), "sphere, row:29");
}

TEST(PixelIds, DoNotDependOnThreadsTilesOrCrop) {
  RenderOverrides one;
  one.threads = 1;
  const Layers whole = render_row(one);
  RenderOverrides other;
  other.threads = 2, other.tile_size = 3;
  EXPECT_EQ(render_row(other).image.plane("id.object"), whole.image.plane("id.object"));
  other.crop = PixelBounds{7, 2, 33, 8};
  const Layers part = render_row(other);
  for (int y = 2; y < 8; ++y)
    for (int x = 7; x < 33; ++x)
      for (const char* layer : {"id.object", "id.material"})
        ASSERT_EQ(part.at(layer, x - 7, y - 2), whole.at(layer, x, y)) << x << ' ' << y;
}

TEST(PixelIds, TakeSixteenBytesOfAPixelWhereTheyAreKept) {
  FilmSettings film{.width = 10, .height = 10, .crop = {0, 0, 10, 10}};
  const size_t without = Film::bytes_for(film);
  film.ids = true;
  EXPECT_EQ(Film::bytes_for(film), without + 1600);
  film.alpha = true;
  EXPECT_EQ(Film::bytes_for(film), without + 1600 + 100 * 2 * 7 * sizeof(double));
}

// Halves hold integers up to 2048 alone.
TEST(PixelIds, AreExactInFilesOfHalves) {
  const TempFolder folder;
  LayeredImage image;
  image.width = image.full_width = 2, image.height = image.full_height = 1;
  image.channels = {"R", "id.object", "G", "id.material", "B"};
  image.pixels = {0.5f, 4099, 1e30f, 16777215, -2, 0.25f, 0, 3, 7, 1};
  image.half = true;
  ASSERT_EQ(write_layers(folder.path() / "a.exr", image), "");
  const LayersResult read = read_layers(folder.path() / "a.exr");
  ASSERT_TRUE(read.image) << read.error;
  EXPECT_EQ(read.image->plane("id.object"), (std::vector<float>{4099, 0}));
  EXPECT_EQ(read.image->plane("id.material"), (std::vector<float>{16777215, 7}));
  EXPECT_EQ(read.image->plane("R"), (std::vector<float>{0.5f, 0.25f}));
  EXPECT_EQ(read.image->plane("G"), (std::vector<float>{65504, 3}));
}

class CliIds : public Cli {};

TEST_F(CliIds, TheFileNamesThePartsOfObjMeshes) {
  folder_.write("m.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
  folder_.write("a.obj",
                "mtllib m.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nusemtl red\nf 1 2 3\nusemtl blue\nf 1 3 4\n");
  folder_.write(
      "s.pbrt",
      "LookAt 0 0 4 0 0 0 0 1 0 Camera \"perspective\" \"float fov\" 40\nFilm \"rgb\" \"integer "
      "xresolution\" 16 \"integer yresolution\" 16 \"bool savefp16\" true WorldBegin LightSource \"infinite\"\n"
      "Shape \"objmesh\" \"string filename\" \"a.obj\"\n");
  const Finished done = run("render s.pbrt --quiet --spp 4 --id-layers -o a.exr");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const Finished info = run("info a.exr");
  EXPECT_TRUE(has(info.out, R"({"1":"trianglemesh, s.pbrt:3"})")) << info.out;
  EXPECT_TRUE(has(info.out, R"({"2":"a.obj: red (diffuse), s.pbrt:3","3":"a.obj: blue (diffuse), s.pbrt:3"})"))
      << info.out;
  EXPECT_TRUE(has(info.out, "id.material id.object")) << info.out;
  ASSERT_EQ(run("render s.pbrt --quiet --spp 4 -o b.exr").exit_code, 0);
  EXPECT_FALSE(has(run("info b.exr").out, "id.")) << info.out;
}

}  // namespace
}  // namespace etd
