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
  const Finished done =
      run("render s.pbrt -o a.exr -o a.png --stats a.json --spp 5 --replicates 2 --seed 3 --threads 2");
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
  EXPECT_GT(stats["seconds"]["first_pass"], 0);
  EXPECT_LE(stats["seconds"]["first_pass"], stats["seconds"]["render"]);
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

}  // namespace
}  // namespace etd
