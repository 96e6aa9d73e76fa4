#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <initializer_list>

#include <fmt/format.h>

#include "io/mesh.h"
#include "shared_path.h"
#include "temp_folder.h"

namespace etd {
namespace {

MeshResult read_text(std::string_view text) {
  const TempFolder folder;
  return read_ply(folder.write("mesh.ply", text));
}

// The values of one binary file, in the byte order asked for.
class Bytes {
 public:
  explicit Bytes(bool big_endian) : big_endian_(big_endian) {}
  template <class T>
  Bytes& add(std::initializer_list<T> values) {
    for (const T value : values) {
      char raw[sizeof(T)];
      std::memcpy(raw, &value, sizeof(T));
      if (big_endian_) std::reverse(raw, raw + sizeof(T));
      bytes_.append(raw, sizeof(T));
    }
    return *this;
  }
  const std::string& str() const { return bytes_; }

 private:
  std::string bytes_;
  bool big_endian_;
};

constexpr const char* kTriangleHeader =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
constexpr const char* kTriangleVertices = "0 0 0\n1 0 0\n0 1 0\n";

std::string binary_header(std::string_view vertices, std::string_view faces) {
  return "ply\nformat binary_little_endian 1.0\nelement vertex " + std::string(vertices) +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::string(faces) +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

// The one problem expected of a broken file.
void expect_problem(std::string_view text, std::string_view problem) {
  const MeshResult result = read_text(text);
  EXPECT_FALSE(result.mesh.has_value()) << problem;
  ASSERT_EQ(result.problems.size(), 1u) << problem;
  EXPECT_EQ(result.problems[0], problem);
}
void expect_data_problem(std::string_view data, std::string_view problem) {
  expect_problem(kTriangleHeader + std::string(data), problem);
}

TEST(Ply, ReadsAscii) {
  const MeshResult result = read_text(std::string(kTriangleHeader) + "0 0 .5\n +1 -0.25\t1e-3 \n\n0 1 0\n3 0 1 2");
  ASSERT_TRUE(result.mesh) << result.problems.at(0);
  EXPECT_TRUE(result.notes.empty());
  ASSERT_EQ(result.mesh->positions.size(), 3u);
  // A value of type float is the same number in text as in binary.
  EXPECT_EQ(result.mesh->positions[1], (Point3d{1, -0.25, static_cast<double>(1e-3f)}));
  ASSERT_EQ(result.mesh->triangles.size(), 1u);
  EXPECT_EQ(result.mesh->triangles[0], (std::array<uint32_t, 3>{0, 1, 2}));
  EXPECT_TRUE(result.mesh->normals.empty());
  EXPECT_TRUE(result.mesh->uvs.empty());
}

TEST(Ply, TakesTheLineEndsOfAllSystems) {
  const std::string text = std::string(kTriangleHeader) + kTriangleVertices + "3 0 1 2\n";
  for (const std::string line_end : {"\r\n", "\r"}) {
    std::string converted;
    for (const char c : text) converted += c == '\n' ? line_end : std::string(1, c);
    const MeshResult result = read_text(converted);
    ASSERT_TRUE(result.mesh) << result.problems.at(0);
    EXPECT_EQ(result.mesh->positions.size(), 3u);
    EXPECT_EQ(result.mesh->triangles.size(), 1u);
  }
}

TEST(Ply, ReadsEveryTypeInBothByteOrders) {
  for (const bool big : {false, true}) {
    const std::string header = std::string("ply\r\nformat binary_") + (big ? "big" : "little") +
                               "_endian 1.0\r\ncomment all types\r\nobj_info none\r\n"
                               "element extra 2\r\nproperty list ushort double ignored\r\nproperty int8 n\r\n"
                               "element vertex 4\r\nproperty double x\r\nproperty int16 y\r\nproperty uint16 z\r\n"
                               "property list int float weights\r\nproperty float32 texture_u\r\n"
                               "property float64 texture_v\r\nproperty char nx\r\nproperty uint8 ny\r\n"
                               "property uint nz\r\n"
                               "element face 2\r\nproperty uchar red\r\nproperty list uint32 uint16 vertex_index\r\n"
                               "property list char float texcoord\r\nend_header\r\n";
    Bytes data(big);
    data.add<uint16_t>({2}).add<double>({1, 2}).add<int8_t>({1}).add<uint16_t>({0}).add<int8_t>({2});
    for (int i = 0; i < 4; ++i) {
      data.add<double>({i + 1e-12}).add<int16_t>({static_cast<int16_t>(-300 - i)}).add<uint16_t>({60000});
      data.add<int32_t>({i}).add<float>({});
      for (int k = 0; k < i; ++k) data.add<float>({1.5f});
      data.add<float>({0.25f}).add<double>({0.1}).add<int8_t>({-1}).add<uint8_t>({200}).add<uint32_t>({3000000000u});
    }
    data.add<uint8_t>({9}).add<uint32_t>({4}).add<uint16_t>({0, 1, 2, 3}).add<int8_t>({1}).add<float>({0.5f});
    data.add<uint8_t>({9}).add<uint32_t>({3}).add<uint16_t>({3, 2, 1}).add<int8_t>({0});

    const MeshResult result = read_text(header + data.str());
    ASSERT_TRUE(result.mesh) << result.problems.at(0);
    const MeshData& mesh = *result.mesh;
    ASSERT_EQ(mesh.positions.size(), 4u);
    EXPECT_EQ(mesh.positions[3], (Point3d{3 + 1e-12, -303, 60000}));
    ASSERT_EQ(mesh.normals.size(), 4u);
    EXPECT_EQ(mesh.normals[2], (Vec3{-1, 200, 3e9f}));
    ASSERT_EQ(mesh.uvs.size(), 4u);
    EXPECT_EQ(mesh.uvs[0], (Vec2{0.25f, 0.1f}));
    const std::vector<std::array<uint32_t, 3>> expected = {{0, 1, 2}, {0, 2, 3}, {3, 2, 1}};
    EXPECT_EQ(mesh.triangles, expected);
    const std::vector<std::string> notes = {"properties of element \"vertex\" not used: \"weights\"",
                                            "properties of element \"face\" not used: \"red\", \"texcoord\"",
                                            "element \"extra\" is not used"};
    EXPECT_EQ(result.notes, notes);
  }
}

TEST(Ply, FindsTextureCoordinatesUnderAllTheirNames) {
  for (const auto& [u, v] : {std::pair("u", "v"), {"s", "t"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}}) {
    const MeshResult result = read_text("ply\nformat ascii 1.0\nelement vertex 3\nproperty float " + std::string(v) +
                                        "\nproperty float z\nproperty float y\nproperty float x\nproperty float " + u +
                                        "\nelement face 1\nproperty list uchar int vertex_index\nend_header\n1 2 3 4 "
                                        "5\n1 2 3 4 5\n1 2 3 4 5\n3 0 1 2\n");
    ASSERT_TRUE(result.mesh) << result.problems.at(0);
    ASSERT_EQ(result.mesh->uvs.size(), 3u);
    EXPECT_EQ(result.mesh->uvs[0], (Vec2{5, 1}));
    EXPECT_EQ(result.mesh->positions[0], (Point3d{4, 3, 2}));
  }
}

TEST(Ply, NotesIncompleteNormals) {
  const MeshResult result = read_text(
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float "
      "nx\n"
      "element face 1\nproperty list uchar int vertex_index\nend_header\n1 2 3 0\n1 2 3 0\n1 2 3 0\n3 0 1 2\n");
  ASSERT_TRUE(result.mesh);
  EXPECT_TRUE(result.mesh->normals.empty());
  EXPECT_EQ(result.notes, std::vector<std::string>{"properties of element \"vertex\" not used: \"nx\""});
}

TEST(Ply, ReadsFacesThatStandBeforeTheirVertices) {
  const MeshResult result = read_text(
      "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_index\nelement vertex 3\nproperty int x\n"
      "property int y\nproperty int z\nend_header\n3 0 1 2\n1 2 3\n1 2 4\n1 2 5\n");
  ASSERT_TRUE(result.mesh) << result.problems.at(0);
  EXPECT_EQ(result.mesh->positions[2], (Point3d{1, 2, 5}));
}

TEST(Ply, LeavesOutWhatCannotBeDrawn) {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\nproperty float u\nproperty float v\n"
      "element face 8\nproperty list uchar int vertex_indices\nend_header\n";
  const MeshResult result = read_text(header +
                                      "nan 9 9  0 0 1  0 0\n0 0 0  nan 0 1  .1 .2\n1 0 0  0 0 1  inf 0\n"
                                      "1 1 0  0 1e99 0  1 1\n0 1 0  0 0 0  0 1\n1e39 0 0  0 0 1  0 0\n"
                                      "0\n1 0\n2 1 2\n3 1 2 1\n4 1 1 2 2\n"      // nothing
                                      "5 1 2 2 3 1\n5 1 3 3 4 3\n4 3 4 4 1\n");  // three triangles
  ASSERT_TRUE(result.mesh) << result.problems.at(0);
  EXPECT_EQ(result.notes,
            std::vector<std::string>{"left out: 6 faces of fewer than 3 different vertices, 2 vertices that no face "
                                     "uses, 2 normals that are not finite, 1 pair of texture coordinates that are not "
                                     "finite"});
  EXPECT_EQ(result.mesh->triangles, (std::vector<std::array<uint32_t, 3>>{{0, 1, 2}, {2, 3, 0}}));
  EXPECT_EQ(result.mesh->positions, (std::vector<Point3d>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(result.mesh->normals, (std::vector<Vec3>{{}, {0, 0, 1}, {}, {}}));
  EXPECT_EQ(result.mesh->uvs, (std::vector<Vec2>{{0.1f, 0.2f}, {}, {1, 1}, {0, 1}}));
}

TEST(Ply, ReadsTriangleStrips) {
  // Triangles that all face -z, in two strips that -1 parts; triangles without area join the second to a third.
  using Triangles = std::vector<std::array<uint32_t, 3>>;
  const Triangles expected = {{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 5}, {0, 1, 3}, {4, 2, 5}};
  std::string vertices;
  for (int i = 0; i < 6; ++i) vertices += fmt::format("{} {} 0\n", i / 2, i % 2);
  for (const char* name : {"tristrips", "tristrip"}) {
    const std::string header =
        "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
        "element " +
        std::string(name) + " 1\nproperty list int int vertex_indices\nend_header\n";
    const MeshResult result = read_text(header + vertices + "15 0 1 2 3 4 5 -1 0 1 3 3 2 2 4 5\n");
    ASSERT_TRUE(result.mesh) << result.problems.at(0);
    EXPECT_EQ(result.mesh->triangles, expected);
    EXPECT_EQ(result.notes, std::vector<std::string>{});
    const MeshResult ends = read_text(header + vertices + "10 -1 0 1 -1 -1 3 4 5 -1 2\n");
    ASSERT_TRUE(ends.mesh) << ends.problems.at(0);
    EXPECT_EQ(ends.mesh->triangles, (Triangles{{0, 1, 2}}));
    EXPECT_EQ(ends.notes, std::vector<std::string>{"left out: 2 faces of fewer than 3 different vertices, 3 vertices "
                                                   "that no face uses"});
    expect_problem(header + vertices + "4 0 1 2 6\n",
                   fmt::format("line 16: {} 0: vertex index 6 is out of range, the mesh has vertices 0 to 5", name));
  }
}

TEST(Ply, RefusesWhatIsNoPly) {
  expect_problem("", "the file is empty");
  expect_problem("solid cube\n", "line 1: not a PLY file, its first line must be \"ply\"");
  expect_problem("plywood\n", "line 1: not a PLY file, its first line must be \"ply\"");
  const TempFolder folder;
  EXPECT_EQ(read_ply(folder.path() / "none.ply").problems.at(0), "the file does not exist");
  EXPECT_EQ(read_ply(folder.path()).problems.at(0), "not a regular file");
}

TEST(Ply, ReportsAllProblemsOfAHeaderTogether) {
  const MeshResult result = read_text(
      "ply\nformat binary 1.1\nproperty float x\nelement vertex -3\nproperty real x\nproperty float y\nproperty int y\n"
      "element vertex 7\nelement face\nproperty list float int vertex_indices\nproperty float\nformat ascii 1.0\n"
      "end_header\n");
  const std::string types =
      ", valid are char, uchar, short, ushort, int, uint, float, double and int8, uint8, int16, uint16, int32, uint32, "
      "float32, float64";
  const std::vector<std::string> expected = {
      "line 2: unknown encoding \"binary\", valid are ascii, binary_little_endian and binary_big_endian",
      "line 2: unknown version \"1.1\" of the format, known is 1.0",
      "line 3: a property before any element",
      "line 4: the count of an element must be a whole number from 0, found \"-3\"",
      "line 5: unknown type \"real\"" + types,
      "line 7: a second property named \"y\" of the same element",
      "line 8: a second element named \"vertex\"",
      "line 9: expected \"element NAME COUNT\"",
      "line 10: the length of a list must have an integer type",
      "line 11: expected \"property TYPE NAME\" or \"property list COUNT_TYPE TYPE NAME\"",
      "line 12: a second \"format\" line",
  };
  EXPECT_EQ(result.problems, expected);
}

TEST(Ply, RefusesDegenerateHeaders) {
  expect_problem("ply", "line 1: the file ends before \"end_header\"");
  expect_problem("ply\nformat ascii 1.0\nelement vertex 3\n", "line 3: the file ends before \"end_header\"");
  expect_problem("ply\nformat ascii 1.0\n0 0 1\n0 1\x01\n",
                 "line 3: expected format, comment, obj_info, element, property or end_header, found \"0 0 1\"");
  expect_problem(
      "ply\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n",
      "line 8: the header has no \"format\" line");
  const MeshResult none = read_text("ply\nformat ascii 1.0\nend_header\n");
  const std::vector<std::string> expected = {"the file has no element \"vertex\"",
                                             "the file has no element \"face\": a cloud of points is not a mesh"};
  EXPECT_EQ(none.problems, expected);
}

TEST(Ply, RefusesMeshesWithoutVerticesOrFaces) {
  const MeshResult result = read_text(
      "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty list uchar float y\n"
      "element face 0\nproperty int vertex_indices\nelement tristrips 0\nproperty int vertex_indices\n"
      "end_header\n");
  const std::vector<std::string> expected = {
      "line 3: the mesh has no vertices",
      "line 3: element \"vertex\" has no number \"y\"",
      "line 3: element \"vertex\" has no number \"z\"",
      "line 6: the mesh has no faces",
      "line 6: element \"face\" has no list \"vertex_indices\" or \"vertex_index\"",
      "line 8: element \"tristrips\" has no list \"vertex_indices\" or \"vertex_index\"",
  };
  EXPECT_EQ(result.problems, expected);
}

TEST(Ply, ReportsAllProblemsOfAsciiDataTogether) {
  const MeshResult result = read_text(std::string(kTriangleHeader) + "0 nan 0\n1 0\n-inf 1e999 zero\n4 0 1 3 -1\n");
  const std::vector<std::string> expected = {
      "line 11: vertex 1 of 3: the line ends before its z",
      "line 12: vertex 2 of 3: \"zero\" is not a number (z)",
      "line 13: face 0: vertex index 3 is out of range, the mesh has vertices 0 to 2",
      "line 13: face 0: vertex index -1 is out of range, the mesh has vertices 0 to 2",
  };
  EXPECT_EQ(result.problems, expected);
}

TEST(Ply, RefusesBrokenAsciiData) {
  const std::string v = kTriangleVertices;
  expect_data_problem("0 0 0\n1 0 0\n-inf 1 0\n3 0 1 2\n", "line 12: vertex 2: x is -inf, not a finite number");
  expect_data_problem("0 0 0\n1 0 0\n0 1e999 0\n3 0 1 2\n", "line 12: vertex 2: y is inf, not a finite number");
  expect_data_problem("0 0 0\n1 0 0 7\n0 1 0\n3 0 1 2\n", "line 11: vertex 1 of 3: \"7\" too much on the line");
  expect_data_problem(v + "2 0 1     \n", "the mesh has no faces of at least 3 different vertices");
  expect_data_problem(v + "-3 0 1 2\n", "line 13: face 0 of 1: list vertex_indices cannot have -3 values");
  expect_data_problem(v + "3.5 0 1 2\n", "line 13: face 0 of 1: list vertex_indices cannot have 3.5 values");
  expect_data_problem(v + "nan 0 1 2\n", "line 13: face 0 of 1: list vertex_indices cannot have nan values");
  expect_data_problem(v + "1e30 0 1 2\n",
                      "line 13: face 0 of 1: list vertex_indices of 1e+30 values is longer than its line");
  expect_data_problem(v + "3 0 1   \n", "line 13: face 0 of 1: the line ends before its vertex_indices");
  expect_data_problem(v + "3 0 1 2x\n", "line 13: face 0 of 1: \"2x\" is not a number (vertex_indices)");
  expect_data_problem(v + "3 0 1 1.5\n",
                      "line 13: face 0: vertex index 1.5 is out of range, the mesh has vertices 0 to 2");
  expect_data_problem(v + "\n\n  \n", "line 15: face 0 of 1: the file ends before it");
  expect_data_problem(v + "3 0 1 2\n\n3 0 2 1\n",
                      "line 15: data follow the last element: does the header count too few?");
  expect_data_problem("0 0 0\n1 0",
                      "line 3: 3 of element \"vertex\" take at least 17 bytes, but only 9 are left in the file");
}

TEST(Ply, CountsWhatItDoesNotShow) {
  std::string text = kTriangleHeader;
  text.replace(text.find("face 1"), 6, "face 332");
  text += kTriangleVertices;
  for (int i = 0; i < 332; ++i) text += "3 0 1 9\n";
  const MeshResult result = read_text(text);
  ASSERT_EQ(result.problems.size(), 21u);
  EXPECT_EQ(result.problems.back(), "... and 312 more");
}

TEST(Ply, RefusesBrokenBinaryData) {
  const std::string vertices = Bytes(false).add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}).str();
  const auto face = [](uint8_t n, std::initializer_list<int32_t> indices) {
    return Bytes(false).add<uint8_t>({n}).add<int32_t>(indices).str();
  };
  const std::string header = binary_header("3", "1");
  EXPECT_TRUE(read_text(header + vertices + face(3, {0, 1, 2}) + "\n").mesh);
  expect_problem(header + vertices + face(3, {0, 1, 1000}),
                 "face 0: vertex index 1000 is out of range, the mesh has vertices 0 to 2");
  expect_problem(header + vertices + face(3, {0, -1, 1}),
                 "face 0: vertex index -1 is out of range, the mesh has vertices 0 to 2");
  expect_problem(header + vertices + face(1, {0}), "the mesh has no faces of at least 3 different vertices");
  expect_problem(header + vertices + face(3, {0, 1}),
                 "face 0 of 1: list vertex_indices of 3 values runs past the end of the file");
  expect_problem(header + vertices + face(3, {0, 1, 2}) + face(3, {0, 1, 2}),
                 "13 bytes follow the last element: does the header count too few?");
  expect_problem(header + vertices.substr(0, 35),
                 "line 3: 3 of element \"vertex\" take at least 36 bytes, but only 35 are left in the file");
  expect_problem(binary_header("3", "2") + vertices + face(3, {0, 1, 2}) + face(200, {}),
                 "face 1 of 2: list vertex_indices of 200 values runs past the end of the file");
  expect_problem(binary_header("3", "4") + vertices + face(3, {0, 1, 2}),
                 "face 1 of 4: the file ends before its vertex_indices");
  expect_problem(header + Bytes(false).add<float>({0, 0, std::nanf(""), 1, 0, 0, 0, 1, 0}).str() + face(3, {0, 1, 2}),
                 "vertex 0: z is nan, not a finite number");
  std::string list = header;
  list.replace(list.find("uchar"), 5, "char");
  expect_problem(list + vertices + face(253, {0, 1, 2}), "face 0 of 1: list vertex_indices has a negative length -3");
}

TEST(Ply, DoesNotBelieveAbsurdCounts) {
  expect_problem(binary_header("4000000000", "1"),
                 "line 3: 4000000000 of element \"vertex\" take at least 48000000000 bytes, but only 0 are left in the "
                 "file");
  expect_problem(binary_header("18446744073709551615", "1"), "line 3: more vertices than 32-bit indices reach");
  expect_problem(binary_header("99999999999999999999", "1"),
                 "line 3: the count of an element must be a whole number from 0, found \"99999999999999999999\"");
  // An element without properties takes no bytes, however many there are.
  std::string empty = kTriangleHeader;
  empty.insert(empty.find("element vertex"), "element nothing 18446744073709551615\n");
  EXPECT_TRUE(read_text(empty + kTriangleVertices + "3 0 1 2\n").mesh);
}

TEST(Ply, ReadsLargeBinaryFilesFast) {
  const std::filesystem::path path = shared_path("meshes/Lucy100k.ply");
  if (path.empty()) GTEST_SKIP() << "shared/meshes is absent";
  const auto start = std::chrono::steady_clock::now();
  const MeshResult result = read_ply(path);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  ASSERT_TRUE(result.mesh);
  RecordProperty("milliseconds", static_cast<int>(seconds * 1000));
  EXPECT_LT(seconds, 2.0);  // ten milliseconds here; generous for sanitizers and busy machines
}

TEST(Ply, ReadsTheSharedMeshes) {
  struct Expected {
    const char* name;
    size_t vertices, triangles;
    size_t notes = 0;
  };
  const Expected files[] = {
      {"Lucy100k", 50002, 100000},       {"bunny", 34834, 69451, 1},        {"dolphins_ascii", 855, 1689},
      {"dolphins_be_binary", 855, 1689}, {"dolphins_le_binary", 855, 1689}, {"teapot", 1177, 2256},
  };
  if (shared_path("meshes").empty()) GTEST_SKIP() << "shared/meshes is absent";
  for (const Expected& file : files) {
    const MeshResult result = read_ply(shared_path("meshes/" + std::string(file.name) + ".ply"));
    ASSERT_TRUE(result.mesh) << file.name << ": " << result.problems.at(0);
    EXPECT_EQ(result.mesh->positions.size(), file.vertices) << file.name;
    EXPECT_EQ(result.mesh->triangles.size(), file.triangles) << file.name;
    EXPECT_EQ(result.notes.size(), file.notes) << file.name;  // of 1113 unused vertices
  }
}

TEST(Ply, ReadsTheMeshesOfTheSharedScenes) {
  const std::filesystem::path scenes = shared_path("scenes/pbrt");
  if (scenes.empty()) GTEST_SKIP() << "shared/scenes/pbrt is absent";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(scenes)) {
    if (entry.path().extension() != ".ply") continue;
    const MeshResult result = read_ply(entry.path());
    EXPECT_TRUE(result.mesh) << entry.path() << ": " << result.problems.at(0);
  }
}

TEST(Ply, TheThreeEncodingsOfOneMeshAgree) {
  if (shared_path("meshes").empty()) GTEST_SKIP() << "shared/meshes is absent";
  const MeshResult ascii = read_ply(shared_path("meshes/dolphins_ascii.ply"));
  const MeshResult little = read_ply(shared_path("meshes/dolphins_le_binary.ply"));
  const MeshResult big = read_ply(shared_path("meshes/dolphins_be_binary.ply"));
  ASSERT_TRUE(ascii.mesh && little.mesh && big.mesh);
  EXPECT_EQ(little.mesh->positions, big.mesh->positions);
  EXPECT_EQ(little.mesh->triangles, big.mesh->triangles);
  EXPECT_EQ(little.mesh->triangles, ascii.mesh->triangles);
  EXPECT_EQ(little.mesh->positions, ascii.mesh->positions);
}

}  // namespace
}  // namespace etd
