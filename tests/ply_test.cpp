// PLY files as programs write them; ply_errors_test.cpp has broken ones.
#include <gtest/gtest.h>

#include <chrono>

#include <fmt/format.h>

#include "mesh_text.h"
#include "ply_files.h"
#include "shared_path.h"

namespace etd {
namespace {

MeshResult read_text(std::string_view text) { return read_mesh_text(read_ply, text); }
void expect_problem(std::string_view text, std::string_view problem) { expect_only_problem(read_text(text), problem); }

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
