// Runs the commands that judge: `etendue verify` and `etendue diff`.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli_fixture.h"

namespace etd {
namespace {

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
  EXPECT_TRUE(agrees.exit_code == 0 || agrees.exit_code == 3) << agrees.err;  // 3: not all can be told
  const auto json = nlohmann::json::parse(agrees.out);
  EXPECT_TRUE(json["passed"].get<bool>());
  EXPECT_EQ(json["estimators"].size(), 13u);
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
