// OFF files in the dialects that programs write, and what is said about broken ones.
#include <gtest/gtest.h>

#include "mesh_text.h"
#include "shared_path.h"

namespace etd {
namespace {

MeshResult read_text(std::string_view text) { return read_mesh_text(read_off, text); }
void expect_problem(std::string_view text, std::string_view problem) { expect_only_problem(read_text(text), problem); }

constexpr const char* kVertices = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

void expect_square(std::string_view text, std::vector<std::string> notes = {}) {
  const MeshResult result = read_text(text);
  ASSERT_TRUE(result.mesh) << text << result.problems.at(0);
  EXPECT_EQ(result.notes, notes) << text;
  ASSERT_EQ(result.mesh->positions.size(), 4u) << text;
  EXPECT_EQ(result.mesh->positions[2], (Point3d{1, 1, 0})) << text;
  ASSERT_EQ(result.mesh->triangles.size(), 2u) << text;
  EXPECT_EQ(result.mesh->triangles[0], (std::array<uint32_t, 3>{0, 1, 2})) << text;
  EXPECT_EQ(result.mesh->triangles[1], (std::array<uint32_t, 3>{0, 2, 3})) << text;
}

TEST(Off, ReadsTheDialects) {
  const std::string vertices = kVertices, quad = "4 0 1 2 3\n";
  expect_square("OFF\n4 1 0\n" + vertices + quad);
  expect_square("OFF 4 1 0\n" + vertices + quad);
  expect_square("OFF\n4 1\n" + vertices + quad);                     // no edges
  expect_square("OFF\n4 2 77\n" + vertices + "3 0 1 2\n3 0 2 3\n");  // a lying count of edges
  expect_square("# a comment\n\nOFF # more\n# and\n4 1 4\n\n" + vertices + "\n" + quad + "\n# end\n");
  expect_square("OFF\r\n4 1 0\r\n0 0 0\r\n1 0 0\r\n1 1 0 \r\n0 1 0\r\n4 0 1 2 3");
  expect_square("4 1 0\n" + vertices + quad, {"the file does not begin with OFF, but is read as if it did"});
  expect_square("OFF 4 1 0 0 0 0 1 0 0 1 1 0 0 1 0 4 0 1 2 3");                      // all in one line
  expect_square("OFF\n4 1 0\n" + vertices + "4 0\n1\n2\n3\n");                       // a face over lines
  expect_square("OFF\n4 2 0\n0 0\n0\n1 0\n0\n1 1\n0\n0 1\n0\n3 0 1 2\n3 0\n2 3\n");  // all over lines
  expect_square("4OFF\n4 1 0\n0 0 0 1\n2 0 0 2\n3 3 0 3\n0 1 0 1\n" + quad);
}

TEST(Off, ReadsOverColours) {
  const std::string vertices = kVertices;
  expect_square("OFF\n4 2 0\n" + vertices + "3 0 1 2 255 0 0\n3 0 2 3 0.1 0.2 0.3 1\n", {"face colours are not used"});
  expect_square("COFF\n4 1 0\n0 0 0 255 0 0 255\n1 0 0 0 0 0 0\n1 1 0 1 1 1 1\n0 1 0 0 0 0 0\n4 0 1 2 3\n",
                {"vertex colours are not used"});
  expect_square("COFF\n4 1 0\n0 0 0 .5 0 0\n1 0 0 0 0 0\n1 1 0 1 1 1\n0 1 0 0 0 0\n4 0 1 2 3\n",
                {"vertex colours are not used"});
  expect_square("OFF\n4 1 0\n0 0 0 .5 0 0\n1 0 0 0 0 0\n1 1 0 1 1 1\n0 1 0 0 0 0\n4 0 1 2 3\n",
                {"vertex colours are not used"});
  expect_square("COFF 4 1 0 0 0 0 1 1 1 1 1 0 0 1 1 1 1 1 1 0 1 1 1 1 0 1 0 1 1 1 1 4 0 1 2 3",
                {"vertex colours are not used"});
}

TEST(Off, ReadsNormalsAndTextureCoordinates) {
  MeshResult r = read_text("NOFF\n3 1 0\n0 0 0 0 0 2\n1 0 0 0 1 0\n0 1 0 1 0 0\n3 0 1 2\n");
  ASSERT_TRUE(r.mesh);
  ASSERT_EQ(r.mesh->normals.size(), 3u);
  EXPECT_EQ(r.mesh->normals[0], (Vec3{0, 0, 2}));
  r = read_text("STCNOFF\n3 1 0\n0 0 0 0 0 2 9 9 9 .25 .5\n1 0 0 0 1 0 9 9 9 1 0\n0 1 0 1 0 0 9 9 9 0 1\n3 0 1 2\n");
  ASSERT_TRUE(r.mesh);
  EXPECT_EQ(r.mesh->normals[2], (Vec3{1, 0, 0}));
  ASSERT_EQ(r.mesh->uvs.size(), 3u);
  EXPECT_EQ(r.mesh->uvs[0], (Vec2{0.25f, 0.5f}));
  EXPECT_EQ(r.notes, std::vector<std::string>{"vertex colours are not used"});
  r = read_text("STOFF\n3 1 0\n0 0 0 .25 .5\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n");
  ASSERT_TRUE(r.mesh);
  EXPECT_EQ(r.mesh->uvs[0], (Vec2{0.25f, 0.5f}));
}

TEST(Off, LeavesOutPointsAndEdges) {
  const MeshResult r = read_text("OFF\n3 3 0\n0 0 0\n1 0 0\n0 1 0\n1 0\n2 0 1\n3 0 1 2\n");
  ASSERT_TRUE(r.mesh);
  EXPECT_EQ(r.mesh->triangles.size(), 1u);
  EXPECT_EQ(r.notes, std::vector<std::string>{"left out: 2 faces of fewer than 3 different vertices"});
}

TEST(Off, LeavesOutWhatCannotBeDrawn) {
  const MeshResult r = read_text(
      "STNOFF\n5 2 0\ninf 0 0 0 0 1 0 0\n0 0 0 0 nan 1 0 0\n1 0 0 0 0 1 0 nan\n0 1 0 0 0 1 0 1\n9 9 9 0 0 1 0 0\n"
      "4 1 1 2 3\n3 3 1 3\n");
  ASSERT_TRUE(r.mesh) << r.problems.at(0);
  EXPECT_EQ(r.mesh->positions, (std::vector<Point3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(r.mesh->normals.at(0), Vec3{});
  EXPECT_EQ(r.mesh->uvs.at(1), Vec2{});
  EXPECT_EQ(r.notes,
            std::vector<std::string>{"left out: 1 face of fewer than 3 different vertices, 2 vertices that no face "
                                     "uses, 1 normal that is not finite, 1 pair of texture coordinates that are not "
                                     "finite"});
}

TEST(Off, SaysWhatIsWrong) {
  const std::string vertices = kVertices;
  expect_problem("", "the file is empty");
  expect_problem(
      "PLY\n4 1 0\n",
      "line 1: \"PLY\" begins no OFF file; valid: OFF, COFF, NOFF, STOFF and their combinations, or the counts");
  expect_problem("OFF BINARY\n", "line 1: binary OFF files are not supported, only text");
  expect_problem("nOFF\n5\n4 1 0\n", "line 1: \"nOFF\" is a mesh in any number of dimensions, not in three");
  expect_problem("OFF\n4 many 0\n", "line 2: \"many\" is not a number of faces");
  expect_problem("OFF\n0 0 0\n", "line 2: the mesh has no vertices");
  expect_problem("OFF\n4 1 0\n0 0 0\n1 0 x\n1 1 0\n0 1 0\n3 0 1 2\n", "line 4: vertex 1: \"x\" is not a number");
  expect_problem("OFF\n4 1 0\n0 0 0\n1 0 nan\n1 1 0\n0 1 0\n3 0 1 2\n",
                 "line 4: vertex 1: z is nan, not a finite number");
  expect_problem("OFF\n4 1 0\n" + vertices + "3 0 1 4\n",
                 "line 7: face 0: vertex 4 is out of range, the mesh has vertices 0 to 3");
  expect_problem("OFF\n5 1 0\n" + vertices + "3 0 1 2\n",
                 "line 7: vertex 4 has 4 numbers, those before it 3: are there 5 vertices, as the header says?");
  expect_problem("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n0.5 1 0\n3 0 1 2\n",
                 "line 6: face 0 begins with \"0.5\", not with its number of vertices: are there 3 vertices, as the "
                 "header says?");
  expect_problem("OFF\n4 2 0\n" + vertices + "3 0 1 2\n",
                 "line 7: the file ends after 1 of the 2 faces that the header counts");
  expect_problem("OFF\n4 1 0\n" + vertices + "3 0 1 2\n3 0 2 3\n",
                 "line 8: \"3\" follows the last face: are there 4 vertices and 1 faces, as the header says?");
  expect_problem("OFF\n4000000000 1 0\n0 0 0\n",
                 "line 3: the file ends in vertex 1, before the 4000000000 that the header counts");
  expect_problem("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n", "the mesh has no faces of at least 3 different vertices");
}

TEST(Off, ReadsTheSharedMeshes) {
  const struct {
    const char* name;
    size_t vertices, triangles;
  } kMeshes[] = {{"3holes", 3596, 7200},
                 {"bunny_small", 3485, 6966},
                 {"camelhead", 11381, 22704},
                 {"cube", 8, 12},
                 {"icosahedron", 12, 20},
                 {"dragon", 50000, 100000},
                 {"inspired_mesh_quads_Conjugate", 1749, 3266}};
  for (const auto& expected : kMeshes) {
    const auto path = shared_path(std::string("meshes/") + expected.name + ".off");
    if (path.empty()) GTEST_SKIP() << "the shared meshes are not there";
    const MeshResult result = read_off(path);
    ASSERT_TRUE(result.mesh) << expected.name << result.problems.at(0);
    EXPECT_EQ(result.mesh->positions.size(), expected.vertices) << expected.name;
    EXPECT_EQ(result.mesh->triangles.size(), expected.triangles) << expected.name;
    EXPECT_TRUE(result.notes.empty()) << expected.name;
  }
}

}  // namespace
}  // namespace etd
