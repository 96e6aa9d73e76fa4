// Standard streams that take nothing: what is a message is lost, what is an answer is missed, and pictures are neither.
#include <gtest/gtest.h>

#include "cli_fixture.h"
#include "io/image_write.h"

namespace etd {
namespace {

class CliStreams : public Cli {
 protected:
  // A picture as good as any, in which no message has ended.
  void expect_picture(const std::string& name, const std::string& how) const {
    const LayersResult read = read_layers(folder_.path() / name);
    ASSERT_TRUE(read.image) << how << ": " << read.error;
    EXPECT_EQ(read.image->channels.size(), 24u) << how;
  }
};

TEST_F(CliStreams, MessagesThatCannotBeWrittenCostNoPicture) {
  folder_.write("s.pbrt", kScene);
  folder_.write("log", std::string(100000, '.'));
  for (const std::string streams :
       {"2>/dev/full", "2>&-", ">/dev/full", ">&-", ">&- 2>&-", "<&- >&- 2>&-", ">/dev/full 2>/dev/full"}) {
    const Finished done = run_shell(
        "exec \"$ETENDUE\" render s.pbrt -o a.exr --stats a.json --preview b.exr --spp 3 --replicates 2 " + streams);
    EXPECT_EQ(done.exit_code, 0) << streams << done.err;
    expect_picture("a.exr", streams);
    EXPECT_TRUE(has(text(folder_.path() / "a.json"), "\"spp\": 4")) << streams;
    for (const char* name : {"a.exr", "a.json", "b.exr"}) std::filesystem::remove(folder_.path() / name);
  }
  // A reader that goes, and a log that may not grow.
  run_shell("{ \"$ETENDUE\" render s.pbrt -o a.exr --spp 3 --replicates 2; echo $? >code; } 2>&1 | head -c 1");
  EXPECT_EQ(text(folder_.path() / "code"), "0\n");
  expect_picture("a.exr", "head");
  EXPECT_EQ(
      run_shell("ulimit -f 100; exec \"$ETENDUE\" render s.pbrt -o b.exr --spp 3 --replicates 2 2>>log").exit_code, 0);
  expect_picture("b.exr", "ulimit -f");
  EXPECT_EQ(text(folder_.path() / "log").find_first_not_of('.'), std::string::npos);
}

TEST_F(CliStreams, AnswersThatCannotBeWrittenAreFailures) {
  folder_.write("s.pbrt", kScene);
  ASSERT_EQ(run("render s.pbrt -o a.exr").exit_code, 0);
  for (const auto& [arguments, code] :
       std::vector<std::pair<std::string, int>>{{"info s.pbrt", 1},
                                                {"info a.exr", 1},
                                                {"check s.pbrt", 1},
                                                {"describe", 1},
                                                {"describe --markdown", 1},
                                                {"describe material diffuse", 1},
                                                {"replay a.exr --fireflies 2", 1},
                                                {"replay s.pbrt --pixel 1,1 --sample 1 --json", 1},
                                                {"verify filter box --samples 0.1x", 1},
                                                {"verify scene s.pbrt --size 4x4 --spp 32 --json", 1},
                                                {"diff a.exr a.exr", 2},
                                                {"--help", 1},
                                                {"render --help", 1},
                                                {"--version", 1}}) {
    const Finished full = run_shell("exec \"$ETENDUE\" " + arguments + " >/dev/full");
    EXPECT_EQ(full.exit_code, code) << arguments;
    EXPECT_EQ(full.err, "etendue: cannot write to standard output: No space left on device\n") << arguments;
  }
  const Finished closed = run_shell("exec \"$ETENDUE\" info s.pbrt >&-");
  EXPECT_EQ(closed.exit_code, 1);
  EXPECT_EQ(closed.err, "etendue: cannot write to standard output: Bad file descriptor\n");
  EXPECT_EQ(run_shell("exec \"$ETENDUE\" check s.pbrt >/dev/full 2>&-").exit_code, 1);
  // A reader that has seen enough is nothing to talk about.
  const Finished cut = run_shell("{ sleep 0.5; \"$ETENDUE\" describe; echo $? >code; } | true");
  EXPECT_EQ(text(folder_.path() / "code"), "1\n");
  EXPECT_EQ(cut.err, "");
}

}  // namespace
}  // namespace etd
