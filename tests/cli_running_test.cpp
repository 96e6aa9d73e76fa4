// What happens to the program while it renders: viewers that come and go, signals.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "cli_fixture.h"
#include "io/image_write.h"
#include "tev_peer.h"

namespace etd {
namespace {

using namespace std::chrono_literals;

class CliRunning : public Cli {};

// Waits until the process has said that it handles signals, which is the first that it does.
void wait_for_handlers(pid_t pid) {
  const auto handles = [pid](int signal_number) {
    std::ifstream status("/proc/" + std::to_string(pid) + "/status");
    for (std::string key; status >> key;)
      if (key == "SigCgt:") {
        std::string mask;
        status >> mask;
        return (std::stoull(mask, nullptr, 16) >> (signal_number - 1) & 1) != 0;
      }
    return false;
  };
  for (int i = 0; i < 30000 && !handles(SIGHUP); ++i) std::this_thread::sleep_for(1ms);
}

TEST_F(CliRunning, TheViewerReceivesTheImage) {
  folder_.write("s.pbrt", kScene);
  TevPeer peer;
  const std::string arguments = "render s.pbrt -o a.exr --preview a.png --tev 127.0.0.1:" + peer.port();
  const Finished refused = run(arguments);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(has(refused.err, "cannot reach the viewer tev at 127.0.0.1")) << refused.err;
  EXPECT_EQ(folder_.entries(), 1);

  peer.listen();
  std::thread serving([&peer] { peer.accept(), peer.serve(); });
  const Finished done = run(arguments);
  serving.join();
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(exists("a.png"));
  EXPECT_EQ(folder_.entries(), 3);
  const LayersResult read = read_layers(folder_.path() / "a.exr");
  ASSERT_TRUE(read.image) << read.error;
  EXPECT_GE(peer.updates, 2);
  ASSERT_EQ(peer.images.count("s.pbrt"), 1u);
  for (const auto& [name, plane] : peer.images["s.pbrt"].channels) EXPECT_EQ(plane, read.image->plane(name)) << name;
}

// Waits until a file of output says this; at most half a minute.
bool wait_for_text(const std::filesystem::path& path, const std::string& part) {
  for (int i = 0; i < 3000; ++i) {
    std::ifstream in(path, std::ios::binary);
    if (has({std::istreambuf_iterator<char>(in), {}}, part)) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

// Waits until the file is there; at most half a minute.
bool wait_for_file(const std::filesystem::path& path) {
  for (int i = 0; i < 3000 && !std::filesystem::exists(path); ++i) std::this_thread::sleep_for(10ms);
  return std::filesystem::exists(path);
}

TEST_F(CliRunning, ALostViewerIsOneWarning) {
  folder_.write("s.pbrt", kScene);
  TevPeer peer;
  peer.listen();
  const pid_t pid = start("render s.pbrt -o a.exr --spp 100000000 --preview now.pfm --tev 127.0.0.1:" + peer.port());
  peer.accept();
  ASSERT_TRUE(wait_for_file(folder_.path() / "now.pfm"));
  peer.slam();
  EXPECT_TRUE(wait_for_text(log_.path() / "err", "warning: the viewer tev at 127.0.0.1 is lost"));
  kill(pid, SIGINT);
  const Finished done = finish(pid);
  EXPECT_EQ(done.exit_code, 130) << done.err;
  EXPECT_EQ(done.err.find("warning"), done.err.rfind("warning")) << done.err;
  EXPECT_TRUE(exists("a.exr"));
}

// A preview is written when the first pass is done: then it renders, and a whole picture is there.
TEST_F(CliRunning, SignalsStopTheRenderAndWriteTheImage) {
  folder_.write("s.pbrt", kScene);
  for (const auto& [signal_number, code] : {std::pair(SIGINT, 130), std::pair(SIGTERM, 143), std::pair(SIGHUP, 129)}) {
    const std::string name = std::to_string(code) + ".exr", preview = std::to_string(code) + ".pfm";
    const pid_t pid = start("render s.pbrt --spp 100000000 --preview " + preview + " -o " + name);
    ASSERT_TRUE(wait_for_file(folder_.path() / preview));
    kill(pid, signal_number);
    const Finished done = finish(pid);
    EXPECT_EQ(done.exit_code, code) << done.err;
    EXPECT_TRUE(has(done.out, " spp of 100000000 (interrupted)")) << done.out;
    EXPECT_TRUE(has(done.err, "a second Ctrl-C ends at once")) << done.err;
    EXPECT_FALSE(has(done.err, "empty")) << done.err;
    const LayersResult read = read_layers(folder_.path() / name);
    ASSERT_TRUE(read.image) << read.error;
    EXPECT_GT(read.image->plane("R")[0], 0.0f);
    EXPECT_EQ(std::get<std::string>(*read.image->find_metadata("etendue:interrupted")), "true");
    EXPECT_EQ(read.image->find_metadata("etendue:empty"), nullptr);
  }
  EXPECT_EQ(folder_.entries(), 7);
}

TEST_F(CliRunning, NohupGoesOnWithoutATerminal) {
  folder_.write("s.pbrt", kScene);
  const pid_t pid =
      start_shell("trap '' HUP; exec \"$ETENDUE\" render s.pbrt --spp 100000000 --preview now.pfm -o a.exr");
  ASSERT_TRUE(wait_for_file(folder_.path() / "now.pfm"));
  kill(pid, SIGHUP);
  kill(pid, SIGTERM);  // sent second, and is the first that counts
  EXPECT_EQ(finish(pid).exit_code, 143);
  EXPECT_TRUE(exists("a.exr"));
}

// Every sample belongs to the first pass, and the progress tells when a part of it is done.
TEST_F(CliRunning, APictureStoppedInItsFirstPassSaysHowMuchOfItIsEmpty) {
  folder_.write("s.pbrt", kScene);
  const pid_t pid = start("render s.pbrt --size 1000x1000 --spp 2 --threads 1 -o a.exr --stats a.json");
  ASSERT_TRUE(wait_for_text(log_.path() / "err", " 10 % "));
  kill(pid, SIGINT);
  const Finished done = finish(pid);
  EXPECT_EQ(done.exit_code, 130);
  EXPECT_TRUE(has(done.err, "stopped within the first pass: ")) << done.err;
  const LayersResult read = read_layers(folder_.path() / "a.exr");
  ASSERT_TRUE(read.image) << read.error;
  const double empty = std::get<double>(*read.image->find_metadata("etendue:empty"));
  EXPECT_LT(empty, 0.91);
  EXPECT_TRUE(has(done.err, fmt::format("{:.1f} % of the picture is empty", 100 * empty))) << done.err;
  const std::vector<float> red = read.image->plane("R");  // the sky shines everywhere
  EXPECT_EQ(empty, static_cast<double>(std::count(red.begin(), red.end(), 0.0f)) / 1e6);
  EXPECT_GT(empty, 0.0);
}

// Reading takes a while, and handlers come before it.
TEST_F(CliRunning, ASignalWhileTheSceneIsReadEndsInWords) {
  std::string scene = kScene;
  for (int i = 0; i < 200000; ++i) scene += "Shape \"sphere\" \"float radius\" 0.001\n";
  folder_.write("s.pbrt", scene);
  folder_.write("a.exr", "old");
  for (const auto& [signal_number, code] : {std::pair(SIGINT, 130), std::pair(SIGTERM, 143), std::pair(SIGHUP, 129)}) {
    const pid_t pid = start("render s.pbrt -o a.exr --preview now.png --stats a.json");
    wait_for_handlers(pid);
    kill(pid, signal_number);
    const Finished done = finish(pid);
    EXPECT_EQ(done.exit_code, code);
    EXPECT_TRUE(has(done.err, "etendue: ended by SIG")) << done.err;
    EXPECT_EQ(text(folder_.path() / "a.exr"), "old");
    EXPECT_EQ(folder_.entries(), 2);
  }
}

// One work item is the whole of a long pass, so that stopping takes long.
TEST_F(CliRunning, ASecondCtrlCEndsAtOnce) {
  folder_.write("s.pbrt", kScene);
  folder_.write("a.exr", "old");
  for (const auto before : {300ms, 3000ms, 20000ms}) {
    const pid_t pid = start("render s.pbrt --size 1024x1024 --replicates 64 --tile 4096 --threads 1 -o a.exr");
    wait_for_handlers(pid);
    std::this_thread::sleep_for(before);
    kill(pid, SIGINT);
    const bool rendering = wait_for_text(log_.path() / "err", "etendue: ") &&
                           has(text(log_.path() / "err"), "etendue: stopping after what runs");
    if (rendering) {
      std::this_thread::sleep_for(200ms);
      kill(pid, SIGINT);
    }
    const Finished done = finish(pid);
    EXPECT_EQ(done.exit_code, 130);
    EXPECT_EQ(text(folder_.path() / "a.exr"), "old");
    EXPECT_EQ(folder_.entries(), 2);
    if (!rendering) continue;  // it was still being loaded
    EXPECT_TRUE(has(done.err, "etendue: ended by SIGINT; nothing more is written")) << done.err;
    return;
  }
  FAIL() << "the scene was never loaded";
}

}  // namespace
}  // namespace etd
