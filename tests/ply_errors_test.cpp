// What is said about broken PLY files.
#include <gtest/gtest.h>

#include <cmath>

#include "mesh_text.h"
#include "ply_files.h"

namespace etd {
namespace {

MeshResult read_text(std::string_view text) { return read_mesh_text(read_ply, text); }
void expect_problem(std::string_view text, std::string_view problem) { expect_only_problem(read_text(text), problem); }
void expect_data_problem(std::string_view data, std::string_view problem) {
  expect_problem(kTriangleHeader + std::string(data), problem);
}

std::string binary_header(std::string_view vertices, std::string_view faces) {
  return "ply\nformat binary_little_endian 1.0\nelement vertex " + std::string(vertices) +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::string(faces) +
         "\nproperty list uchar int vertex_indices\nend_header\n";
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

}  // namespace
}  // namespace etd
