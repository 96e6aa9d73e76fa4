#include "render/tev.h"

#include <gtest/gtest.h>

#include <thread>

#include "tev_peer.h"

namespace etd {
namespace {

TEST(TevAddress, HasThePortOfTheViewerUnlessGiven) {
  const auto shown = [](const char* text) {
    const std::optional<TevAddress> a = parse_tev_address(text);
    return a ? a->host + " " + a->port : std::string("none");
  };
  EXPECT_EQ(shown("localhost"), "localhost 14158");
  EXPECT_EQ(shown("10.0.0.7:99"), "10.0.0.7 99");
  EXPECT_EQ(shown("::1"), "::1 14158");
  EXPECT_EQ(shown("[::1]"), "::1 14158");
  EXPECT_EQ(shown("[::1]:99"), "::1 99");
  for (const char* text : {"", ":", ":99", "host:", "host:x", "host:0", "host:65536", "[::1", "[]:9", "["})
    EXPECT_EQ(shown(text), "none") << text;
}

// A crop of a larger image whose values tell their place.
LayeredImage numbered_image(int width, int height, float first) {
  LayeredImage image;
  image.width = width, image.height = height;
  image.x = 3, image.y = 5;
  image.full_width = width + 10, image.full_height = height + 7;
  image.channels = {"R", "G", "B"};
  for (size_t i = 0; i < static_cast<size_t>(width) * static_cast<size_t>(height) * 3; ++i)
    image.pixels.push_back(first + static_cast<float>(i));
  return image;
}

TEST(Tev, AnImageArrivesAsItWasSent) {
  TevPeer peer;
  peer.listen();
  std::thread serving([&peer] { peer.accept(), peer.serve(); });
  const LayeredImage last = numbered_image(500, 300, -7.5f);
  {
    TevViewer viewer({"127.0.0.1", peer.port()});
    EXPECT_EQ(viewer.error(), "");
    EXPECT_EQ(viewer.show("a name", numbered_image(500, 300, 1)), "");
    EXPECT_EQ(viewer.show("a name", last), "");
  }
  serving.join();
  EXPECT_EQ(peer.focus_grabs, 1);
  EXPECT_EQ(peer.updates, 6);  // 65536 pixels or less in each
  ASSERT_EQ(peer.images.size(), 1u);
  const TevPeerImage& image = peer.images.at("a name");
  EXPECT_EQ(image.width, 510);
  EXPECT_EQ(image.height, 307);
  for (const char* channel : {"R", "G", "B"}) {
    const std::vector<float> plane = last.plane(channel);
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        const bool inside = x >= 3 && x < 503 && y >= 5 && y < 305;
        const float expected = inside ? plane[static_cast<size_t>((y - 5) * 500 + x - 3)] : 0.0f;
        ASSERT_EQ(image.channels.at(channel)[static_cast<size_t>(y * 510 + x)], expected) << x << ' ' << y;
      }
  }
}

TEST(Tev, NobodyThereIsAMessage) {
  const TevPeer peer;  // that does not listen
  const TevViewer viewer({"127.0.0.1", peer.port()});
  EXPECT_NE(viewer.error().find("cannot reach the viewer tev at 127.0.0.1, port " + peer.port()), std::string::npos);
  EXPECT_NE(TevViewer({"no.such.host.invalid", "14158"}).error(), "");
}

TEST(Tev, AViewerThatTakesNothingDoesNotHoldTheExit) {
  TevPeer peer;
  peer.listen();
  TevViewer viewer({"127.0.0.1", peer.port()});
  ASSERT_EQ(viewer.error(), "");
  peer.accept();
  std::string problem;
  std::thread showing([&] { problem = viewer.show("a", numbered_image(2000, 1500, 1)); });
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  const auto hurried = std::chrono::steady_clock::now();
  viewer.hurry();
  showing.join();
  const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - hurried;
  EXPECT_EQ(problem, "the viewer tev at 127.0.0.1 takes no data");
  EXPECT_GT(waited.count(), 1.9);
  EXPECT_LT(waited.count(), 6.0);
}

TEST(Tev, ALostViewerIsAMessage) {
  TevPeer peer;
  peer.listen();
  TevViewer viewer({"127.0.0.1", peer.port()});
  ASSERT_EQ(viewer.error(), "");
  peer.accept();
  peer.slam();
  EXPECT_NE(viewer.show("a", numbered_image(500, 300, 1)).find("is lost"), std::string::npos);
}

}  // namespace
}  // namespace etd
