// One scene seen by several cameras in one run: what a camera's file may say, and that each picture is, bit for bit,
// that of a run of its own, while no file of the scene is read twice.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli_fixture.h"
#include "formats/pbrt/reader.h"
#include "io/image_write.h"
#include "io/pfm.h"
#include "render/session.h"
#include "scene/compile.h"
#include "scene/scene.h"

namespace etd {
namespace {

// Meshes, images of a texture and of a light, all in files, and an object in two places.
void write_scene(const TempFolder& folder) {
  folder.write("triangle.ply",
               "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
               "property float u\nproperty float v\nelement face 1\nproperty list uchar int vertex_indices\n"
               "end_header\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n");
  std::vector<float> colours, sky;
  for (int i = 0; i < 12; ++i) colours.push_back(0.05f * static_cast<float>(i + 1));
  for (int i = 0; i < 3 * 4 * 2; ++i) sky.push_back(0.1f * static_cast<float>(i % 7 + 1));
  folder.write("colours.pfm", encode_pfm(2, 2, colours));
  folder.write("sky.pfm", encode_pfm(4, 2, sky));
  folder.write("s.pbrt", R"(
Film "rgb" "integer xresolution" 20 "integer yresolution" 14
Sampler "sobol" "integer pixelsamples" 4 "integer seed" 5
LookAt 0.3 0.2 -3  0.3 0.3 0  0 1 0
Camera "perspective" "float fov" 50
WorldBegin
LightSource "infinite" "string filename" "sky.pfm"
Texture "t" "spectrum" "imagemap" "string filename" "colours.pfm" "string filter" "trilinear"
Material "diffuse" "texture reflectance" "t"
ObjectBegin "o"
Shape "plymesh" "string filename" "triangle.ply"
ObjectEnd
ObjectInstance "o"
Translate -0.7 -0.5 1
ObjectInstance "o"
Material "dielectric"
Shape "sphere" "float radius" 0.4
)");
  folder.write("left.pbrt", "LookAt -300 20 -400  0 0 0  0 1 0 Camera \"perspective\" \"float fov\" 0.3\n");
  folder.write("right.pbrt",
               "Film \"rgb\" \"integer xresolution\" 11 \"integer yresolution\" 9 \"string filename\" \"x/r.exr\"\n"
               "Sampler \"independent\" \"integer pixelsamples\" 6\nIntegrator \"path\" \"integer maxdepth\" 2\n"
               "LookAt 1 2 3 0 0 0 0 1 0 Camera \"orthographic\"\n"
               "WorldBegin\nShape \"what stands here\" does not matter");
}

ViewDescription read_view(const TempFolder& folder, const std::string& text, Diagnostics& diagnostics) {
  const SceneDescription scene = read_pbrt(folder.path() / "s.pbrt", diagnostics);
  return read_pbrt_view(folder.write("view.pbrt", text), scene, diagnostics);
}

TEST(Views, AFileReplacesWhatItSays) {
  const TempFolder folder;
  write_scene(folder);
  Diagnostics diagnostics;
  const SceneDescription scene = read_pbrt(folder.path() / "s.pbrt", diagnostics);
  const ViewDescription left = read_pbrt_view(folder.path() / "left.pbrt", scene, diagnostics);
  EXPECT_EQ(left.camera.find("fov")->numbers, std::vector<double>{0.3});
  EXPECT_EQ(left.film.find("xresolution")->integers, std::vector<int32_t>{20});
  EXPECT_EQ(left.sampler.find("seed")->integers, std::vector<int32_t>{5});
  EXPECT_NEAR(left.camera_to_world.start.point({0, 0, 0}).x, -300, 1e-9);
  EXPECT_EQ(left.camera_file, folder.path() / "left.pbrt");
  const ViewDescription right = read_pbrt_view(folder.path() / "right.pbrt", scene, diagnostics);
  EXPECT_EQ(right.camera.model, "orthographic");
  EXPECT_EQ(right.film.find("xresolution")->integers, std::vector<int32_t>{11});
  EXPECT_EQ(right.sampler.model, "independent");
  EXPECT_EQ(right.integrator.find("maxdepth")->integers, std::vector<int32_t>{2});
  const ViewDescription seed = read_view(folder, "Option \"seed\" 9 Camera \"perspective\"", diagnostics);
  EXPECT_EQ(seed.sampler.find("seed")->integers, std::vector<int32_t>{9});
  EXPECT_EQ(seed.sampler.find("pixelsamples")->integers, std::vector<int32_t>{4});
  EXPECT_EQ(diagnostics.format_all(), "");
}

TEST(Views, SayWhatIsWrong) {
  const TempFolder folder;
  write_scene(folder);
  const auto message = [&folder](const std::string& text) {
    Diagnostics diagnostics;
    read_view(folder, text, diagnostics);
    EXPECT_TRUE(diagnostics.has_errors()) << text;
    return diagnostics.format_all();
  };
  EXPECT_TRUE(has(message("LookAt 0 0 -3 0 0 0 0 1 0"), "the file has no Camera"));
  EXPECT_TRUE(has(message("Camera \"perspective\" Shape \"sphere\""), "Shape before WorldBegin"));
  EXPECT_TRUE(has(message("AttributeBegin Camera \"perspective\""), "AttributeBegin"));
  EXPECT_TRUE(has(message("Kamera \"perspective\""), "unknown directive Kamera"));
  Diagnostics diagnostics;
  read_pbrt_view(folder.path() / "gone.pbrt", {}, diagnostics);
  EXPECT_TRUE(has(diagnostics.format_all(), "gone.pbrt")) << diagnostics.format_all();
}

std::vector<float> render_view(const SceneDescription& description, SceneFiles* files) {
  Diagnostics diagnostics;
  auto prepared = prepare_render(description, {}, diagnostics, {}, files);
  EXPECT_TRUE(prepared) << diagnostics.format_all();
  if (!prepared) return {};
  RenderObserver nobody;
  return make_layers(run_render(*prepared, nobody).film).pixels;
}

TEST(Views, ReadNoFileTwice) {
  const TempFolder folder;
  write_scene(folder);
  Diagnostics diagnostics;
  SceneDescription scene = read_pbrt(folder.path() / "s.pbrt", diagnostics);
  const ViewDescription own = scene, left = read_pbrt_view(folder.path() / "left.pbrt", own, diagnostics);
  const std::vector<float> alone = render_view(scene, nullptr);
  static_cast<ViewDescription&>(scene) = left;
  const std::vector<float> left_alone = render_view(scene, nullptr);
  static_cast<ViewDescription&>(scene) = own;
  SceneFiles files;
  EXPECT_EQ(render_view(scene, &files), alone);
  for (const char* name : {"triangle.ply", "colours.pfm", "sky.pfm"}) std::filesystem::remove(folder.path() / name);
  static_cast<ViewDescription&>(scene) = left;
  EXPECT_EQ(render_view(scene, &files), left_alone);
  EXPECT_NE(alone, left_alone);
  Diagnostics missing;
  EXPECT_FALSE(prepare_render(scene, {}, missing));
}

class CliViews : public Cli {
 protected:
  CliViews() { write_scene(folder_); }
  LayeredImage read(const std::string& name) const {
    LayersResult result = read_layers(folder_.path() / name);
    EXPECT_TRUE(result.image) << name << ": " << result.error;
    return result.image.value_or(LayeredImage());
  }
};

TEST_F(CliViews, ArePicturesOfRunsOfTheirOwn) {
  const Finished both = run("render s.pbrt --camera left.pbrt -o l.exr -o l.png --camera right.pbrt --stats t.json");
  ASSERT_EQ(both.exit_code, 0) << both.err;
  EXPECT_TRUE(has(both.err, "1/2 left.pbrt")) << both.err;
  EXPECT_TRUE(has(both.err, "2/2 right.pbrt")) << both.err;
  EXPECT_TRUE(has(both.out, "l.exr\nl.png\n1/2 left.pbrt  20x14, 4 spp")) << both.out;
  EXPECT_TRUE(has(both.out, "r.exr\n2/2 right.pbrt  11x9, 6 spp")) << both.out;
  EXPECT_TRUE(exists("l.png"));
  const nlohmann::json stats = nlohmann::json::parse(text(folder_.path() / "t.json"));
  ASSERT_EQ(stats.size(), 2u);
  EXPECT_EQ(stats[1]["spp"], 6);
  ASSERT_EQ(run("render s.pbrt --quiet -o l1.exr --camera left.pbrt").exit_code, 0);
  ASSERT_EQ(run("render s.pbrt --quiet --camera right.pbrt -o r1.exr").exit_code, 0);
  for (const auto& [a, b] : {std::pair("l.exr", "l1.exr"), std::pair("r.exr", "r1.exr")}) {
    const LayeredImage one = read(a), two = read(b);
    EXPECT_EQ(one.channels, two.channels);
    EXPECT_EQ(one.pixels, two.pixels) << a;
    for (const auto& [name, value] : one.metadata) {
      if (name == "etendue:seconds" || name == "DateTime") continue;
      ASSERT_TRUE(two.find_metadata(name)) << name;
      EXPECT_EQ(value, *two.find_metadata(name)) << name;
    }
  }
  // An image knows the camera.
  const Finished replay = run("replay r.exr --fireflies 2");
  EXPECT_EQ(replay.exit_code, 0) << replay.err;
  EXPECT_EQ(replay.err, "");
  EXPECT_FALSE(has(replay.out, "not reproduced")) << replay.out;
  EXPECT_TRUE(has(run("info s.pbrt --camera right.pbrt").out, "11x9, 6 spp"));
}

TEST_F(CliViews, AreCheckedBeforeTheFirstIsRendered) {
  folder_.write("wrong.pbrt", "Camera \"perspective\" \"float fow\" 30");
  const int files = folder_.entries();
  const Finished wrong = run("render s.pbrt --camera left.pbrt -o l.exr --camera wrong.pbrt -o w.exr");
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_TRUE(has(wrong.err, "wrong.pbrt:1:22: error: camera \"perspective\" has no parameter \"fow\"")) << wrong.err;
  const Finished early = run("render s.pbrt -o l.exr --camera left.pbrt --camera right.pbrt");
  EXPECT_EQ(early.exit_code, 2);
  EXPECT_TRUE(has(early.err, "\"l.exr\" stands before the first --camera")) << early.err;
  const Finished twice = run("render s.pbrt --camera left.pbrt -o l.exr --camera right.pbrt -o l.exr");
  EXPECT_EQ(twice.exit_code, 2);
  EXPECT_TRUE(has(twice.err, "l.exr is given twice")) << twice.err;
  EXPECT_EQ(folder_.entries(), files);
}

TEST_F(CliViews, AnInterruptKeepsWhatThereIs) {
  const pid_t pid = start(
      "render s.pbrt --preview p.png --spp 100000000 --camera left.pbrt -o l.exr --camera right.pbrt -o r.exr -o "
      "r.png");
  for (int i = 0; i < 3000 && !exists("p.png"); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  kill(pid, SIGINT);
  const Finished done = finish(pid);
  EXPECT_EQ(done.exit_code, 130) << done.err;
  EXPECT_TRUE(has(done.err, "etendue: not rendered: r.exr, r.png")) << done.err;
  EXPECT_TRUE(exists("l.exr"));
  EXPECT_FALSE(exists("r.exr"));
}

}  // namespace
}  // namespace etd
