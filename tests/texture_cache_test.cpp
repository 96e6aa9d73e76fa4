// Images that do not fit into memory are read in tiles, and nobody can tell from the picture.
#include "io/texture_cache.h"

#include <gtest/gtest.h>

#include <fstream>
#include <thread>

#include "core/byte_count.h"
#include "core/hash.h"
#include "render_helper.h"
#include "spectrum/srgb.h"
#include "texture_table.h"

namespace etd {
namespace {

namespace fs = std::filesystem;

std::string noise_ppm(int width, int height, int channels = 3, uint64_t seed = 1) {
  HashStream rng(seed);
  std::string bytes = (channels == 3 ? "P6 " : "P5 ") + std::to_string(width) + " " + std::to_string(height) + " 255\n";
  for (int i = 0; i < width * height * channels; ++i) bytes += static_cast<char>(rng.next_u32());
  return bytes;
}

TEST(TextureCache, LevelsComeBackAsTheyWere) {
  const TempFolder folder;
  HashStream rng(4);
  for (const int channels : {1, 3, 4})
    for (const auto kind : {TexelFormat::Kind::kByte, TexelFormat::Kind::kHalf, TexelFormat::Kind::kFloat}) {
      const auto make = [&](int w, int h, TexelFormat::Kind k) {
        const auto count = static_cast<size_t>(w * h * channels);
        std::vector<uint8_t> bytes(count);
        std::vector<uint16_t> halves(count);
        std::vector<float> floats(count);
        for (size_t i = 0; i < count; ++i) {
          floats[i] = rng.next_float() - 0.3f;
          bytes[i] = static_cast<uint8_t>(rng.next_u32());
          halves[i] = float_to_half(floats[i]);
        }
        if (k == TexelFormat::Kind::kByte) return Image(w, h, channels, bytes, ImageEncoding());
        return k == TexelFormat::Kind::kHalf ? Image(w, h, channels, halves) : Image(w, h, channels, floats);
      };
      const auto coarse = kind == TexelFormat::Kind::kByte ? TexelFormat::Kind::kHalf : kind;
      const Image levels[] = {make(130, 70, kind), make(65, 35, coarse), make(3, 1, coarse)};
      const fs::path file = folder.path() / "levels.tif";
      size_t next = 0;
      ASSERT_EQ(write_tiled_levels(file, {{}, {"one", "two"}}, [&] { return next < 3 ? &levels[next++] : nullptr; }),
                "");
      TextureCache cache(1 << 20);
      std::string error;
      const auto cached = cache.open(file, error);
      ASSERT_TRUE(cached) << error;
      ASSERT_EQ(cached->levels(), 3);
      EXPECT_EQ(cached->info().notes, (std::vector<std::string>{"one", "two"}));
      ASSERT_EQ(cached->channels(), channels);
      CachedTexels texels(*cached);
      for (int level = 0; level < 3; ++level) {
        const Image& image = levels[level];
        ASSERT_EQ(cached->width(level), image.width());
        ASSERT_EQ(cached->height(level), image.height());
        for (int y = 0; y < image.height(); ++y)
          for (int x = 0; x < image.width(); ++x) ASSERT_EQ(texels.rgba(level, x, y), image.rgba(x, y));
      }
      EXPECT_EQ(cache.read_error(), "");
    }
}

// All filters, wraps and encodings of colour and float textures.
std::vector<SpectrumSource> add_all(Textures& t) {
  std::vector<SpectrumSource> all;
  for (const char* file : {"a.ppm", "b.pgm"})
    for (const char* filter : {"point", "bilinear", "trilinear", "ewa"})
      for (const char* wrap : {"repeat", "black", "clamp", "octahedralsphere"})
        for (const bool is_float : {false, true})
          all.push_back(t.add(std::string(file) + filter + wrap,
                              use_of("imagemap", {text("filename", file), text("filter", filter), text("wrap", wrap)}),
                              is_float));
  return all;
}

void write_images(const Textures& t) {
  t.folder.write("a.ppm", noise_ppm(200, 100));
  t.folder.write("b.pgm", noise_ppm(77, 131, 1));
}

TEST(TextureCache, NoLookupCanTell) {
  Textures in_memory, in_tiles;
  write_images(in_memory);
  write_images(in_tiles);
  in_tiles.memory = {1, in_tiles.folder.path() / "cache"};
  const auto a = add_all(in_memory), b = add_all(in_tiles);
  ASSERT_FALSE(in_memory.diagnostics.has_errors() || in_tiles.diagnostics.has_errors())
      << in_tiles.diagnostics.format_all();
  EXPECT_FALSE(in_memory.table.cache);
  ASSERT_TRUE(in_tiles.table.cache);
  HashStream rng(9);
  for (int i = 0; i < 40; ++i) {
    const auto wide = [&] { return std::exp2(-10 * rng.next_float()) - 0.01f; };
    const TexCoord at{
        {4 * rng.next_float() - 2, 4 * rng.next_float() - 2}, {}, {}, {}, {}, {wide(), wide()}, {wide(), -wide()}};
    for (size_t k = 0; k < a.size(); ++k) {
      const Spectrum x = in_memory.table.eval(a[k], at, {}), y = in_tiles.table.eval(b[k], at, {});
      for (int c = 0; c < 3; ++c) ASSERT_EQ(x[c], y[c]) << k;
    }
  }
  EXPECT_EQ(in_tiles.table.cache->read_error(), "");
}

TEST(TextureCache, KeepsToItsMemory) {
  Textures t;
  t.folder.write("large.ppm", noise_ppm(1500, 1100));
  t.memory = {1 << 20, t.folder.path() / "cache"};
  const SpectrumSource s = t.add("s", use_of("imagemap", {text("filename", "large.ppm")}));
  ASSERT_FALSE(t.diagnostics.has_errors()) << t.diagnostics.format_all();
  HashStream rng(2);
  for (int i = 0; i < 3000; ++i) t.at(s, rng.next_float(), rng.next_float());
  EXPECT_GT(t.table.image_bytes(), size_t{1} << 18);
  EXPECT_LT(t.table.image_bytes(), size_t{1} << 21);
}

size_t count_files(const fs::path& folder) {
  size_t count = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder)) ++count;
  return count;
}

TEST(TextureCache, FilesAreUsedAgainUntilTheImageChanges) {
  const TempFolder folder;
  const fs::path cache = folder.path() / "deep" / "cache", image = folder.write("a.ppm", noise_ppm(80, 70));
  const auto first_value = [&] {
    Textures t;
    t.memory = {1, cache};
    const SpectrumSource s =
        t.add("s", use_of("imagemap", {text("filename", image.string()), text("filter", "point")}));
    EXPECT_FALSE(t.diagnostics.has_errors()) << t.diagnostics.format_all();
    return t.at(s, 0.001f, 0.999f)[0];
  };
  const float value = first_value();
  ASSERT_EQ(count_files(cache), 1u);
  const fs::path file = fs::directory_iterator(cache)->path();
  const auto written = fs::last_write_time(file);
  EXPECT_EQ(first_value(), value);
  EXPECT_EQ(fs::last_write_time(file), written);
  // A damaged file is made again.
  std::ofstream(file) << "not an image";
  EXPECT_EQ(first_value(), value);
  EXPECT_EQ(count_files(cache), 1u);
  // Another image of the same name has a file of its own.
  folder.write("a.ppm", noise_ppm(81, 70, 3, 99));
  EXPECT_NE(first_value(), value);
  EXPECT_EQ(count_files(cache), 2u);
}

// Whoever is last puts the same file in place of the other's.
TEST(TextureCache, TwoMayWriteAtOnce) {
  const TempFolder folder;
  const fs::path image = folder.write("a.ppm", noise_ppm(300, 200));
  const auto load = [&](float& value) {
    Textures t;
    t.memory = {1, folder.path() / "cache"};
    const SpectrumSource s = t.add("s", use_of("imagemap", {text("filename", image.string()), text("filter", "ewa")}));
    EXPECT_FALSE(t.diagnostics.has_errors()) << t.diagnostics.format_all();
    value = t.at(s, 0.4f, 0.3f)[1];
    EXPECT_EQ(t.table.cache->read_error(), "");
  };
  float a = 0, b = 1;
  std::thread other([&] { load(a); });
  load(b);
  other.join();
  EXPECT_EQ(a, b);
  EXPECT_EQ(count_files(folder.path() / "cache"), 1u);
}

TEST(TextureCache, SaysThatItCannotWrite) {
  Textures t;
  t.folder.write("a.ppm", noise_ppm(8, 8));
  t.folder.write("file", "in the way");
  t.memory = {1, t.folder.path() / "file" / "cache"};
  t.add("s", use_of("imagemap", {text("filename", "a.ppm")}));
  EXPECT_EQ(t.diagnostics.error_count(), 1);
  EXPECT_NE(t.diagnostics.format_all().find("cannot write to the texture cache"), std::string::npos);
  EXPECT_NE(t.diagnostics.format_all().find("--texture-cache"), std::string::npos);
}

// A picture with textures in tiles is, bit for bit, the one with textures in memory.
TEST(TextureCache, PicturesAreTheSame) {
  const TempFolder folder;
  folder.write("a.ppm", noise_ppm(300, 200));
  const std::string scene = R"(Film "rgb" "integer xresolution" 24 "integer yresolution" 16
Sampler "sobol" "integer pixelsamples" 4
LookAt 0 0 1  0 3 0  0 0 1
Camera "perspective" "float fov" 60
WorldBegin
LightSource "infinite"
Texture "floor" "spectrum" "imagemap" "string filename" "a.ppm" "string filter" "ewa"
Texture "bumps" "float" "imagemap" "string filename" "a.ppm" "string filter" "trilinear" "float scale" 0.1
Material "diffuse" "texture reflectance" "floor" "texture displacement" "bumps"
Shape "trianglemesh" "point3 P" [ -9 -9 0  9 -9 0  9 9 0  -9 9 0 ] "point2 uv" [ 0 0  5 0  5 5  0 5 ] "integer indices" [ 0 1 2  0 2 3 ])";
  RenderOverrides overrides;
  const std::vector<float> in_memory = picture(render_text(scene, folder.path().string(), overrides));
  overrides.texture_memory = 1;
  overrides.texture_cache = folder.path() / "cache";
  EXPECT_EQ(picture(render_text(scene, folder.path().string(), overrides)), in_memory);
  EXPECT_EQ(count_files(folder.path() / "cache"), 1u);  // the same levels for both
}

TEST(ByteCount, UnitsOfMemory) {
  EXPECT_EQ(parse_byte_count("200"), 200u);
  EXPECT_EQ(parse_byte_count("64K"), size_t{64} << 10);
  EXPECT_EQ(parse_byte_count("200M"), size_t{200} << 20);
  EXPECT_EQ(parse_byte_count("1.5GB"), size_t{3} << 29);
  EXPECT_EQ(parse_byte_count("2T"), size_t{2} << 40);
  for (const char* text : {"", "G", "-1G", "0", "0.5", "2X", "2GBB", "2 G", "1e9999", "nan", "99999999999T"})
    EXPECT_FALSE(parse_byte_count(text)) << text;
}

}  // namespace
}  // namespace etd
