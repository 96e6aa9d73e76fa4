#include "io/image_write.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <limits>

#include "core/hash.h"
#include "io/file.h"
#include "io/image.h"
#include "shared_path.h"
#include "temp_folder.h"

namespace etd {
namespace {

LayeredImage layered_crop() {
  LayeredImage image;
  image.width = 5, image.height = 3;
  image.x = 7, image.y = 4;
  image.full_width = 32, image.full_height = 16;
  image.channels = {"R", "G", "B", "direct.R", "direct.G", "direct.B", "depth.Z", "coverage.A", "stderr.R"};
  for (int i = 0; i < 5 * 3 * 9; ++i) image.pixels.push_back(static_cast<float>(i) * 1.1f - 20.0f);
  image.pixels[8] = std::numeric_limits<float>::infinity();
  image.metadata = {{"etendue:scene", std::string("a \"scene\"\nof two lines")},
                    {"etendue:seed", -7},
                    {"etendue:exposure", 0.1f},
                    {"etendue:seconds", 1.0 / 3.0}};
  return image;
}

TEST(Layers, RoundTripWithWindowsAndMetadata) {
  const TempFolder folder;
  const LayeredImage image = layered_crop();
  ASSERT_EQ(write_layers(folder.path() / "a.exr", image), "");
  EXPECT_EQ(folder.entries(), 1);
  const LayersResult result = read_layers(folder.path() / "a.exr");
  ASSERT_TRUE(result.image) << result.error;
  const LayeredImage& back = *result.image;
  EXPECT_EQ(back.width, 5);
  EXPECT_EQ(back.height, 3);
  EXPECT_EQ(back.x, 7);
  EXPECT_EQ(back.y, 4);
  EXPECT_EQ(back.full_width, 32);
  EXPECT_EQ(back.full_height, 16);
  ASSERT_EQ(back.channels.size(), image.channels.size());
  for (const std::string& channel : image.channels) EXPECT_EQ(back.plane(channel), image.plane(channel)) << channel;
  EXPECT_TRUE(back.plane("albedo.R").empty());
  for (const auto& [name, value] : image.metadata) {
    ASSERT_NE(back.find_metadata(name), nullptr) << name;
    EXPECT_EQ(*back.find_metadata(name), value) << name;
  }
  EXPECT_EQ(back.find_metadata("etendue:none"), nullptr);

  const ImageResult beauty = read_image(folder.path() / "a.exr");
  ASSERT_TRUE(beauty.image) << beauty.error;
  ASSERT_EQ(beauty.image->channels(), 3);
  EXPECT_EQ(beauty.image->width(), 32);  // the display window: a texture is the whole picture
  for (int c = 0; c < 3; ++c)
    EXPECT_EQ(beauty.image->texel(7 + 4, 4 + 2, c), image.pixels[static_cast<size_t>(14 * 9 + c)]);
}

TEST(Layers, TheOrderOfTheChannelsDoesNotMatter) {
  const TempFolder folder;
  const LayeredImage image = {{1, 1, 0, 0, 1, 1, {"B", "Z", "A", "R", "G"}, {}}, {3, 9, 4, 1, 2}};
  ASSERT_EQ(write_layers(folder.path() / "a.exr", image), "");
  const Image rgba = read_image(folder.path() / "a.exr").image.value();
  ASSERT_EQ(rgba.channels(), 4);
  for (int c = 0; c < 4; ++c) EXPECT_EQ(rgba.texel(0, 0, c), static_cast<float>(c + 1));
  const LayeredImage grey = {{1, 1, 0, 0, 1, 1, {"depth.Z"}, {}}, {9}};
  ASSERT_EQ(write_layers(folder.path() / "b.exr", grey), "");
  EXPECT_EQ(read_image(folder.path() / "b.exr").image.value().texel(0, 0, 0), 9.0f);
  const LayeredImage strange = {{1, 1, 0, 0, 1, 1, {"U", "V"}, {}}, {1, 2}};
  ASSERT_EQ(write_layers(folder.path() / "c.exr", strange), "");
  EXPECT_EQ(read_image(folder.path() / "c.exr").error, "it has the channels U, V: expected R, G, B or one channel");
}

TEST(Layers, RefuseWhatNoFileCanHold) {
  const TempFolder folder;
  const std::filesystem::path path = folder.path() / "a.exr";
  const std::string start = "cannot write " + path.string() + ": ";
  const LayeredImage good = layered_crop();
  LayeredImage image = good;
  image.pixels.pop_back();
  EXPECT_EQ(write_layers(path, image), start + "134 values were given, 135 expected");
  image = good, image.channels[3] = "R";
  EXPECT_EQ(write_layers(path, image), start + "two channels are named R");
  image = good, image.metadata.emplace_back("version", 1);
  EXPECT_EQ(write_layers(path, image), start + "metadata cannot be named version: the EXR format uses the name");
  EXPECT_EQ(write_layers(path, LayeredImage()), start + "an image cannot have 0 x 0 of 0 x 0 pixels");
  EXPECT_EQ(write_layers("a.png", good), "cannot write a.png: layers need a file that ends in .exr");
  EXPECT_EQ(folder.entries(), 0);
}

TEST(Layers, ReadTheSharedReferences) {
  const std::filesystem::path path = shared_path("scenes/pbrt/cornell-box/reference.exr");
  if (path.empty()) GTEST_SKIP() << "shared/scenes/pbrt is absent";
  const LayersResult result = read_layers(path);
  ASSERT_TRUE(result.image) << result.error;
  EXPECT_EQ(result.image->plane("G").size(), 256u * 256u);
  EXPECT_EQ(read_layers(shared_path("scenes") / "none.exr").error, "the file does not exist");
}

TEST(OutputPath, IsCheckedWithoutTouchingWhatIsThere) {
  const TempFolder folder;
  const std::filesystem::path path = folder.write("a.exr", "precious");
  EXPECT_EQ(check_output_path(path), "");
  EXPECT_EQ(read_file(path).bytes, "precious");
  for (const char* name : {"b.exr", "b.PNG", "b.jpg", "b.jpeg", "b.hdr", "b.pfm"}) {
    EXPECT_EQ(check_output_path(folder.path() / name), "") << name;
  }
  EXPECT_EQ(folder.entries(), 1);
  EXPECT_EQ(check_output_path("a.bmp"), "an image file ends in .exr, .png, .jpg, .jpeg, .hdr or .pfm");
  EXPECT_EQ(check_output_path("exr"), "an image file ends in .exr, .png, .jpg, .jpeg, .hdr or .pfm");
  const std::string base = folder.path().string();
  EXPECT_EQ(check_output_path(base + "/none/a.exr"), "the folder " + base + "/none does not exist");
  EXPECT_EQ(check_output_path(base + "/a.exr/b.exr"), base + "/a.exr is not a folder");
  std::filesystem::create_directory(folder.path() / "c.exr");
  EXPECT_EQ(check_output_path(base + "/c.exr"), base + "/c.exr is not a file that can be replaced");
}

TEST(OutputPath, UnwritableFolderIsFound) {
  if (::getuid() == 0) GTEST_SKIP() << "nothing is unwritable for root";
  const TempFolder folder;
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  EXPECT_EQ(check_output_path(folder.path() / "a.exr"),
            "cannot create a file in " + folder.path().string() + ": Permission denied");
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all);
}

// Incompressible pixels of a square image.
std::vector<float> noise_rgb(int size) {
  HashStream stream(1);
  std::vector<float> rgb(static_cast<size_t>(3 * size * size));
  for (float& value : rgb) value = stream.next_float();
  return rgb;
}

// While it lives, no file can grow beyond `bytes`, as on a full disk.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : old_handler_(::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &old_limit_);
    const rlimit limit = {bytes, old_limit_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &old_limit_);
    ::signal(SIGXFSZ, old_handler_);
  }

 private:
  rlimit old_limit_{};
  void (*old_handler_)(int);
};

TEST(OutputPath, AFailedWriteLeavesTheOldFileAndNothingElse) {
  const TempFolder folder;
  const int size = 128;
  const std::vector<float> rgb = noise_rgb(size);
  for (const char* name : {"a.exr", "a.png", "a.jpg", "a.hdr", "a.pfm"}) {
    const std::filesystem::path path = folder.write(name, "old");
    std::string error;
    {
      const FullDisk full(4096);
      error = is_layered_path(path)
                  ? write_layers(path, LayeredImage{{size, size, 0, 0, size, size, {"R", "G", "B"}, {}}, rgb})
                  : write_rgb(path, size, size, rgb);
    }
    EXPECT_EQ(error.substr(0, 13 + path.string().size()), "cannot write " + path.string()) << error;
    EXPECT_EQ(read_file(path).bytes, "old") << name;
    std::filesystem::remove(path);
    EXPECT_EQ(folder.entries(), 0) << name;
  }
}

TEST(OutputPath, RefusesWrongSizesAndEndings) {
  EXPECT_EQ(write_rgb("a.png", 2, 2, std::vector<float>(9)),
            "cannot write a.png: 9 values do not make 2 x 2 RGB pixels");
  EXPECT_EQ(write_rgb("a.gif", 1, 1, std::vector<float>(3)),
            "cannot write a.gif: an image file ends in .exr, .png, .jpg, .jpeg, .hdr or .pfm");
}

}  // namespace
}  // namespace etd
