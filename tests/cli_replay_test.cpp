// Runs `etendue replay`, and what leads to it: images that say how they were made, and invalid samples.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli_fixture.h"
#include "io/image_write.h"

namespace etd {
namespace {

// A lamp so bright and close to a ball that no float can hold what arrives there.
constexpr const char* kTooBright = R"(
Film "rgb" "integer xresolution" 24 "integer yresolution" 16
Sampler "independent" "integer pixelsamples" 4
LookAt 0 0 -3  0 0 0  0 1 0
Camera "perspective" "float fov" 60
WorldBegin
LightSource "point" "rgb I" [ 1e37 1e37 1e37 ] "point3 from" [ 0 0 -1.05 ]
Shape "sphere"
)";

TEST_F(Cli, InvalidSamplesAreReportedWithTheCommandThatShowsThem) {
  folder_.write("s.pbrt", kTooBright);
  const std::string render = "render s.pbrt -o a.exr -o a.png --seed 3 --max-depth 2";
  Finished done = run(render);
  EXPECT_EQ(done.exit_code, 0);
  EXPECT_TRUE(has(done.err, " of 1536 samples are invalid (")) << done.err;
  const size_t at = done.err.find("etendue replay ");
  ASSERT_NE(at, std::string::npos) << done.err;
  const std::string command = done.err.substr(at, done.err.find('\n', at) - at);
  done = run(command.substr(std::string("etendue ").size()));
  EXPECT_EQ(done.exit_code, 0) << command << done.err;
  EXPECT_TRUE(has(done.out, "the sample is invalid: the film received black instead")) << done.out;

  std::filesystem::remove(folder_.path() / "a.exr");
  done = run(render + " --strict");
  EXPECT_EQ(done.exit_code, 3);
  EXPECT_TRUE(exists("a.exr"));
  done = run("info a.exr");
  EXPECT_EQ(done.exit_code, 0);
  EXPECT_TRUE(has(done.err, "a.exr: samples were invalid (")) << done.err;
  for (const char* part : {" infinite\n", "invalid_replay ", "--set integrator.maxdepth=2", "24x16 at 0,0 of 24x16"})
    EXPECT_TRUE(has(done.out, part)) << part << "\n" << done.out;
  folder_.write("good.pbrt", kScene);
  EXPECT_EQ(run("render good.pbrt -o good.exr --strict").exit_code, 0);
  const Finished good = run("info good.exr");
  EXPECT_EQ(good.err, "");
  EXPECT_TRUE(has(good.out, "invalid_samples           none")) << good.out;
}

TEST_F(Cli, ReplaysTheStrongestSamplesOfAnImage) {
  folder_.write("s.pbrt", kScene);
  ASSERT_EQ(run("render s.pbrt -o a.exr --seed 5 --spp 8 --threads 1 --mode naive").exit_code, 0);
  ASSERT_EQ(run("render s.pbrt -o b.exr --seed 5 --spp 8 --threads 4 --tile 5 --mode naive").exit_code, 0);
  const Finished a = run("replay a.exr --fireflies 10 --verbose"), b = run("replay b.exr --fireflies 10 --verbose");
  EXPECT_EQ(a.exit_code, 0);
  EXPECT_EQ(a.err, "");
  EXPECT_EQ(a.out, b.out);
  EXPECT_TRUE(has(a.out, " 10 ")) << a.out;
  EXPECT_FALSE(has(a.out, " 11 ")) << a.out;
  EXPECT_TRUE(has(a.out, "infinite, s.pbrt:7: radiance")) << a.out;
  EXPECT_FALSE(has(a.out, "not reproduced")) << a.out;
  const auto list = nlohmann::json::parse(run("replay a.exr --fireflies 2 --json").out);
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0]["reproduced"], true);
  EXPECT_EQ(static_cast<float>(list[0]["path"]["received"]["luminance"].get<double>()),
            list[0]["luminance"].get<float>());

  // The same sample by the scene and by the image.
  const Finished by_scene = run("replay s.pbrt --pixel 11,7 --sample 3 --seed 5 --spp 8 --mode naive");
  EXPECT_EQ(by_scene.exit_code, 0) << by_scene.err;
  EXPECT_EQ(by_scene.out, run("replay a.exr --pixel 11,7 --sample 3").out);

  folder_.write("s.pbrt", std::string(kScene) + "Translate 1 0 0 Shape \"sphere\"\n");
  const Finished changed = run("replay a.exr --fireflies 10");
  EXPECT_EQ(changed.exit_code, 0);
  EXPECT_TRUE(has(changed.err, "s.pbrt has changed since the image was written")) << changed.err;

  std::filesystem::create_directory(folder_.path() / "elsewhere");
  std::filesystem::rename(folder_.path() / "s.pbrt", folder_.path() / "elsewhere" / "s.pbrt");
  EXPECT_TRUE(has(run("replay a.exr --fireflies 1").err, "--scene says where it is now"));
  EXPECT_EQ(run("replay a.exr --fireflies 1 --scene elsewhere/s.pbrt").exit_code, 0);
  std::filesystem::rename(folder_.path() / "a.exr", folder_.path() / "elsewhere" / "a.exr");
  EXPECT_EQ(run("replay elsewhere/a.exr --fireflies 1").exit_code, 0);  // the scene beside it
}

TEST_F(Cli, LimitsHoldInARenderAndInItsReplay) {
  std::string copies = "Translate 0 0 0\nObjectBegin \"a\"\nShape \"sphere\"\nObjectEnd\nObjectBegin \"b\"\n";
  for (int i = 0; i < 8; ++i) copies += "ObjectInstance \"a\"\n";
  folder_.write("s.pbrt", kScene + copies + "ObjectEnd\nObjectInstance \"b\"\nObjectInstance \"b\"\n");
  const Finished refused = run("render s.pbrt -o a.exr --limit copies=2");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(has(refused.err, "the limit is 2; --limit copies=N raises it")) << refused.err;
  const Finished done = run("render s.pbrt -o a.exr --limit copies=900 --limit repeated=1G");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(has(run("info a.exr").out, R"(["--limit","copies=900","--limit","repeated=1G"])"))
      << run("info a.exr").out;
  EXPECT_EQ(run("replay a.exr --fireflies 1").exit_code, 0);
  // A limit of the command counts before that of the image.
  EXPECT_TRUE(has(run("replay a.exr --fireflies 1 --limit copies=2").err, "the limit is 2"));
}

TEST_F(Cli, WhatCannotBeReplayedIsSaid) {
  folder_.write("s.pbrt", kScene);
  ASSERT_EQ(run("render s.pbrt -o a.exr").exit_code, 0);
  LayeredImage strange;
  strange.width = strange.height = strange.full_width = strange.full_height = 1;
  strange.channels = {"R", "G", "B"};
  strange.pixels = {1, 2, 3};
  ASSERT_EQ(write_layers(folder_.path() / "strange.exr", strange), "");
  for (const auto& [arguments, message] : std::vector<std::pair<std::string, std::string>>{
           {"s.pbrt", "say what to replay"},
           {"s.pbrt --pixel 3,3", "--pixel and --sample belong together"},
           {"a.exr --fireflies 3 --pixel 3,3 --sample 1", "say what to replay"},
           {"s.pbrt --pixel 24,3 --sample 1", "pixel 24,3 is outside the image of 24x16 pixels"},
           {"s.pbrt --pixel 3,-1 --sample 1", "outside the image"},
           {"s.pbrt --pixel 3 --sample 1", "is not X,Y"},
           {"s.pbrt --pixel 3,3 --sample 4", "there is no sample 4: a pixel has 4, from 0 to 3"},
           {"a.exr --pixel 3,3 --sample 4", "there is no sample 4"},
           {"s.pbrt --fireflies 3", "--fireflies takes an image"},
           {"s.pbrt --pixel 3,3 --sample 1 --scene s.pbrt", "--scene is for images"},
           {"a.exr --fireflies 3 --seed 2", "an image knows the options"},
           {"strange.exr --fireflies 3", "do not say how etendue rendered it"},
           {"absent.exr --fireflies 3", "absent.exr: the file does not exist"},
           {"absent.pbrt --pixel 3,3 --sample 1", "absent.pbrt"}}) {
    const Finished done = run("replay " + arguments);
    EXPECT_EQ(done.exit_code, 2) << arguments;
    EXPECT_TRUE(has(done.err, message)) << arguments << "\n" << done.err;
    EXPECT_EQ(done.out, "") << arguments;
  }
}

}  // namespace
}  // namespace etd
