#include "io/picture.h"

#include <gtest/gtest.h>

#include "temp_folder.h"

namespace etd {
namespace {

TEST(Picture, LayersAreColoursVectorsAndSingleNumbers) {
  LayeredImage image;
  image.width = image.height = 1;
  image.channels = {"G", "B", "R", "normal.Z", "normal.X", "normal.Y", "depth.Z", "a.b.R", "a.b.G", "pair.U", "pair.V"};
  image.pixels = {2, 3, 1, 6, 4, 5, 7, 8, 9, 10, 11};
  EXPECT_EQ(layer_rgb(image, "").rgb, (std::vector<float>{1, 2, 3}));
  EXPECT_EQ(layer_rgb(image, "normal").rgb, (std::vector<float>{4, 5, 6}));
  EXPECT_EQ(layer_rgb(image, "depth").rgb, (std::vector<float>{7, 7, 7}));
  for (const auto& [layer, message] :
       std::vector<std::pair<const char*, const char*>>{{"norml", "did you mean \"normal\"?"},
                                                        {"xyz", "valid: normal, depth, a.b, pair"},
                                                        {"pair", "not the channels of a picture"},
                                                        {"a.b", "not the channels of a picture"}}) {
    const LayerResult none = layer_rgb(image, layer);
    EXPECT_NE(none.error.find(message), std::string::npos) << none.error;
    EXPECT_TRUE(none.rgb.empty());
  }
  image.channels = {"Y"}, image.pixels = {5};
  EXPECT_EQ(layer_rgb(image, "").rgb, (std::vector<float>{5, 5, 5}));
}

TEST(Picture, EveryFormatHasTheChannelsOfAPicture) {
  const TempFolder folder;
  const std::vector<float> rgb = {1, 0, 0.25f, 0, 1, 0.5f};
  for (const char* name : {"a.pfm", "a.hdr", "a.png"}) {
    ASSERT_EQ(write_rgb(folder.path() / name, 2, 1, rgb), "");
    const LayersResult read = read_any_layers(folder.path() / name);
    ASSERT_TRUE(read.image) << read.error;
    EXPECT_EQ(read.image->channels, (std::vector<std::string>{"R", "G", "B"}));
    const std::vector<float> back = layer_rgb(*read.image, "").rgb;
    ASSERT_EQ(back.size(), 6u);
    for (size_t i = 0; i < 6; ++i) EXPECT_NEAR(back[i], rgb[i], 0.005f) << name << ' ' << i;
  }
  EXPECT_EQ(read_any_layers(folder.path() / "absent.png").error, "the file does not exist");
}

TEST(Picture, ACropKeepsWhatIsInside) {
  Picture p{3, 2, {}};
  for (int i = 0; i < 18; ++i) p.rgb.push_back(static_cast<float>(i));
  const Picture part = crop(p, {1, 1, 3, 2});
  EXPECT_EQ(part.width, 2);
  EXPECT_EQ(part.height, 1);
  EXPECT_EQ(part.rgb, (std::vector<float>{12, 13, 14, 15, 16, 17}));
}

}  // namespace
}  // namespace etd
