#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/hash.h"
#include "io/image.h"
#include "io/image_write.h"
#include "shared_path.h"
#include "spectrum/srgb.h"
#include "temp_folder.h"

// When a PNG ends too early, libpng jumps out of OpenImageIO's callback past the string with the error's text, which
// stays behind: a leak of theirs, on broken files only.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:ImageInput::geterror\n"; }

namespace etd {
namespace {

using Kind = ImageEncoding::Kind;

// Reads what was written, with the largest difference over all values.
void expect_round_trip(const std::string& name, float tolerance) {
  const TempFolder folder;
  const int width = 40, height = 24;  // blocks of JPEG
  // Smooth, so that JPEG can keep it, and different along both axes.
  std::vector<float> rgb;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float u = (static_cast<float>(x) + 0.5f) / width, v = (static_cast<float>(y) + 0.5f) / height;
      rgb.insert(rgb.end(), {u, v, 0.5f * u * v});
    }
  }
  ASSERT_EQ(write_rgb(folder.path() / name, width, height, rgb), "");
  EXPECT_EQ(folder.entries(), 1);
  const ImageResult result = read_image(folder.path() / name);
  ASSERT_TRUE(result.image) << result.error;
  const Image& image = *result.image;
  ASSERT_EQ(image.width(), width);
  ASSERT_EQ(image.height(), height);
  ASSERT_EQ(image.channels(), 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const float expected = rgb[static_cast<size_t>((y * width + x) * 3 + c)];
        ASSERT_NEAR(image.texel(x, y, c), expected, tolerance) << name << " " << x << " " << y << " " << c;
      }
    }
  }
}

TEST(Srgb, CurveAndInverse) {
  EXPECT_FLOAT_EQ(srgb_to_linear(0.5f), 0.21404114f);
  EXPECT_FLOAT_EQ(linear_to_srgb(0.18f), 0.46135613f);
  EXPECT_EQ(srgb_to_linear(0.0f), 0.0f);
  EXPECT_EQ(srgb_to_linear(1.0f), 1.0f);
  EXPECT_NEAR(linear_to_srgb(1.0f), 1.0f, 1e-6f);
  for (int i = 0; i < 256; ++i) {
    const float encoded = static_cast<float>(i) / 255.0f;
    EXPECT_NEAR(linear_to_srgb(srgb_to_linear(encoded)), encoded, 1e-6f);
    EXPECT_EQ(linear_to_srgb8(srgb_to_linear(encoded)), i);
  }
  EXPECT_EQ(linear_to_srgb8(-1.0f), 0);
  EXPECT_EQ(linear_to_srgb8(std::nanf("")), 0);
  EXPECT_EQ(linear_to_srgb8(std::numeric_limits<float>::infinity()), 255);
}

TEST(Image, RoundTrips) {
  expect_round_trip("a.pfm", 0.0f);
  expect_round_trip("a.hdr", 1.0f / 128);  // 8-bit mantissa of the largest channel
  expect_round_trip("a.png", 0.0045f);     // half a step of the curve where it is steepest
  expect_round_trip("a.PNG", 0.0045f);
  expect_round_trip("a.jpg", 0.03f);
  expect_round_trip("a.jpeg", 0.03f);
}

TEST(Image, ExposureScalesWhatIsShownAndOnlyThat) {
  const TempFolder folder;
  const std::vector<float> rgb = {0.1f, 0.2f, 4.0f};
  ASSERT_EQ(write_rgb(folder.path() / "a.png", 1, 1, rgb, 2.0f), "");
  const ImageResult png = read_image(folder.path() / "a.png");
  ASSERT_TRUE(png.image);
  EXPECT_EQ(png.image->format().kind(), TexelFormat::Kind::kByte);
  EXPECT_EQ(png.image->bytes(), 64 * 3u);  // one block
  EXPECT_NEAR(png.image->texel(0, 0, 0), 0.4f, 0.004f);
  EXPECT_NEAR(png.image->texel(0, 0, 1), 0.8f, 0.004f);
  EXPECT_EQ(png.image->texel(0, 0, 2), 1.0f);
  ASSERT_EQ(write_rgb(folder.path() / "a.pfm", 1, 1, rgb, 2.0f), "");
  EXPECT_EQ(read_image(folder.path() / "a.pfm").image.value().texel(0, 0, 2), 4.0f);
}

TEST(Image, DecodesBytesAsAsked) {
  const TempFolder folder;
  ASSERT_EQ(write_rgb(folder.path() / "a.png", 1, 1, std::vector<float>{0.2f, 0.5f, 0.9f}), "");
  const Image srgb = read_image(folder.path() / "a.png").image.value();
  const Image linear = read_image(folder.path() / "a.png", {*parse_image_encoding("linear"), ""}).image.value();
  const Image gamma = read_image(folder.path() / "a.png", {*parse_image_encoding("gamma 2.2"), ""}).image.value();
  for (int c = 0; c < 3; ++c) {
    const float encoded = linear.texel(0, 0, c);
    EXPECT_EQ(std::round(encoded * 255.0f), encoded * 255.0f);
    EXPECT_EQ(srgb.texel(0, 0, c), srgb_to_linear(encoded));
    EXPECT_EQ(gamma.texel(0, 0, c), std::pow(encoded, 2.2f));
  }
}

TEST(Image, KnowsItsEncodingsByName) {
  EXPECT_EQ(parse_image_encoding("sRGB").value().kind, Kind::kSrgb);
  EXPECT_EQ(parse_image_encoding("linear").value().kind, Kind::kLinear);
  EXPECT_EQ(parse_image_encoding("gamma 2.2").value().kind, Kind::kGamma);
  EXPECT_EQ(parse_image_encoding("gamma 2.2").value().gamma, 2.2f);
  for (const char* text :
       {"", "srgb", "gamma", "gamma ", "gamma x", "gamma 0", "gamma -1", "gamma 2.2x", "gamma inf"}) {
    EXPECT_FALSE(parse_image_encoding(text)) << text;
  }
}

TEST(Image, AlphaIsLinear) {
  const Image image(1, 1, 4, std::vector<uint8_t>{128, 0, 255, 128}, ImageEncoding{});
  EXPECT_EQ(image.texel(0, 0, 0), srgb_to_linear(128 / 255.0f));
  EXPECT_EQ(image.texel(0, 0, 3), 128 / 255.0f);
}

// A TGA of one column: types 2 (RGB) and 3 (grey), rows from the bottom unless `top_down`.
std::string tga(int type, int bits, bool top_down, std::initializer_list<int> data) {
  std::string bytes(18, '\0');
  bytes[2] = static_cast<char>(type);
  bytes[12] = 1;
  bytes[14] = static_cast<char>(static_cast<int>(data.size()) / (bits / 8));
  bytes[16] = static_cast<char>(bits);
  bytes[17] = static_cast<char>((top_down ? 0x20 : 0) | (bits == 32 ? 8 : 0));
  for (const int value : data) bytes += static_cast<char>(value);
  return bytes;
}

TEST(Image, TgaStandsUprightAndKeepsItsColoursUnderAlpha) {
  const TempFolder folder;
  const std::initializer_list<int> red_then_blue = {0, 0, 255, 255, 0, 0};  // stored as BGR
  const Image up = read_image(folder.write("up.tga", tga(2, 24, false, red_then_blue))).image.value();
  EXPECT_EQ(up.texel(0, 1, 0), 1.0f);
  EXPECT_EQ(up.texel(0, 0, 2), 1.0f);
  const Image down = read_image(folder.write("down.tga", tga(2, 24, true, red_then_blue))).image.value();
  EXPECT_EQ(down.texel(0, 0, 0), 1.0f);
  EXPECT_EQ(down.texel(0, 1, 2), 1.0f);
  const Image grey = read_image(folder.write("grey.tga", tga(3, 8, true, {255, 0}))).image.value();
  EXPECT_EQ(grey.channels(), 1);
  EXPECT_EQ(grey.texel(0, 0, 0), 1.0f);
  const ImageOptions linear = {ImageEncoding{Kind::kLinear, 1}, ""};
  const Image alpha = read_image(folder.write("alpha.tga", tga(2, 32, true, {50, 100, 200, 64})), linear).image.value();
  ASSERT_EQ(alpha.channels(), 4);
  EXPECT_FLOAT_EQ(alpha.texel(0, 0, 0), 200 / 255.0f);
  EXPECT_FLOAT_EQ(alpha.texel(0, 0, 3), 64 / 255.0f);
}

TEST(Image, PfmHasScaleBothByteOrdersAndRowsFromTheBottom) {
  const TempFolder folder;
  std::string bytes = "PF\n1 2\n-2.0\n";
  for (const float v : {1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f}) {
    bytes.append(reinterpret_cast<const char*>(&v), sizeof v);
  }
  const Image rgb = read_image(folder.write("rgb.pfm", bytes)).image.value();
  EXPECT_EQ(rgb.texel(0, 0, 0), 8.0f);
  EXPECT_EQ(rgb.texel(0, 1, 2), 6.0f);
  const Image grey =
      read_image(folder.write("grey.pfm", std::string_view("Pf\n1 1\n1.0\n\x3f\xc0\0\0", 15))).image.value();
  EXPECT_EQ(grey.channels(), 1);
  EXPECT_EQ(grey.texel(0, 0, 0), 1.5f);
  for (const char* broken : {"PF\n1 1\n-1.0\n0123456789a", "P6\n1 1\n255\nabc", "PF\n0 1\n-1\n", "PF\n1 x\n-1\n",
                             "PF\n1 1\n0\n0123456789ab", "PF\n2000000000 2000000000\n-1\n0123", "PF", "PF 1 1 1"}) {
    EXPECT_FALSE(read_image(folder.write("broken.pfm", broken)).image) << broken;
  }
  EXPECT_EQ(read_image(folder.write("broken.pfm", "Pf\n2 2\n-1\n0123")).error,
            "2 x 2 pixels of 1 channels do not fit into the 4 bytes after the header");
}

TEST(Image, RadianceFilesHoldSharedExponentsInEitherDirection) {
  const TempFolder folder;
  const std::string start = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";
  const std::string pixels("\x80\x40\x20\x81\xff\x01\0\x80", 8);
  const Image down = read_image(folder.write("a.hdr", start + "-Y 2 +X 1\n" + pixels)).image.value();
  EXPECT_EQ(down.texel(0, 0, 0), 1.0f);
  EXPECT_EQ(down.texel(0, 0, 2), 0.25f);
  EXPECT_EQ(down.texel(0, 1, 0), 255.0f / 256);
  const Image up = read_image(folder.write("b.hdr", start + "+Y 2 +X 1\n" + pixels)).image.value();
  EXPECT_EQ(up.texel(0, 1, 0), 1.0f);
  EXPECT_EQ(up.texel(0, 0, 0), 255.0f / 256);
}

// Tags of a baseline TIFF with one strip of `data` behind the directory.
std::string tiff(int bits, int samples, int photometric, int width, const std::string& data) {
  std::string out("II*\0\x08\0\0\0", 8);
  const auto add16 = [&out](int v) { out.append({static_cast<char>(v & 255), static_cast<char>(v >> 8 & 255)}); };
  const int tags[][2] = {{256, width},   {257, 1},           {258, bits},
                         {259, 1},       {262, photometric}, {273, 8 + 2 + 120 + 4},
                         {277, samples}, {278, 1},           {279, static_cast<int>(data.size())},
                         {284, 1}};
  add16(10);
  for (const auto& [tag, value] : tags) {
    add16(tag), add16(3), add16(1), add16(0), add16(value), add16(0);
  }
  add16(0), add16(0);
  return out + data;
}

TEST(Image, IntegersOfSixteenBitsAreDecodedToFloats) {
  const TempFolder folder;
  const std::filesystem::path path = folder.write("grey.tif", tiff(16, 1, 1, 2, std::string("\0\x80\xff\xff", 4)));
  const Image srgb = read_image(path).image.value();
  EXPECT_EQ(srgb.format().kind(), TexelFormat::Kind::kFloat);
  EXPECT_EQ(srgb.bytes(), 64 * sizeof(float));  // one block
  EXPECT_FLOAT_EQ(srgb.texel(0, 0, 0), srgb_to_linear(32768 / 65535.0f));
  EXPECT_FLOAT_EQ(srgb.texel(1, 0, 0), 1.0f);
  EXPECT_FLOAT_EQ(read_image(path, {ImageEncoding{Kind::kLinear, 1}, ""}).image.value().texel(0, 0, 0),
                  32768 / 65535.0f);
}

TEST(Image, SaysWhyItCannotRead) {
  const TempFolder folder;
  EXPECT_EQ(read_image(folder.path() / "none.png").error, "the file does not exist");
  EXPECT_EQ(read_image(folder.path()).error, "not a regular file");
  for (const char* name : {"a.png", "a.jpg", "a.exr", "a.hdr", "a.pfm", "a.tga", "a.tif", "a.txt", "a"}) {
    EXPECT_NE(read_image(folder.write(name, "this is no image at all")).error, "") << name;
    EXPECT_NE(read_image(folder.write(name, "")).error, "") << name;
  }
}

// Incompressible pixels of a square image.
std::vector<float> noise_rgb(int size) {
  HashStream stream(1);
  std::vector<float> rgb(static_cast<size_t>(3 * size * size));
  for (float& value : rgb) value = stream.next_float();
  return rgb;
}

TEST(Image, RefusesTruncatedFiles) {
  const TempFolder folder;
  const int size = 64;
  const std::vector<float> rgb = noise_rgb(size);
  for (const char* name : {"a.png", "a.jpg", "a.hdr", "a.pfm", "a.exr"}) {
    const std::filesystem::path path = folder.path() / name;
    if (is_layered_path(path)) {
      ASSERT_EQ(write_layers(path, LayeredImage{{size, size, 0, 0, size, size, {"R", "G", "B"}, {}}, rgb}), "");
    } else {
      ASSERT_EQ(write_rgb(path, size, size, rgb), "");
    }
    EXPECT_TRUE(read_image(path).image) << name;
    std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
    const ImageResult cut = read_image(path);
    EXPECT_FALSE(cut.image) << name;
    EXPECT_NE(cut.error, "") << name;
  }
}

TEST(Image, ReadsTheSharedTextures) {
  const std::filesystem::path shared = shared_path(".");
  if (shared.empty()) GTEST_SKIP() << "shared is absent";
  int images = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(shared)) {
    const std::string ending = entry.path().extension().string();
    if (ending != ".png" && ending != ".jpg" && ending != ".tga" && ending != ".hdr" && ending != ".pfm") continue;
    const ImageResult result = read_image(entry.path());
    EXPECT_TRUE(result.image) << entry.path() << ": " << result.error;
    ++images;
  }
  EXPECT_GT(images, 0);
}

}  // namespace
}  // namespace etd
