// Runs the program itself: exit codes, messages, files left behind.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli_fixture.h"
#include "io/image_write.h"

namespace etd {
namespace {

TEST_F(Cli, HelpTeaches) {
  for (const char* arguments : {"--help", "render --help", "tonemap --help", "diff --help", "replay --help"}) {
    const Finished done = run(arguments);
    EXPECT_EQ(done.exit_code, 0) << arguments;
    EXPECT_TRUE(has(done.out, "Usage: etendue")) << done.out;
    EXPECT_TRUE(has(done.out, "Examples:")) << done.out;
  }
  EXPECT_TRUE(has(run("--version").out, "etendue "));
}

TEST_F(Cli, WrongArgumentsExitWithTwo) {
  folder_.write("s.pbrt", kScene);
  for (const auto& [arguments, message] : std::vector<std::pair<std::string, std::string>>{
           {"", "subcommand is required"},
           {"rendr s.pbrt", "did you mean \"render\"?"},
           {"render s.pbrt --sizes 3x3", "--sizes"},
           {"render s.pbrt --size 3by3", "not WIDTHxHEIGHT"},
           {"render s.pbrt --size 65536x65536", "the film needs"},
           {"render s.pbrt --spp many", "--spp"},
           {"render s.pbrt --set integrator.mode", "not NAME=VALUE"},
           {"render s.pbrt --preview a.txt", "cannot write a.txt"},
           {"render s.pbrt -o a.png --preview ./a.png", "given twice"},
           {"render s.pbrt --tev host:port", "is not HOST or HOST:PORT"},
           {"render s.pbrt --time soon", "is no time"},
           {"render s.pbrt --error 0", "must be positive"},
           {"render s.pbrt --mode naiv", "did you mean \"naive\"?"},
           {"render s.pbrt -o a.exr -o ./a.exr", "given twice"},
           {"render s.pbrt -o a.gif", "cannot write a.gif: an image file ends in .exr"},
           {"render s.pbrt -o ''", "--output: the value is empty"},
           {"render s.pbrt --stats ''", "--stats: the value is empty"},
           {"tonemap '' a.png", "input: the value is empty"},
           {"verify scene s.pbrt -o ''", "--output: the value is empty"},
           {"render s.pbrt --stats ./s.pbrt", "the output ./s.pbrt is the scene itself"},
           {"render s.pbrt --stats /dev/null", "/dev/null is not a file that can be replaced"},
           {"render s.blend", "names no scene language that is read; it is that of Blender files"},
           {"render absent.pbrt", "absent.pbrt"},
           {"describe material difuse", "did you mean \"diffuse\"?"}}) {
    const Finished done = run(arguments);
    EXPECT_EQ(done.exit_code, 2) << arguments;
    EXPECT_TRUE(has(done.err, message)) << arguments << "\n" << done.err;
  }
  EXPECT_EQ(folder_.entries(), 1);  // the scene
}

TEST_F(Cli, RendersAllLayersAndAPicture) {
  folder_.write("s.pbrt", kScene);
  const Finished done = run("render s.pbrt -o a.exr -o a.png --stats a.json --spp 5 --seed 3 --threads 2");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  for (const char* part : {"a.exr\n", "a.png\n", "a.json\n", "24x16, 6 spp, "})
    EXPECT_TRUE(has(done.out, part)) << part;
  EXPECT_TRUE(has(done.err, "rounded up to 6"));
  EXPECT_EQ(folder_.entries(), 4);
  const LayersResult read = read_layers(folder_.path() / "a.exr");
  ASSERT_TRUE(read.image) << read.error;
  EXPECT_EQ(read.image->channels.size(), 24u);
  const MetadataValue* seed = read.image->find_metadata("etendue:seed");
  ASSERT_TRUE(seed);
  EXPECT_EQ(std::get<std::string>(*seed), "3");
  const auto stats = nlohmann::json::parse(text(folder_.path() / "a.json"));
  EXPECT_EQ(stats["paths"], 24 * 16 * 6);
  EXPECT_EQ(stats["rays"]["camera"], 24 * 16 * 6);
  EXPECT_EQ(stats["spp"], 6);
}

TEST_F(Cli, StopsWhenTheTimeIsOverOrTheErrorSmall) {
  folder_.write("s.pbrt", kScene);
  Finished done = run("render s.pbrt -o a.exr --time 0.3s");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(has(done.out, " spp (time is over), ")) << done.out;
  done = run("render s.pbrt -o b.exr --error 0.5 --time 1h");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(has(done.out, "24x16, 32 spp (error reached), ")) << done.out;
  const LayersResult read = read_layers(folder_.path() / "b.exr");
  ASSERT_TRUE(read.image) << read.error;
  EXPECT_EQ(std::get<std::string>(*read.image->find_metadata("etendue:stopped_by")), "error");
  EXPECT_TRUE(has(std::get<std::string>(*read.image->find_metadata("etendue:biased")), "adaptive stopping"));
}

TEST_F(Cli, WithoutAnOutputTheFilmNamesItInThisFolder) {
  folder_.write("s.pbrt", kScene);
  const Finished done = run("render s.pbrt --quiet");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(done.err, "");
  EXPECT_TRUE(exists("picture.exr"));
  EXPECT_EQ(folder_.entries(), 2);
}

TEST_F(Cli, TheFolderOfTheFilmIsUsedIfItIsThere) {
  folder_.write("s.pbrt", kScene);
  std::filesystem::create_directory(folder_.path() / "somewhere");
  const Finished done = run("render s.pbrt --quiet");
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(has(done.out, "somewhere/picture.exr\n")) << done.out;
  EXPECT_TRUE(exists("somewhere/picture.exr"));
  EXPECT_FALSE(exists("picture.exr"));
}

TEST_F(Cli, OptionsOfOtherRenderersAreAnsweredWithOurs) {
  folder_.write("s.pbrt", kScene);
  for (const auto& [arguments, message] : std::vector<std::pair<std::string, std::string>>{
           {"render s.pbrt --outfile a.exr",
            "`etendue render` has no option \"--outfile\"\n  did you mean \"--output FILE\"?"},
           {"render --outfile a.exr s.pbrt", "did you mean \"--output FILE\"?"},
           {"render s.pbrt -outfile a.exr", "did you mean \"--output FILE\"?"},
           {"render s.pbrt --samples 64", "did you mean \"--spp N\"?"},
           {"render --samples=64 s.pbrt", "has no option \"--samples\""},
           {"render s.pbrt --width 640 --height 360",
            "has no option \"--height\"\n  did you mean \"--size WIDTHxHEIGHT\"?"},
           {"render s.pbrt +W640 +H480", "\"+W640\"\n  did you mean \"--size WIDTHxHEIGHT\"?"},
           {"render s.pbrt --nthreads 4", "did you mean \"--threads N\"?"},
           {"render s.pbrt -j4", "did you mean \"--threads N\"?"},
           {"render s.pbrt --cropwindow 0,1,0,1", "did you mean \"--crop x0,x1,y0,y1\"?"},
           {"render s.pbrt --max-bounces 3", "did you mean \"--max-depth N\"?"},
           {"render s.pbrt --gpu", "rendering runs on the processor"},
           {"render s.pbrt -size 640x360", "did you mean \"--size\"?"},
           {"render s.pbrt --fireflies 3", "it is an option of `etendue replay`"},
           {"render s.pbrt --sede 3", "did you mean \"--seed\"?"},
           {"info s.pbrt --nthreads 3", "did you mean \"--threads N\" of `etendue "},
           {"verify scene s.pbrt --outfile a",
            "`etendue verify scene` has no option \"--outfile\"\n  did you mean \"--output"},
           {"render s.pbrt a.exr", "did you mean \"-o a.exr\"?"},
           {"--outfile a.exr s.pbrt", "a command comes first, as in `etendue render SCENE`"},
           {"s.pbrt", "did you mean \"etendue render s.pbrt\"?"}}) {
    const Finished done = run(arguments);
    EXPECT_EQ(done.exit_code, 2) << arguments;
    EXPECT_TRUE(has(done.err, message)) << arguments << "\n" << done.err;
  }
  EXPECT_EQ(folder_.entries(), 1);
}

TEST_F(Cli, OptionsThatContradictEachOtherAreAnError) {
  folder_.write("s.pbrt", kScene);
  for (const auto& [arguments, message] : std::vector<std::pair<std::string, std::string>>{
           {"--mode naive --set integrator.mode=mis",
            "--mode naive and --set integrator.mode=mis contradict each other"},
           {"--set integrator.mode=mis --mode naive", "--mode naive and --set integrator.mode=mis"},
           {"--max-depth 3 --set integrator.maxdepth=4", "--max-depth 3 and --set integrator.maxdepth=4"},
           {"--components direct --set integrator.components=all", "--components direct and"},
           {"--spp 4 --set sampler.pixelsamples=8", "--spp 4 and --set sampler.pixelsamples=8"},
           {"--seed 1 --set sampler.seed=2", "--seed 1 and --set sampler.seed=2"},
           {"--size 8x6 --set film.xresolution=9", "--size 8x6 and --set film.xresolution=9"},
           {"--crop 0,1,0,1 --set film.pixelbounds=0,2,0,2", "--crop 0,1,0,1 and --set film.pixelbounds=0,2,0,2"},
           {"--set integrator.mode=mis --set integrator.mode=naive", "--set integrator.mode=mis and --set"},
           {"--spp 4 --spp 8", "--spp"},
           {"--mode naive --mode mis", "--mode"}}) {
    const Finished done = run("render s.pbrt -o a.exr " + arguments);
    EXPECT_EQ(done.exit_code, 2) << arguments;
    EXPECT_TRUE(has(done.err, message)) << arguments << "\n" << done.err;
  }
  EXPECT_EQ(folder_.entries(), 1);
  const Finished same =
      run("render s.pbrt -o a.exr --mode naive --set integrator.mode=naive --spp 4 --set sampler.pixelsamples=4");
  EXPECT_EQ(same.exit_code, 0) << same.err;
}

TEST_F(Cli, SamplersHaveTheNamesThatScenesKnow) {
  folder_.write("s.pbrt", kScene);
  const Finished halton = run("render s.pbrt -o a.exr --sampler halton --quiet");
  EXPECT_EQ(halton.exit_code, 0) << halton.err;
  EXPECT_TRUE(has(halton.err, "note: sampler \"halton\" is rendered with \"sobol\"")) << halton.err;
  EXPECT_TRUE(has(halton.out, "4 spp")) << halton.out;
  for (const char* name : {"stratified", "pmj02bn", "zsobol", "paddedsobol"})
    EXPECT_TRUE(has(run(std::string("render s.pbrt -o a.exr --sampler ") + name).out, " 4 spp")) << name;
  const Finished wrong = run("render s.pbrt -o b.exr --sampler haltom");
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_TRUE(has(wrong.err, "did you mean \"halton\"?")) << wrong.err;
}

TEST_F(Cli, SubstitutesStandInTheImage) {
  folder_.write("s.pbrt", std::string("Integrator \"ambientocclusion\"\n") + kScene +
                              "Material \"hair\"\nShape \"sphere\" \"float radius\" 0.1\n");
  Finished done = run("render s.pbrt -o a.exr");
  EXPECT_EQ(done.exit_code, 2);
  EXPECT_TRUE(has(done.err, "error: integrator \"ambientocclusion\" is not supported yet")) << done.err;
  EXPECT_FALSE(exists("a.exr"));
  done = run("render s.pbrt -o a.exr --allow-unsupported");
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const LayersResult read = read_layers(folder_.path() / "a.exr");
  ASSERT_TRUE(read.image) << read.error;
  for (const char* key : {"etendue:substitutes", "etendue:biased"}) {
    const std::string value = std::get<std::string>(*read.image->find_metadata(key));
    EXPECT_TRUE(has(value, "integrator \"ambientocclusion\": the light of the scene by \"path\"")) << value;
    EXPECT_TRUE(has(value, "material \"hair\": a diffuse material of the same colour")) << value;
  }
  folder_.write("t.pbrt", kScene);
  ASSERT_EQ(run("render t.pbrt -o b.exr --allow-unsupported").exit_code, 0);
  const LayersResult plain = read_layers(folder_.path() / "b.exr");
  EXPECT_EQ(std::get<std::string>(*plain.image->find_metadata("etendue:substitutes")), "none");
  EXPECT_FALSE(has(std::get<std::string>(*plain.image->find_metadata("etendue:biased")), "substitutes"));
}

TEST_F(Cli, NotesArePrintedOnce) {
  folder_.write("s.pbrt", std::string("Sampler \"halton\" \"integer pixelsamples\" 3\nAccelerator \"bvh\"\n") + kScene);
  for (const char* command :
       {"render s.pbrt -o a.exr --sampler halton", "verify scene s.pbrt --spp 3", "info s.pbrt", "check s.pbrt"}) {
    const std::string err = run(command).err;
    for (const char* note : {"Accelerator is not used", "sampler \"halton\" is rendered with"}) {
      const size_t first = err.find(note);
      EXPECT_NE(first, std::string::npos) << command << err;
      EXPECT_EQ(err.find(note, first + 1), std::string::npos) << command << err;
    }
  }
}

TEST_F(Cli, UnwritableOutputsAreFoundBeforeAnythingElse) {
  for (const char* arguments : {"-o absent/a.exr", "-o a.exr --stats absent/a.json"}) {
    const Finished done = run(std::string("render no-such-scene.pbrt ") + arguments);
    EXPECT_EQ(done.exit_code, 2);
    EXPECT_TRUE(has(done.err, "cannot write absent/")) << done.err;
    EXPECT_FALSE(has(done.err, "no-such-scene")) << done.err;
  }
  EXPECT_EQ(folder_.entries(), 0);
}

TEST_F(Cli, BrokenScenesLeaveNoFileAndShowEveryProblem) {
  folder_.write("bad.pbrt", std::string(kScene) + "Material \"difuse\"\nShape \"sphere\" \"float radios\" 2\n");
  for (const char* command : {"render bad.pbrt -o a.exr --stats a.json", "check bad.pbrt", "info bad.pbrt"}) {
    const Finished done = run(command);
    EXPECT_EQ(done.exit_code, 2) << command;
    EXPECT_TRUE(has(done.err, "difuse")) << done.err;
    EXPECT_TRUE(has(done.err, "did you mean \"radius\"?")) << done.err;
    EXPECT_TRUE(has(done.err, "2 errors")) << done.err;
    EXPECT_EQ(folder_.entries(), 1);
  }
}

TEST_F(Cli, TonemapsWhatWasRendered) {
  folder_.write("s.pbrt", kScene);
  ASSERT_EQ(run("render s.pbrt -o a.exr -o a.png -o a.hdr --exposure 1.5").exit_code, 0);
  for (const char* arguments :
       {"a.exr b.png --exposure 1.5", "a.exr c.jpg --operator filmic --white-balance 3200K",
        "a.exr d.png --layer normal", "a.exr e.png --layer stderr --white-balance auto", "a.hdr f.png --exposure -2"}) {
    const Finished done = run(std::string("tonemap ") + arguments);
    EXPECT_EQ(done.exit_code, 0) << arguments << done.err;
    EXPECT_EQ(done.err, "") << arguments;
  }
  EXPECT_EQ(text(folder_.path() / "a.png"), text(folder_.path() / "b.png"));
  for (const auto& [arguments, message] : std::vector<std::pair<std::string, std::string>>{
           {"a.exr x.png --layer dirct", "did you mean \"direct\"?"},
           {"a.hdr x.png --layer direct", "the file has no layers"},
           {"a.exr x.hdr", "ends in .png, .jpg or .jpeg"},
           {"a.exr absent/x.png", "cannot write absent/x.png"},
           {"absent.exr x.png", "absent.exr: the file does not exist"},
           {"a.exr x.png --white-balance 300", "from 1500 to 25000 kelvin"},
           {"a.exr x.png --white-balance warm", "neither auto nor a temperature"},
           {"a.exr x.png --operator film", "--operator"}}) {
    const Finished done = run("tonemap " + arguments);
    EXPECT_EQ(done.exit_code, 2) << arguments;
    EXPECT_TRUE(has(done.err, message)) << arguments << "\n" << done.err;
    EXPECT_FALSE(exists("x.png"));
  }
}

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

TEST_F(Cli, CheckAndInfoOfAGoodScene) {
  folder_.write("s.pbrt", kScene);
  EXPECT_EQ(run("check s.pbrt").exit_code, 0);
  const Finished info = run("info s.pbrt --spp 32");
  EXPECT_EQ(info.exit_code, 0) << info.err;
  for (const char* part : {"24x16, 32 spp", "1 sphere", "1 diffuse", "infinite", "bounds", "film"})
    EXPECT_TRUE(has(info.out, part)) << part << "\n" << info.out;
  EXPECT_EQ(folder_.entries(), 1);
}

TEST_F(Cli, DescribeShowsModels) {
  EXPECT_TRUE(has(run("describe").out, "conductor"));
  EXPECT_TRUE(has(run("describe area-light").out, "diffuse"));
  EXPECT_TRUE(has(run("describe integrator path").out, "maxdepth"));
  EXPECT_TRUE(has(run("describe --markdown").out, "# "));
}

TEST_F(Cli, VerifyModels) {
  const Finished all = run("verify warp");
  EXPECT_EQ(all.exit_code, 0) << all.out << all.err;
  EXPECT_TRUE(has(all.out, "sample_hemisphere_cosine")) << all.out;
  const Finished one = run("verify filter triangle --samples 0.1x --json -o pictures");
  EXPECT_EQ(one.exit_code, 0) << one.err;
  EXPECT_TRUE(nlohmann::json::parse(one.out)["passed"].get<bool>());
  EXPECT_TRUE(exists("pictures/filter-triangle-weighted-samples-follow-it.png"));
  const Finished misspelt = run("verify materal");
  EXPECT_EQ(misspelt.exit_code, 2);
  EXPECT_TRUE(has(misspelt.err, "did you mean \"material\"?")) << misspelt.err;
  EXPECT_EQ(run("verify filter bocks").exit_code, 2);
  EXPECT_EQ(run("verify filter box --samples many").exit_code, 2);
}

TEST_F(Cli, VerifyScene) {
  folder_.write("s.pbrt", kScene);
  const Finished agrees = run("verify scene s.pbrt --spp 64 --json");
  EXPECT_EQ(agrees.exit_code, 0) << agrees.err;
  const auto json = nlohmann::json::parse(agrees.out);
  EXPECT_TRUE(json["passed"].get<bool>());
  EXPECT_EQ(json["estimators"].size(), 8u);
  EXPECT_TRUE(has(run("verify scene s.pbrt --spp 32").out, "next_event"));
  EXPECT_EQ(run("verify scene nowhere.pbrt").exit_code, 2);
  EXPECT_EQ(run("verify scene s.pbrt --spp 32 --time 1s").exit_code, 2);
}

TEST_F(Cli, DiffSaysSameDifferentOrUnknown) {
  folder_.write("s.pbrt", kScene);
  ASSERT_EQ(run("render s.pbrt -o a.exr -o a.png --spp 16 --seed 1 --quiet").exit_code, 0);
  ASSERT_EQ(run("render s.pbrt -o b.exr --spp 16 --seed 2 --replicates 8 --replicate-layers --quiet").exit_code, 0);
  ASSERT_EQ(run("render s.pbrt -o direct.exr --components direct --spp 16 --seed 3 --quiet").exit_code, 0);
  ASSERT_EQ(run("render s.pbrt -o small.exr --crop 0,20,0,16 --spp 16 --seed 3 --quiet").exit_code, 0);

  Finished done = run("diff a.exr b.exr --json - --html page");
  EXPECT_EQ(done.exit_code, 0) << done.out << done.err;
  const auto json = nlohmann::json::parse(done.out);
  EXPECT_EQ(json["answer"], "same");
  EXPECT_EQ(json["verdict"]["image"].size(), 3u);
  EXPECT_TRUE(json["metrics"].contains("HDR-FLIP"));
  for (const char* name : {"page/index.html", "page/a.png", "page/b.png", "page/error.png", "page/flip.png"})
    EXPECT_TRUE(exists(name)) << name;
  const std::string page = text(folder_.path() / "page/index.html");
  for (const char* part : {"No difference found", "Worst pixels", "<svg", "data:image/png;base64,iVBORw0KGgo"})
    EXPECT_TRUE(has(page, part)) << part;
  EXPECT_FALSE(has(page, "src=\"a.png\""));  // it needs no other file

  done = run("diff a.exr direct.exr --json d.json");
  EXPECT_EQ(done.exit_code, 1) << done.out;
  EXPECT_TRUE(has(done.out, "DIFFERENT"));
  EXPECT_EQ(nlohmann::json::parse(text(folder_.path() / "d.json"))["answer"], "different");
  EXPECT_EQ(run("diff a.exr a.exr").exit_code, 0);
  done = run("diff a.png a.png");
  EXPECT_EQ(done.exit_code, 0);
  EXPECT_TRUE(has(done.out, "No difference: every bit is the same")) << done.out;
  done = run("diff a.exr a.png");
  EXPECT_EQ(done.exit_code, 3);
  EXPECT_TRUE(has(done.out, "No verdict, since an error is unknown: a.png")) << done.out;
  EXPECT_EQ(run("diff a.exr b.exr --layer direct").exit_code, 3);
  EXPECT_EQ(run("diff a.exr small.exr --crop 2,18,0,16").exit_code, 0);
  EXPECT_EQ(run("diff b.exr a.exr --correlated").exit_code, 3);  // a has no replicates
  EXPECT_EQ(run("diff b.exr b.exr --correlated").exit_code, 0);
  EXPECT_EQ(run("diff a.exr --expect 7").exit_code, 1);

  for (const auto& [arguments, message] : std::vector<std::pair<std::string, std::string>>{
           {"a.exr absent.exr", "absent.exr: the file does not exist"},
           {"a.exr small.exr", "--crop 0,20,0,16 compares what both have"},
           {"a.exr b.exr --crop 0,99,0,16", "is not inside the pixels of both images"},
           {"a.exr b.exr --layer dirct", "did you mean \"direct\"?"},
           {"a.exr", "compare with a second image"},
           {"a.exr b.exr --expect 1", "compare with a second image"},
           {"a.exr b.exr --crop 1,2,3", "is not x0,x1,y0,y1"},
           {"a.exr b.exr --html a.png/x", "cannot be made"},
           {"a.exr b.exr --error-b small.exr", "the standard error has"}}) {
    done = run("diff " + arguments);
    EXPECT_EQ(done.exit_code, 2) << arguments;
    EXPECT_TRUE(has(done.err, message)) << arguments << "\n" << done.err;
  }
}

}  // namespace
}  // namespace etd
