// OBJ files: all forms of indices, parts by material, MTL files, and what is said about broken ones.
#include "io/obj.h"

#include <gtest/gtest.h>

#include "temp_folder.h"

namespace etd {
namespace {

ObjResult read_text(std::string_view text, std::string_view mtl = {}) {
  const TempFolder folder;
  if (!mtl.empty()) folder.write("m.mtl", mtl);
  return read_obj(folder.write("mesh.obj", text));
}

constexpr const char* kVertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

void expect_problem(std::string_view text, std::string_view problem) {
  const ObjResult result = read_text(text);
  EXPECT_TRUE(result.parts.empty()) << text;
  ASSERT_EQ(result.problems.size(), 1u) << text;
  EXPECT_EQ(result.problems[0], problem);
}

TEST(Obj, TakesAllFormsOfIndices) {
  const std::string vertices = std::string(kVertices) + "vt 0 0\nvt 1 .5\nvn 0 0 1\n";
  for (const char* face : {"f 1 2 3 4", "f -4 -3 -2 -1", "f 1/1 2/2 3/1 4/1", "f 1//1 2//1 3//1 4//-1",
                           "f 1/1/1 2/2/1 3/-2/-1 4/1/1", "f 1 2 \\\n 3 4", "f 1/ 2/ 3/ 4/"}) {
    const ObjResult r = read_text(vertices + face + "\n");
    ASSERT_EQ(r.parts.size(), 1u) << face << r.problems.at(0);
    const MeshData& m = r.parts[0].mesh;
    ASSERT_EQ(m.positions.size(), 4u) << face;
    EXPECT_EQ(m.positions[3], (Point3d{0, 1, 0})) << face;
    EXPECT_EQ(m.triangles, (std::vector<std::array<uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}})) << face;
    EXPECT_TRUE(r.notes.empty());
  }
  const MeshData m = read_text(vertices + "f 1/2/1 2/2/1 3/1/1\n").parts.at(0).mesh;
  ASSERT_EQ(m.uvs.size(), 3u);
  EXPECT_EQ(m.uvs[0], (Vec2{1, 0.5f}));
  EXPECT_EQ(m.normals.at(2), (Vec3{0, 0, 1}));
}

TEST(Obj, SplitsVerticesThatDifferInNormalOrTexture) {
  const ObjResult r = read_text(std::string(kVertices) + "vn 0 0 1\nvn 0 1 0\nf 1//1 2//1 3//1\nf 1//2 3//1 4\n");
  const MeshData& m = r.parts.at(0).mesh;
  EXPECT_EQ(m.positions.size(), 5u);
  EXPECT_EQ(m.normals.at(4), Vec3{});  // none given: that of the face
}

TEST(Obj, JoinsTheFacesOfAMaterial) {
  const std::string text = std::string(kVertices) +
                           "mtllib m.mtl\no one\ng a b\ns 1\nf 1 2 3\nusemtl red paint\nf 1 3 4\n"
                           "usemtl blue\nf 2 3 4\nusemtl red paint\nf 1 2 4\n";
  const ObjResult r =
      read_text(text,
                "newmtl red paint\nKd 1 0 0\nKs .5\nNs 100\nd 0.25\nKa 1 1 1\nillum 2\n"
                "map_Kd -s 2 3 1 -o .5 -clamp on dir\\a b.png\n\nnewmtl blue\nKe 0 0 4\nTr 0.25\nNi 1.5\n"
                "Pr 0.5\nPm 1\nmap_Ns x.png\nmap_Bump -bm .25 -s 2 x.png\nnorm n 1.png -clamp on -o 1 2\n");
  ASSERT_EQ(r.parts.size(), 3u);
  EXPECT_EQ(r.parts[0].material, "");
  EXPECT_EQ(r.parts[1].material, "red paint");
  EXPECT_EQ(r.parts[1].mesh.triangles.size(), 2u);
  EXPECT_EQ(r.notes, std::vector<std::string>{"m.mtl: not used: map_Ns"});
  const ObjMaterial* red = r.find("red paint");
  ASSERT_TRUE(red);
  EXPECT_EQ(red->kd, (Vec3{1, 0, 0}));
  EXPECT_EQ(red->ks, (Vec3{0.5f, 0.5f, 0.5f}));
  EXPECT_EQ(red->d, 0.25);
  EXPECT_EQ(red->map_kd.file, "dir/a b.png");
  EXPECT_EQ(red->map_kd.scale, (Vec2{2, 3}));
  EXPECT_EQ(red->map_kd.offset, (Vec2{0.5f, 0}));
  EXPECT_TRUE(red->map_kd.clamp);
  const ObjMaterial* blue = r.find("blue");
  ASSERT_TRUE(blue);
  EXPECT_EQ(blue->ke, (Vec3{0, 0, 4}));
  EXPECT_EQ(blue->d, 0.75);
  EXPECT_EQ(blue->pr, 0.5);
  EXPECT_EQ(blue->bump.file, "x.png");
  EXPECT_EQ(blue->bump.height, 0.25);
  EXPECT_EQ(blue->bump.scale, (Vec2{2, 1}));
  EXPECT_EQ(blue->normal.file, "n 1.png");
  EXPECT_EQ(blue->normal.offset, (Vec2{1, 2}));
  EXPECT_TRUE(blue->normal.clamp);
}

TEST(Obj, NotesWhatItLeavesOut) {
  ObjResult r = read_text("v 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0\nvt 1 1\nmtllib gone.mtl\nl 1 2\nf 1/1 2 3\n");
  ASSERT_FALSE(r.notes.empty());
  const std::string missing = "line 5: cannot read \"gone.mtl\": the file does not exist; it was looked for in ";
  EXPECT_EQ(r.notes[0].substr(0, missing.size()), missing);
  r.notes.erase(r.notes.begin());
  EXPECT_EQ(r.notes, (std::vector<std::string>{"vertex colours are not used",
                                               "corners without texture coordinates have (0, 0), as others have them",
                                               "statements not used: l"}));
  const ObjResult bad = read_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nmtllib m.mtl\nf 1 2 3\n",
                                  "Kd 1 1 1\nnewmtl a\nKd red\nNs -1\nillum 99\nmap_Kd\n"
                                  "map_Kd -bm 2 -mm 0 1 -foo 3 a.png\nbump -bm much -imfchan l b.png\nnorm -bm\n");
  EXPECT_EQ(bad.notes, (std::vector<std::string>{
                           "m.mtl: line 1: \"Kd\" stands before the first newmtl",
                           "m.mtl: line 3: Kd needs three numbers that are not negative",
                           "m.mtl: line 4: Ns needs one number from 0 to 1000000000",
                           "m.mtl: line 5: illum needs one number from 0 to 10", "m.mtl: line 6: map_Kd names no file",
                           "m.mtl: line 7: map_Kd -bm is not used", "m.mtl: line 7: map_Kd -mm is not used",
                           "m.mtl: line 7: map_Kd -foo is not used", "m.mtl: line 8: bump -bm needs a number",
                           "m.mtl: line 8: bump -imfchan is not used", "m.mtl: line 9: norm -bm is not used",
                           "m.mtl: line 9: norm names no file"}));
}

TEST(Obj, OpaqueWinsWhereOpacitiesContradict) {
  const ObjResult r =
      read_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nmtllib m.mtl\nf 1 2 3\n",
                "newmtl a\nd 1\nTr 1\nnewmtl b\nTr 1\nd 1\nnewmtl c\nd .25\nTr .25\nnewmtl d\nd .25\n"
                "Tr .75\nnewmtl e\nTr 1\nnewmtl f\nd .333\nTr .67\nnewmtl g\nd 0\nTr 0\nnewmtl h\nd 1\nd .5\n");
  const std::pair<const char*, double> kOpacities[] = {{"a", 1}, {"b", 1},     {"c", 0.75}, {"d", 0.25},
                                                       {"e", 0}, {"f", 0.333}, {"g", 1},    {"h", 0.5}};
  for (const auto& [name, d] : kOpacities) EXPECT_EQ(r.find(name)->d, d) << name;
  EXPECT_EQ(r.notes,
            (std::vector<std::string>{"m.mtl: line 3: d 1 and Tr 1 contradict each other: \"a\" has opacity 1",
                                      "m.mtl: line 6: d 1 and Tr 1 contradict each other: \"b\" has opacity 1",
                                      "m.mtl: line 9: d 0.25 and Tr 0.25 contradict each other: \"c\" has opacity 0.75",
                                      "m.mtl: line 20: d 0 and Tr 0 contradict each other: \"g\" has opacity 1"}));
}

TEST(Obj, LeavesOutWhatCannotBeDrawn) {
  const ObjResult r = read_text(
      "v nan 0 0\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 nan 1\nvn 0 0 1\nvt inf\nusemtl a\nf 2//1 3//2 4\nf 2 3\n"
      "f 5\nf\nusemtl b\nf 2/1 3/1 3/1\nusemtl c\nf 2 2 4 4 5 5\n");
  ASSERT_EQ(r.parts.size(), 2u) << r.problems.at(0);
  EXPECT_EQ(r.parts[0].mesh.normals, (std::vector<Vec3>{{}, {0, 0, 1}, {}}));
  EXPECT_EQ(r.parts[1].material, "c");
  EXPECT_EQ(r.parts[1].mesh.positions, (std::vector<Point3d>{{0, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(r.parts[1].mesh.triangles, (std::vector<std::array<uint32_t, 3>>{{0, 1, 2}}));
  EXPECT_EQ(r.notes,
            std::vector<std::string>{"left out: 4 faces of fewer than 3 different vertices, 1 vertex that no face "
                                     "uses, 1 normal that is not finite, 1 pair of texture coordinates that are not "
                                     "finite"});
}

TEST(Obj, CutsPolygonsAndSaysWhichCrossThemselves) {
  const std::string v = "v 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 0\nv 2 0 0\n";
  const ObjResult r = read_text(v + "f 1 2 3 4 5 6\nf 4 5 1 6\nf 4 5 6 1\n");
  ASSERT_EQ(r.parts.size(), 1u) << r.problems.at(0);
  const MeshData& m = r.parts[0].mesh;
  ASSERT_EQ(m.triangles.size(), 4u + 2u + 2u);
  double area = 0;
  for (size_t i = 0; i < 4; ++i) {
    const auto& t = m.triangles[i];
    const Vec3d n = cross(m.positions[t[1]] - m.positions[t[0]], m.positions[t[2]] - m.positions[t[0]]);
    EXPECT_GT(n.z, 0);
    area += 0.5 * n.z;
  }
  EXPECT_DOUBLE_EQ(area, 3);
  EXPECT_EQ(m.triangles[6], (std::array<uint32_t, 3>{3, 4, 5}));  // behind others that were cut
  EXPECT_EQ(r.notes, std::vector<std::string>{"1 face crosses itself, and may be drawn wrongly; the first begins at "
                                              "(0, 2, 0)"});
}

TEST(Obj, SaysWhatIsWrong) {
  const std::string v = kVertices;
  const std::string none = "the mesh has no faces of at least 3 different vertices";
  expect_problem("", none);
  expect_problem(v + "f 1 2\nf 1 2 1\nf\n", none);
  expect_problem(v + "f 1 2 5\n", "line 5: vertex 5 does not exist: 4 have been read");
  expect_problem(v + "f 1 2 -5\n", "line 5: vertex -5 does not exist: 4 have been read");
  expect_problem(v + "f 1/1 2 3\n", "line 5: texture coordinate 1 does not exist: 0 have been read");
  expect_problem(v + "f 1//1 2 3\n", "line 5: normal 1 does not exist: 0 have been read");
  for (const char* corner : {"0", "a", "1/2/3/4", "1.5", "/1"})
    expect_problem(v + "vt 0 0\nf 1 2 " + corner + "\n",
                   std::string(corner) == "1/2/3/4"
                       ? "line 6: texture coordinate 2 does not exist: 1 have been read"
                       : "line 6: \"" + std::string(corner) +
                             "\" is no corner of a face; valid: v, v/vt, v//vn and v/vt/vn, counted from 1");
  expect_problem("v 1 2\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "line 1: \"v\" has 2 numbers, it needs 3 to 7");
  expect_problem("v 1 2 inf\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "line 1: vertex 1: z is inf, not a finite number");
}

}  // namespace
}  // namespace etd
