// The program where memory and threads are scarce.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli_fixture.h"
#include "io/image_write.h"
#include "slow_build.h"

namespace etd {
namespace {

class CliLimits : public Cli {
 protected:
  // The memory that `info` foresees, in MiB.
  double foreseen(const std::string& arguments) const {
    const Finished info = run("info " + arguments);
    EXPECT_EQ(info.exit_code, 0) << info.err;
    const size_t at = info.out.find("together");
    return at == std::string::npos ? 0 : std::stod(info.out.substr(at + 8));
  }
};

TEST_F(CliLimits, InfoForeseesTheMemoryOfARender) {
  if (kSlowBuild) GTEST_SKIP() << "a sanitizer needs memory of its own";
  folder_.write("s.pbrt", kScene);
  const std::string outputs = " --spp 2 -o a.exr -o a.png -o a.pfm --stats a.json";
  for (const std::string options : {"", " --size 500x400", " --size 300x300 --replicates 6", " --size 3000x64"}) {
    const double foresaw = foreseen("s.pbrt" + options);
    const std::string layers = options.find("replicates") != std::string::npos ? " --replicate-layers" : "";
    const Finished done = run("render s.pbrt" + options + layers + outputs);
    ASSERT_EQ(done.exit_code, 0) << done.err;
    const auto peak = nlohmann::json::parse(text(folder_.path() / "a.json"))["peak_bytes"].get<double>() / (1 << 20);
    EXPECT_GT(foresaw, 0.9 * peak) << options;
    EXPECT_LT(foresaw, 1.1 * peak) << options;
  }
}

// It refuses before it renders, or it writes everything.
TEST_F(CliLimits, WithLittleMemoryNoRenderIsLost) {
  if (kSlowBuild) GTEST_SKIP() << "a sanitizer reserves more addresses than any limit allows";
  folder_.write("s.pbrt", kScene);
  int written = 0, refused = 0;
  const double most = 1500, least = 300;  // MiB of addresses, of which libraries take most
  for (double mib = most; mib >= least && refused < 3; mib -= 100) {
    const Finished done = run_shell("ulimit -v " + std::to_string(static_cast<int>(mib * 1024)) +
                                    "; exec \"$ETENDUE\" render s.pbrt --size 500x400 --spp 2 -o a.exr -o a.png");
    const std::string how = std::to_string(mib) + " MiB: " + done.err;
    if (done.exit_code == 0) {
      ++written;
      EXPECT_TRUE(read_layers(folder_.path() / "a.exr").image) << how;
      EXPECT_TRUE(exists("a.png")) << how;
    } else {
      ++refused;
      EXPECT_FALSE(has(done.err, "spp, error")) << how;  // nothing was rendered
      EXPECT_EQ(folder_.entries(), 1) << how;
    }
    for (const char* name : {"a.exr", "a.png"}) std::filesystem::remove(folder_.path() / name);
  }
  EXPECT_GT(written, 0);
  EXPECT_GT(refused, 0);
}

TEST_F(CliLimits, TheModuleOfImagesIsBesideTheProgramOrInItsLib) {
  namespace fs = std::filesystem;
  folder_.write("s.pbrt", kScene);
  fs::create_directories(folder_.path() / "bin");
  fs::copy_file(program_path(), folder_.path() / "bin/etendue");
  const std::string render = "exec bin/etendue render s.pbrt --size 8x8 --spp 1 -o ";
  EXPECT_EQ(run_shell(render + "a.pfm").exit_code, 0);
  const Finished missing = run_shell(render + "a.png");
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_TRUE(has(missing.err, "libetendue_images.so")) << missing.err;
  EXPECT_FALSE(exists("a.png"));
  fs::create_directories(folder_.path() / "lib/etendue");
  fs::copy_file(program_path().parent_path() / "libetendue_images.so",
                folder_.path() / "lib/etendue/libetendue_images.so");
  const Finished there = run_shell(render + "a.png");
  EXPECT_EQ(there.exit_code, 0) << there.err;
  EXPECT_TRUE(exists("a.png"));
}

TEST_F(CliLimits, FewerThreadsThanWantedChangeNothingButTheTime) {
  if (kSlowBuild) GTEST_SKIP() << "a sanitizer needs a thread of its own";
  folder_.write("s.pbrt", kScene);
  std::filesystem::permissions(folder_.path(), std::filesystem::perms::all);
  ASSERT_EQ(run("render s.pbrt --threads 1 -o a.pfm").exit_code, 0);
  // The limit counts the processes of a user, and is none for root.
  const std::string user =
      ::getuid() == 0 ? "setpriv --reuid=" + std::to_string(40000 + ::getpid() % 10000) + " --clear-groups " : "";
  if (run_shell("exec " + user + "\"$ETENDUE\" --version").exit_code != 0)
    GTEST_SKIP() << "another user may not run the program here";
  for (const int limit : {1, 2, 4, 9}) {
    const Finished done = run_shell("exec " + user + "prlimit --nproc=" + std::to_string(limit) +
                                    " \"$ETENDUE\" render s.pbrt --threads 8 -o b.pfm --preview c.pfm");
    EXPECT_EQ(done.exit_code, 0) << limit << done.err;
    EXPECT_EQ(has(done.err, "warning: the system refuses threads"), ::getuid() != 0 || limit < 16) << limit << done.err;
    EXPECT_EQ(has(done.err, "for want of a thread"), ::getuid() != 0 || limit < 2) << limit << done.err;
    for (const char* name : {"b.pfm", "c.pfm"})
      EXPECT_EQ(text(folder_.path() / name), text(folder_.path() / "a.pfm")) << limit << name;
  }
}

}  // namespace
}  // namespace etd
