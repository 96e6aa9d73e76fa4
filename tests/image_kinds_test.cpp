// Image files of rare kinds: parts, layers, windows and chroma of EXR, old and turned Radiance pictures, gamma of PNG,
// and texels that are not finite. Each is read right or called unsupported.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "image_bytes.h"
#include "io/image.h"
#include "io/pfm.h"
#include "params/diagnostics.h"
#include "spectrum/srgb.h"
#include "temp_folder.h"
#include "textures/image_store.h"

namespace etd {
namespace {

using Box = std::array<int, 4>;
constexpr Box kSmall = {0, 0, 3, 1};

ExrChannel flat(const std::string& name, float value, int sampling = 1) {
  return {name, [value](int, int) { return value; }, sampling};
}
std::vector<ExrChannel> rgb(float first, const std::string& prefix = "") {
  return {flat(prefix + "R", first), flat(prefix + "G", first + 1), flat(prefix + "B", first + 2)};
}

ImageResult read_exr(const std::vector<ExrPart>& parts, const std::string& layer = "") {
  const TempFolder folder;
  return read_image(folder.write("a.exr", exr_bytes(parts)), {{}, layer});
}

void expect_first(const ImageResult& result, float r, float g, float b) {
  ASSERT_TRUE(result.image) << result.error;
  EXPECT_EQ(result.image->rgba(1, 1), (std::array<float, 4>{r, g, b, 1}));
}

TEST(ImageKinds, OfPartsThatWithColoursIsTaken) {
  const std::vector<ExrPart> depth_first = {{"depth", kSmall, kSmall, {flat("Z", 9)}, ""},
                                            {"beauty", kSmall, kSmall, rgb(1), ""}};
  const ImageResult beauty = read_exr(depth_first);
  expect_first(beauty, 1, 2, 3);
  EXPECT_EQ(beauty.notes, std::vector<std::string>{});
  expect_first(read_exr(depth_first, "beauty"), 1, 2, 3);
  expect_first(read_exr(depth_first, "depth"), 9, 9, 9);
  const ImageResult none = read_exr(depth_first, "albedo");
  EXPECT_TRUE(none.needs_layer);
  EXPECT_EQ(none.error, "it has no part or layer \"albedo\", but \"depth\" (Z), \"beauty\" (R, G, B)");

  const std::vector<ExrPart> two = {{"left", kSmall, kSmall, rgb(1), ""}, {"right", kSmall, kSmall, rgb(4), ""}};
  const ImageResult which = read_exr(two);
  EXPECT_FALSE(which.image);
  EXPECT_TRUE(which.needs_layer);
  EXPECT_EQ(which.error, "it has several parts or layers, \"left\" (R, G, B), \"right\" (R, G, B)");
  expect_first(read_exr(two, "left"), 1, 2, 3);
  expect_first(read_exr(two, "right"), 4, 5, 6);

  const std::vector<ExrPart> named = {{"a", kSmall, kSmall, {flat("Z", 9)}, ""},
                                      {"b", kSmall, kSmall, rgb(1, "diffuse."), ""}};
  expect_first(read_exr(named), 1, 2, 3);
  for (const char* name : {"b", "diffuse", "b.diffuse"}) expect_first(read_exr(named, name), 1, 2, 3);
  EXPECT_EQ(read_exr({{"a", kSmall, kSmall, {flat("Z", 9), flat("W", 8)}, ""},
                      {"b", kSmall, kSmall, {flat("U", 9), flat("V", 8)}, ""}})
                .error,
            "none of its parts and layers has R, G, B or Y, but it has \"a\" (Z, W), \"b\" (U, V)");
}

TEST(ImageKinds, OfLayersThatWithColoursIsTaken) {
  std::vector<ExrChannel> channels = rgb(1, "beauty.");
  channels.push_back(flat("depth.Z", 9));
  ExrPart part{"", kSmall, kSmall, channels, ""};
  expect_first(read_exr({part}), 1, 2, 3);
  expect_first(read_exr({part}, "depth"), 9, 9, 9);
  for (const ExrChannel& c : rgb(4, "albedo.")) part.channels.push_back(c);
  EXPECT_EQ(read_exr({part}).error, "it has several parts or layers, \"albedo\" (R, G, B), \"beauty\" (R, G, B)");
  expect_first(read_exr({part}, "albedo"), 4, 5, 6);
  for (const ExrChannel& c : rgb(7)) part.channels.push_back(c);
  expect_first(read_exr({part}), 7, 8, 9);
}

TEST(ImageKinds, LuminanceAndChromaAreColours) {
  // The colour is (0.5, 1, 0.25) in Rec. 709.
  const double y = 0.2126 * 0.5 + 0.7152 + 0.0722 * 0.25;
  const auto l = static_cast<float>(y), ry = static_cast<float>(0.5 / y - 1), by = static_cast<float>(0.25 / y - 1);
  const ImageResult result = read_exr({{"", kSmall, kSmall, {flat("Y", l), flat("RY", ry), flat("BY", by)}, ""}});
  ASSERT_TRUE(result.image) << result.error;
  EXPECT_NEAR(result.image->texel(2, 1, 0), 0.5f, 1e-5f);
  EXPECT_NEAR(result.image->texel(2, 1, 1), 1.0f, 1e-4f);
  EXPECT_NEAR(result.image->texel(2, 1, 2), 0.25f, 1e-5f);
  const std::string coarse =
      read_exr({{"", kSmall, kSmall, {flat("Y", l), flat("RY", ry, 2), flat("BY", by, 2)}, ""}}).error;
  EXPECT_NE(coarse.find("channels of lower resolution, as chroma often has, are not supported"), std::string::npos)
      << coarse;
  expect_first(read_exr({{"", kSmall, kSmall, {flat("Y", 0.5f)}, ""}}), 0.5f, 0.5f, 0.5f);
}

TEST(ImageKinds, PixelsLieWhereTheirWindowSays) {
  std::vector<ExrChannel> place;
  for (const char* name : {"R", "G", "B"})
    place.push_back({name, [](int x, int y) { return static_cast<float>(100 + 10 * y + x); }});
  const TempFolder folder;
  const struct {
    Box data, display;
    const char* note;
  } kWindows[] = {
      {{2, 1, 3, 2}, {0, 0, 7, 3}, "it has 2 x 2 of the 8 x 4 pixels of its display window, the others are black"},
      {{-1, -2, 4, 5}, {0, 0, 3, 1}, "of its 6 x 8 pixels those outside of its display window of 4 x 2 are left out"},
      {{10, 10, 12, 11}, {10, 10, 12, 11}, nullptr},
      {{-5, -5, -4, -4},
       {-6, -6, -4, -4},
       "it has 2 x 2 of the 3 x 3 pixels of its display window, the others are "
       "black"}};
  for (const auto& w : kWindows) {
    const auto path = folder.write("a.exr", exr_bytes({{"", w.data, w.display, place, ""}}));
    const ImageResult result = read_image(path);
    ASSERT_TRUE(result.image) << result.error;
    EXPECT_EQ(result.notes, w.note ? std::vector<std::string>{w.note} : std::vector<std::string>{});
    const Image& image = *result.image;
    ASSERT_EQ(image.width(), w.display[2] - w.display[0] + 1);
    ASSERT_EQ(image.height(), w.display[3] - w.display[1] + 1);
    EXPECT_EQ(image_bytes(path), static_cast<size_t>(image.width() * image.height()) * 12);
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) {
        const int px = x + w.display[0], py = y + w.display[1];
        const bool has = px >= w.data[0] && px <= w.data[2] && py >= w.data[1] && py <= w.data[3];
        EXPECT_EQ(image.texel(x, y, 1), has ? static_cast<float>(100 + 10 * py + px) : 0.0f) << px << " " << py;
      }
  }
  EXPECT_EQ(read_exr({{"", {9, 9, 9, 9}, kSmall, place, ""}}).error,
            "all of its pixels lie outside of its display window");
}

TEST(ImageKinds, OtherPrimariesAreNoted) {
  std::string bytes;
  for (const float v : {0.7347f, 0.2653f, 0.0f, 1.0f, 0.0001f, -0.077f, 0.32168f, 0.33767f}) bytes += float_bytes(v);
  const ImageResult aces =
      read_exr({{"", kSmall, kSmall, rgb(1), exr_attribute("chromaticities", "chromaticities", bytes)}});
  expect_first(aces, 1, 2, 3);
  EXPECT_EQ(aces.notes,
            std::vector<std::string>{"its chromaticities are not those of Rec. 709, but its values are taken "
                                     "for that"});
}

std::string hdr(const std::string& size, const std::string& data,
                const std::string& header = "FORMAT=32-bit_rle_rgbe\n") {
  return "#?RADIANCE\n" + header + "\n" + size + "\n" + data;
}

TEST(ImageKinds, RadiancePicturesInAllDirections) {
  const TempFolder folder;
  // Six pixels whose red tells their place in the file.
  std::string data;
  for (int i = 0; i < 6; ++i) data += std::string{static_cast<char>(16 * (i + 1)), 0, 0, static_cast<char>(136)};
  using Rows = std::vector<std::vector<float>>;
  const std::pair<const char*, Rows> kSizes[] = {
      {"-Y 2 +X 3", {{1, 2, 3}, {4, 5, 6}}}, {"+Y 2 +X 3", {{4, 5, 6}, {1, 2, 3}}},
      {"-Y 2 -X 3", {{3, 2, 1}, {6, 5, 4}}}, {"+Y 2 -X 3", {{6, 5, 4}, {3, 2, 1}}},
      {"+X 3 -Y 2", {{1, 3, 5}, {2, 4, 6}}}, {"-X 3 -Y 2", {{5, 3, 1}, {6, 4, 2}}},
      {"+X 3 +Y 2", {{2, 4, 6}, {1, 3, 5}}}, {"-X 3 +Y 2", {{6, 4, 2}, {5, 3, 1}}}};
  for (const auto& [size, rows] : kSizes) {
    const auto path = folder.write("a.hdr", hdr(size, data));
    const ImageResult result = read_image(path);
    ASSERT_TRUE(result.image) << size << result.error;
    ASSERT_EQ(result.image->width(), 3) << size;
    ASSERT_EQ(result.image->height(), 2) << size;
    EXPECT_EQ(image_bytes(path), 6u * 12);
    for (int y = 0; y < 2; ++y)
      for (int x = 0; x < 3; ++x)
        EXPECT_EQ(result.image->texel(x, y, 0), 16 * rows[static_cast<size_t>(y)][static_cast<size_t>(x)]) << size;
  }
  for (const char* size : {"-Y 2 +Y 3", "-Y 2", "Y 2 X 3", "-Y 0 +X 3", "-Y 2 +X 3 4", "-Y two +X 3", ""})
    EXPECT_NE(read_image(folder.write("b.hdr", hdr(size, data))).error.find("expected the size of a Radiance picture"),
              std::string::npos)
        << size;
}

TEST(ImageKinds, RadiancePicturesInBothCompressionsAndColourSpaces) {
  const TempFolder folder;
  const std::string pixel("\x80\x40\x20\x81", 4), other("\x40\x40\x40\x81", 4);
  // One pixel and 299 more of it: 43 and 256 times 1.
  const Image old =
      read_image(folder.write("a.hdr", hdr("-Y 2 +X 300", pixel + "\1\1\1\x2b\1\1\1\1" + other + "\1\1\1\x2b\1\1\1\1")))
          .image.value();
  for (const int x : {0, 1, 43, 44, 299}) {
    EXPECT_EQ(old.texel(x, 0, 0), 1.0f);
    EXPECT_EQ(old.texel(x, 0, 2), 0.25f);
    EXPECT_EQ(old.texel(x, 1, 0), 0.5f);
  }
  // The new one: 3 bytes and 5 times one; a picture that is wider than 8 but does not use it.
  const std::string component("\3\x10\x20\x30\x85\x40", 6), exponent("\x88\x88", 2);
  const Image packed = read_image(folder.write("b.hdr", hdr("-Y 1 +X 8", std::string("\2\2\0\x08", 4) + component +
                                                                             component + component + exponent)))
                           .image.value();
  EXPECT_EQ(packed.texel(1, 0, 1), 32.0f);
  EXPECT_EQ(packed.texel(7, 0, 2), 64.0f);
  std::string plain;
  for (int i = 0; i < 9; ++i) plain += pixel;
  EXPECT_EQ(read_image(folder.write("c.hdr", hdr("-Y 1 +X 9", plain, ""))).image.value().texel(8, 0, 0), 1.0f);
  // The white of Rec. 709 as XYZ, (0.9505, 1, 1.089) / 2.
  const Image xyz = read_image(folder.write("d.hdr", hdr("-Y 1 +X 1", std::string("\x3d\x40\x46\x81", 4),
                                                         "FORMAT=32-bit_rle_xyze\n")))
                        .image.value();
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(xyz.texel(0, 0, c), 0.5f, 0.01f);
  const ImageResult exposed = read_image(folder.write("e.hdr", hdr("-Y 1 +X 1", pixel, "EXPOSURE=2\nEXPOSURE= 1.5\n")));
  EXPECT_EQ(exposed.notes,
            std::vector<std::string>{"its values were multiplied by an EXPOSURE of 3, which is not undone"});
  EXPECT_EQ(read_image(folder.write("f.hdr", hdr("-Y 1 +X 1", pixel, "FORMAT=32-bit_rle_luv\n"))).error,
            "it is a Radiance picture of format \"32-bit_rle_luv\", known are 32-bit_rle_rgbe and 32-bit_rle_xyze");
  for (const std::string& broken :
       {hdr("-Y 2 +X 1", pixel), hdr("-Y 1 +X 3", pixel + std::string("\1\1\1\5", 4)),
        hdr("-Y 1 +X 2", std::string("\1\1\1\2", 4)), hdr("-Y 1 +X 8", std::string("\2\2\0\x09", 4) + plain),
        hdr("-Y 1 +X 8", std::string("\2\2\0\x08\x89\1", 6)), hdr("-Y 1 +X 8", std::string("\2\2\0\x08\0\0", 6))})
    EXPECT_NE(read_image(folder.write("g.hdr", broken)).error.find("is damaged or incomplete"), std::string::npos);
  EXPECT_NE(read_image(folder.write("h.hdr", hdr("-Y 100000 +X 100000", pixel))).error, "");
}

TEST(ImageKinds, PngSaysItsGamma) {
  const TempFolder folder;
  const auto gamma = [](uint32_t value) {
    std::string bytes = little(value, 4);
    std::reverse(bytes.begin(), bytes.end());
    return std::pair<std::string, std::string>("gAMA", bytes);
  };
  const float half = 128 / 255.0f;
  const std::pair<std::vector<std::pair<std::string, std::string>>, float> kFiles[] = {
      {{}, srgb_to_linear(half)},
      {{gamma(100000)}, half},
      {{gamma(45455)}, srgb_to_linear(half)},
      {{gamma(50000)}, half * half},
      {{gamma(100000), {"sRGB", std::string(1, '\0')}}, srgb_to_linear(half)}};
  for (const auto& [chunks, value] : kFiles)
    for (const int bits : {8, 16}) {
      const auto path = folder.write("a.png", png_bytes({128, 128, 128}, chunks, bits));
      const ImageResult result = read_image(path);
      ASSERT_TRUE(result.image) << result.error;
      EXPECT_NEAR(result.image->texel(0, 0, 1), value, 1e-5f) << chunks.size() << " " << bits;
      // The scene knows better.
      EXPECT_NEAR(read_image(path, {ImageEncoding{ImageEncoding::Kind::kLinear, 1}, ""}).image.value().texel(0, 0, 1),
                  half, 1e-5f);
    }
}

// Grey, with these values for texels by number.
Image grey(int width, int height, const std::vector<std::pair<size_t, float>>& texels) {
  std::vector<float> values;
  for (int i = 0; i < width * height; ++i) values.push_back(static_cast<float>(i));
  for (const auto& [i, v] : texels) values[i] = v;
  return Image(width, height, 1, values);
}

TEST(ImageKinds, TexelsThatAreNotFiniteBecomeTheMeanOfTheirNeighbours) {
  const float nan = std::nanf(""), inf = std::numeric_limits<float>::infinity();
  // 4 x 3: one in the middle, one in the corner, two that touch, and a hole whose inside has no finite neighbour.
  MendedImage m = mend_texels(grey(4, 3, {{5, nan}}));
  EXPECT_EQ(m.texels, 1u);
  EXPECT_EQ(m.x, 1);
  EXPECT_EQ(m.y, 1);
  EXPECT_EQ(m.image.texel(1, 1, 0), (0 + 1 + 2 + 4 + 6 + 8 + 9 + 10) / 8.0f);
  EXPECT_EQ(m.image.texel(2, 1, 0), 6.0f);
  m = mend_texels(grey(4, 3, {{0, inf}}));
  EXPECT_EQ(m.image.texel(0, 0, 0), (1 + 4 + 5) / 3.0f);
  m = mend_texels(grey(4, 3, {{5, -inf}, {6, nan}}));
  EXPECT_EQ(m.texels, 2u);
  EXPECT_EQ(m.image.texel(1, 1, 0), (0 + 1 + 2 + 4 + 8 + 9 + 10) / 7.0f);
  EXPECT_EQ(m.image.texel(2, 1, 0), (1 + 2 + 3 + 7 + 9 + 10 + 11) / 7.0f);
  std::vector<std::pair<size_t, float>> hole;
  for (size_t i = 1; i < 25; ++i) hole.push_back({i, nan});
  m = mend_texels(grey(5, 5, hole));
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 5; ++x) EXPECT_EQ(m.image.texel(x, y, 0), 0.0f);
  EXPECT_EQ(mend_texels(grey(4, 3, {})).texels, 0u);
  // Halves, and a texel of which one channel is broken.
  const uint16_t one = float_to_half(1.0f), two = float_to_half(2.0f), no = float_to_half(inf);
  m = mend_texels(Image(2, 1, 3, std::vector<uint16_t>{one, one, two, two, no, one}));
  EXPECT_EQ(m.image.rgba(1, 0), (std::array<float, 4>{1, 1, 2, 1}));

  const TempFolder folder;
  const auto write = [&](const char* name, const std::vector<float>& rgb, int width) {
    return folder.write(name, encode_pfm(width, 1, rgb));
  };
  const ImageResult mended = read_finite_image(write("a.pfm", {1, 1, 1, nan, 2, 2, 3, 3, 3}, 3));
  EXPECT_EQ(mended.image.value().texel(1, 0, 0), 2.0f);
  EXPECT_EQ(mended.notes,
            std::vector<std::string>{"its texel (1, 0) is not finite: it becomes the mean of its neighbours"});
  EXPECT_EQ(read_finite_image(write("b.pfm", {nan, 0, 0, 0, inf, 0}, 2)).error, "none of its texels is finite");
}

// They tell it in memory and by way of tiles, the first time and every other time.
TEST(ImageKinds, TexturesTellWhatWasNotTakenAsItStands) {
  const TempFolder folder;
  std::vector<float> values(3 * 64, 1.0f);
  values[30] = values[60] = std::nanf("");
  folder.write("a.pfm", encode_pfm(8, 8, values));
  folder.write("b.exr", exr_bytes({{"left", kSmall, kSmall, rgb(1), ""}, {"right", kSmall, kSmall, rgb(4), ""}}));
  for (const size_t limit : {size_t{1} << 30, size_t{0}, size_t{0}}) {
    Diagnostics diagnostics;
    TextureTable table;
    ImageStore store(table, folder.path(), {});
    Param a, b;
    a.strings = {"a.pfm"}, b.strings = {"b.exr"};
    const int32_t nans = store.add(a, "", "", ImageWrap::kRepeat, diagnostics);
    const int32_t right = store.add(b, "", "right", {}, diagnostics);
    const int32_t left = store.add(b, "", "left", {}, diagnostics);
    store.load({limit, folder.path() / "tiles"}, diagnostics);
    EXPECT_EQ(diagnostics.error_count(), 0) << diagnostics.format_all();
    const std::string messages = diagnostics.format_all();
    EXPECT_NE(
        messages.find("image \"a.pfm\": 2 of its texels are not finite, the first at (2, 1): they become the mean "
                      "of their neighbours"),
        std::string::npos)
        << messages;
    const auto at = [&](int32_t image) {
      return table.images[static_cast<size_t>(image)].lookup(
          {{0.3f, 0.7f}, {}, {}, ImageFilter::kPoint, ImageWrap::kRepeat, 8})[0];
    };
    EXPECT_EQ(at(nans), 1.0f);
    EXPECT_EQ(at(right), 4.0f);
    EXPECT_EQ(at(left), 1.0f);
    const int32_t which = store.add(b, "", "", {}, diagnostics);
    store.load({limit, folder.path() / "tiles"}, diagnostics);
    EXPECT_NE(which, right);
    EXPECT_NE(diagnostics.format_all().find("it has several parts or layers, \"left\" (R, G, B), \"right\" (R, G, B)"),
              std::string::npos);
    EXPECT_NE(diagnostics.format_all().find("\"string layer\" beside the file's name says which one to take"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace etd
