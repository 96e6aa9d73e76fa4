// What happens to the program while it renders: viewers that come and go, signals.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <thread>

#include "cli_fixture.h"
#include "io/image_write.h"
#include "tev_peer.h"

namespace etd {
namespace {

class CliRunning : public Cli {};

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

// Whether the process has said that it handles SIGINT, which it does while it renders.
bool catches_interrupts(pid_t pid) {
  std::ifstream status("/proc/" + std::to_string(pid) + "/status");
  for (std::string key; status >> key;)
    if (key == "SigCgt:") {
      std::string mask;
      status >> mask;
      return (std::stoull(mask, nullptr, 16) >> (SIGINT - 1) & 1) != 0;
    }
  return false;
}

void wait_until_it_renders(pid_t pid) {
  for (int i = 0; i < 3000 && !catches_interrupts(pid); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
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

TEST_F(CliRunning, ALostViewerIsOneWarning) {
  folder_.write("s.pbrt", kScene);
  TevPeer peer;
  peer.listen();
  const pid_t pid = start("render s.pbrt -o a.exr --spp 100000000 --tev 127.0.0.1:" + peer.port());
  peer.accept();
  wait_until_it_renders(pid);
  peer.slam();
  EXPECT_TRUE(wait_for_text(log_.path() / "err", "warning: the viewer tev at 127.0.0.1 is lost"));
  kill(pid, SIGINT);
  const Finished done = finish(pid);
  EXPECT_EQ(done.exit_code, 130) << done.err;
  EXPECT_EQ(done.err.find("warning"), done.err.rfind("warning")) << done.err;
  EXPECT_TRUE(exists("a.exr"));
}

TEST_F(CliRunning, SignalsStopTheRenderAndWriteTheImage) {
  folder_.write("s.pbrt", kScene);
  for (const auto& [signal_number, code] : {std::pair(SIGINT, 130), std::pair(SIGTERM, 143)}) {
    const std::string name = std::to_string(code) + ".exr";
    const pid_t pid = start("render s.pbrt --spp 100000000 -o " + name);
    wait_until_it_renders(pid);
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    kill(pid, signal_number);
    const Finished done = finish(pid);
    EXPECT_EQ(done.exit_code, code) << done.err;
    EXPECT_TRUE(has(done.out, " spp of 100000000 (interrupted)")) << done.out;
    const LayersResult read = read_layers(folder_.path() / name);
    ASSERT_TRUE(read.image) << read.error;
    EXPECT_GT(read.image->plane("R")[0], 0.0f);
    EXPECT_EQ(std::get<std::string>(*read.image->find_metadata("etendue:interrupted")), "true");
  }
  EXPECT_EQ(folder_.entries(), 3);
}

}  // namespace
}  // namespace etd
