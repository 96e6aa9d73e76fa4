// The fast ways of the readers give what the slow ones give, and what is said of a scene does not depend on threads.
#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <random>

#include <fmt/format.h>

#include "core/loading.h"
#include "formats/pbrt/reader.h"
#include "io/decimal.h"
#include "mesh_text.h"
#include "ply_files.h"
#include "render/session.h"
#include "scene/scene.h"
#include "temp_folder.h"

namespace etd {
namespace {

// Whether the fast reader takes it, and then it must be what the library says.
bool is_fast(const std::string& text) {
  double fast = 0, slow = 0;
  const char* const end = text.data() + text.size();
  const char* const after = read_decimal(text.data(), end, fast);
  if (!after) return false;
  const auto parsed = std::from_chars(text.data(), end, slow);
  EXPECT_EQ(parsed.ec, std::errc()) << text;
  EXPECT_EQ(parsed.ptr, after) << text;
  EXPECT_EQ(std::bit_cast<uint64_t>(fast), std::bit_cast<uint64_t>(slow)) << text;
  EXPECT_EQ(std::bit_cast<uint64_t>(fast), std::bit_cast<uint64_t>(std::strtod(text.c_str(), nullptr))) << text;
  return true;
}

TEST(Loading, NumbersHaveTheBitsOfTheLibrary) {
  for (const char* text : {"0", "-0", "0.0", "-.5", "1.", "7e22", "1e-22", "9007199254740992", "0.1", "-0.3", "5e-1",
                           "1.E2", "3.14159274", "8.5e+09", "000.000100", "1 2", "2]", "4.5.6"})
    EXPECT_TRUE(is_fast(text)) << text;
  // These are left to the library: more digits than a double holds, powers that are not exact, and what is no number.
  for (const char* text : {"123456789012345678",
                           "9007199254740993",
                           "0.30000000000000004",
                           "1e23",
                           "1e-23",
                           "1e400",
                           "2.2250738585072011e-308",
                           "4.9e-324",
                           "1e",
                           "1e+",
                           "",
                           "-",
                           ".",
                           "-.e1",
                           "e5",
                           "inf",
                           "nan",
                           "+1",

                           ",5",
                           "12345678901234567890123"})
    EXPECT_FALSE(is_fast(text)) << text;
  // That many end halfway between two doubles: 2^53 + 1 in disguise.
  for (const char* text : {"90071992547409.93e2", "9007199254740993.0", "4503599627370497.5", "4503599627370496.5"})
    is_fast(text);
  std::mt19937_64 random(1);
  int fast = 0;
  for (int i = 0; i < 200000; ++i) {
    const double number = std::uniform_real_distribution(-2.0, 2.0)(random) * std::pow(10.0, int(random() % 30) - 15);
    const int digits = 1 + static_cast<int>(random() % 17);
    fast += is_fast(i % 3 ? fmt::format("{:.{}g}", number, digits) : fmt::format("{:.{}e}", number, digits));
  }
  EXPECT_GT(fast, 100000);
  for (const char* text : {"0", "-0", "12", "-7", "999999999", "-999999999", "007"}) {
    int32_t whole = 0, expected = 0;
    const char* const end = text + std::strlen(text);
    EXPECT_EQ(read_whole(text, end, whole), end) << text;
    std::from_chars(text, end, expected);
    EXPECT_EQ(whole, expected) << text;
  }
}

// How a binary PLY file says the same mesh.
struct Layout {
  bool big_endian = false, doubles = false;
  bool plain = true;  // with nothing that keeps the fast way from reading it
};

constexpr int kVertices = 300, kFaces = 400;

std::string ply(const Layout& layout, int wrong_face = -1, int wrong_index = 0) {
  const char* real = layout.doubles ? "double" : "float";
  std::string header = fmt::format("ply\nformat binary_{}_endian 1.0\nelement vertex {}\n",
                                   layout.big_endian ? "big" : "little", kVertices);
  for (const char* name : {"x", "y", "z"}) header += fmt::format("property {} {}\n", real, name);
  header += "property uchar red\nproperty float nx\nproperty float ny\nproperty float nz\nproperty short u\n";
  header += fmt::format("property {} v\n{}", real, layout.plain ? "" : "property list uchar int none\n");
  header += fmt::format("element face {}\nproperty short mark\nproperty list {} int vertex_indices\n", kFaces,
                        layout.plain ? "uchar" : "ushort");
  header += "property double weight\nend_header\n";
  Bytes data(layout.big_endian);
  const auto add_real = [&](double x) {
    layout.doubles ? data.add<double>({static_cast<double>(static_cast<float>(x))})
                   : data.add<float>({static_cast<float>(x)});
  };
  for (int i = 0; i < kVertices; ++i) {
    for (int k = 0; k < 3; ++k) add_real(std::sin(1.7 * i + k));
    data.add<uint8_t>({200}).add<float>({0.1f, i == 7 ? std::nanf("") : 0.2f, 1}).add<int16_t>({int16_t(-3 * i)});
    add_real(0.1 * i);
    if (!layout.plain) data.add<uint8_t>({0});
  }
  for (int i = 0; i < kFaces; ++i) {
    std::vector<int32_t> corners = {i % kVertices, (7 * i + 1) % kVertices, (11 * i + 2) % kVertices};
    if (i % 50 == 9) corners.push_back((13 * i + 5) % kVertices);
    if (i % 70 == 3) corners[1] = corners[0];
    if (i == wrong_face) corners[2] = wrong_index;
    data.add<int16_t>({-1});
    const auto length = static_cast<uint8_t>(corners.size());
    layout.plain ? data.add<uint8_t>({length}) : data.add<uint16_t>({length});
    for (const int32_t corner : corners) data.add<int32_t>({corner});
    data.add<double>({0.5});
  }
  return header + data.str();
}

TEST(Loading, ThePlainLayoutsOfPlyGiveTheSameMesh) {
  const MeshResult expected = read_mesh_text(read_ply, ply({.plain = false}));
  ASSERT_TRUE(expected.mesh) << expected.problems.at(0);
  EXPECT_GT(expected.mesh->triangles.size(), size_t{kFaces} - 10);
  for (const bool big_endian : {false, true})
    for (const bool doubles : {false, true})
      for (const bool plain : {false, true}) {
        const MeshResult result = read_mesh_text(read_ply, ply({big_endian, doubles, plain}));
        ASSERT_TRUE(result.mesh) << result.problems.at(0);
        EXPECT_EQ(result.mesh->positions, expected.mesh->positions);
        EXPECT_EQ(result.mesh->normals, expected.mesh->normals);
        EXPECT_EQ(result.mesh->uvs, expected.mesh->uvs);
        EXPECT_EQ(result.mesh->triangles, expected.mesh->triangles);
        EXPECT_EQ(result.notes.back(), expected.notes.back());
      }
}

TEST(Loading, ThePlainLayoutsOfPlySayTheSameOfWhatIsWrong) {
  for (const int index : {kVertices, -1, INT32_MIN, 2000000000})
    for (const int face : {0, 9, 123, kFaces - 1}) {
      const auto problems = [&](bool plain) {
        return read_mesh_text(read_ply, ply({.plain = plain}, face, index)).problems;
      };
      const std::string expected = fmt::format(
          "face {}: vertex index {} is out of range, the mesh has vertices 0 to {}", face, index, kVertices - 1);
      EXPECT_EQ(problems(true), std::vector<std::string>{expected});
      EXPECT_EQ(problems(false), problems(true));
    }
  // What is cut off hits the weight of the last face and its list.
  for (const size_t cut : {1, 9, 20}) {
    const auto problem = [cut](bool plain) {
      const std::string text = ply({.plain = plain});
      return read_mesh_text(read_ply, std::string_view(text).substr(0, text.size() - cut)).problems.at(0);
    };
    EXPECT_EQ(problem(true), problem(false)) << cut;
    EXPECT_EQ(problem(true).find(fmt::format("face {} of {}: ", kFaces - 1, kFaces)), 0u) << problem(true);
  }
}

TEST(Loading, ListsOfNumbersKeepTheirPlaces) {
  Diagnostics diagnostics;
  const SceneDescription scene = read_pbrt_text(
      "WorldBegin\nShape \"trianglemesh\" \"point3 P\" [ 0 0 0 # the first\n 1 0 1e400 +2 .5 0.30000000000000004\n"
      "\"float x\" [ 1 2\n  3 4x 5 ] \"integer i\" [ 1 2 3000000000 \n 4 ]\n Sphere",
      "test", ".", diagnostics);
  const std::string messages = diagnostics.format_all();
  for (const char* part : {"test:2:33: error: the list of \"point3 P\" is not closed",
                           "test:5:5: error: \"float x\" takes numbers, not 4x",
                           "test:5:30: error: \"integer i\" takes integers of 32 bits, not 3000000000",
                           "test:7:2: error: unknown directive Sphere"})
    EXPECT_NE(messages.find(part), std::string::npos) << part << "\n" << messages;
  const Param& p = *scene.shapes.at(0).use.find("P");
  EXPECT_EQ(p.numbers, (std::vector<double>{0, 0, 0, 1, 0, INFINITY, 2, .5, 0.30000000000000004}));
  EXPECT_EQ(p.value_loc.line, 3);  // of what is not finite
  EXPECT_EQ(p.value_loc.column, 6);
  EXPECT_EQ(scene.shapes.at(0).use.find("i")->integers, (std::vector<int32_t>{1, 2, 0, 4}));
}

class LoadingScene : public ::testing::Test {
 protected:
  LoadingScene() {
    text_ =
        "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8 \"string filename\" \"a.exr\"\n"
        "Sampler \"independent\" \"integer pixelsamples\" 1\nLookAt 0 0 -9 0 0 0 0 1 0 Camera "
        "\"perspective\"\nWorldBegin LightSource "
        "\"infinite\"\n";
    for (int i = 0; i < 20; ++i) text_ += fmt::format("Shape \"plymesh\" \"string filename\" \"{}.ply\"\n", i % 16);
    for (int i = 0; i < 16; ++i) folder_.write(fmt::format("{}.ply", i), ply({.big_endian = i % 2 == 0}));
  }
  std::optional<PreparedRender> prepare(int threads, Diagnostics& diagnostics, const LoadMonitor& monitor = {}) {
    const SceneDescription scene = read_pbrt_text(text_, "test", folder_.path(), diagnostics);
    RenderOverrides overrides;
    overrides.threads = threads;
    return prepare_render(scene, overrides, diagnostics, {}, nullptr, monitor);
  }

  TempFolder folder_;
  std::string text_;
};

TEST_F(LoadingScene, IsTheSameWhateverTheThreads) {
  Diagnostics one, four;
  const auto expected = prepare(1, one), result = prepare(4, four);
  ASSERT_TRUE(expected && result) << one.format_all();
  EXPECT_EQ(four.format_all(), one.format_all());
  const auto& meshes = expected->compiled.scene->geometry.meshes;
  ASSERT_EQ(result->compiled.scene->geometry.meshes.size(), meshes.size());
  for (size_t i = 0; i < meshes.size(); ++i) {
    EXPECT_EQ(result->compiled.scene->geometry.meshes[i].positions, meshes[i].positions);
    EXPECT_EQ(result->compiled.scene->geometry.meshes[i].triangles, meshes[i].triangles);
  }
}

TEST_F(LoadingScene, SaysTheSameWhateverTheThreads) {
  folder_.write("3.ply", "ply\n");
  folder_.write("4.ply", ply({}, 17, -5));
  folder_.write("9.ply", ply({}).substr(0, 3000));
  folder_.write("15.ply", "");
  text_ +=
      "Shape \"plymesh\" \"string filename\" \"none.ply\" Shape \"offmesh\" \"string filename\" \"1.ply\"\n"
      "Shape \"plymesh\" \"string file\" \"5.ply\" Shape \"plymesh\" \"string filename\" [ \"1.ply\" \"2.ply\" ]\n";
  Diagnostics one;
  EXPECT_FALSE(prepare(1, one));
  EXPECT_GT(one.error_count(), 7) << one.format_all();
  for (const int threads : {2, 4, 7}) {
    Diagnostics several;
    EXPECT_FALSE(prepare(threads, several));
    ASSERT_EQ(several.all().size(), one.all().size());
    for (size_t i = 0; i < one.all().size(); ++i) EXPECT_EQ(several.all()[i].message, one.all()[i].message);
    EXPECT_EQ(several.format_all(), one.format_all());
  }
}

TEST_F(LoadingScene, IsToldAndCanBeStopped) {
  std::mutex mutex;
  std::set<std::string> told;
  Diagnostics diagnostics;
  const LoadMonitor listen = [&](std::string_view what, double share) {
    const std::lock_guard lock(mutex);
    told.emplace(what);
    EXPECT_GE(share, 0);
    EXPECT_LE(share, 1);
    return true;
  };
  ASSERT_TRUE(prepare(4, diagnostics, listen));
  for (int i = 1; i <= 16; ++i) EXPECT_EQ(told.count(fmt::format("reading meshes, {} of 16", i)), 1u);
  EXPECT_EQ(told.count("building the acceleration structure"), 1u);
  for (const std::string_view last : {"reading meshes, 9 of 16", "building the acceleration structure"})
    for (const int threads : {1, 4})
      EXPECT_THROW(prepare(threads, diagnostics, [&](std::string_view what, double) { return what != last; }),
                   LoadingStopped)
          << last;
}

TEST_F(LoadingScene, CountsTheMemoryThatStays) {
  Diagnostics diagnostics;
  auto prepared = prepare(2, diagnostics);
  ASSERT_TRUE(prepared);
  RenderObserver nobody;
  const RenderStats stats = finished_stats(*prepared, run_render(*prepared, nobody));
  EXPECT_GE(stats.geometry_bytes, 20 * (kVertices - 1) * sizeof(Point3));
  // Every triangle is in a leaf of the structure, with its vertices.
  EXPECT_GE(stats.accelerator_bytes, prepared->compiled.scene->geometry.meshes[0].triangles.size() * 20 * 36);
  EXPECT_GE(stats.load_peak_bytes, stats.geometry_bytes + stats.accelerator_bytes);
  // The system counts pages in batches.
  EXPECT_LE(stats.load_peak_bytes, stats.peak_bytes + (1u << 20));
}

}  // namespace
}  // namespace etd
