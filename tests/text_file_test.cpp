// Every reader of text takes a byte-order mark as no part of it, and says what is wrong with other encodings.
#include "io/text_file.h"

#include <gtest/gtest.h>

#include "formats/pbrt/reader.h"
#include "io/obj.h"
#include "temp_folder.h"

namespace etd {
namespace {

const std::string kMark = "\xef\xbb\xbf";
constexpr const char* kWide = "it is text in UTF-16 or UTF-32; save it as UTF-8";

std::string utf16(std::string_view text, bool little, bool mark) {
  std::string wide = !mark ? "" : little ? "\xff\xfe" : "\xfe\xff";
  for (const char c : text) wide += little ? std::string{c, '\0'} : std::string{'\0', c};
  return wide;
}

TEST(TextFile, MarksInFrontOfATextAreNoPartOfIt) {
  const auto stripped = [](std::string text) {
    EXPECT_EQ(strip_byte_order_mark(text), "");
    return text;
  };
  EXPECT_EQ(stripped(kMark + "v 1"), "v 1");
  EXPECT_EQ(stripped("v 1" + kMark), "v 1" + kMark);
  EXPECT_EQ(stripped(kMark), "");
  for (const std::string text : {"", "v", "\xef\xbb", "ply\n", "\x1f\x8b"}) EXPECT_EQ(stripped(text), text);
  for (const bool little : {false, true})
    for (const bool mark : {false, true}) {
      std::string wide = utf16("v 1 2 3\n", little, mark);
      EXPECT_EQ(strip_byte_order_mark(wide), kWide);
    }
  std::string wider("\0\0\xfe\xff\0\0\0v", 8);
  EXPECT_EQ(strip_byte_order_mark(wider), kWide);
}

constexpr const char* kObj = "v 0 0 7\nv 1 0 0\nv 0 1 0\nmtllib m.mtl\nusemtl a\nf 1 2 3\n";
constexpr const char* kOff = "OFF\n3 1 0\n0 0 7\n1 0 0\n0 1 0\n3 0 1 2\n";
constexpr const char* kPly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 7\n1 0 0\n0 1 0\n3 0 1 2\n";

TEST(TextFile, MeshesAndMaterialsMayHaveMarks) {
  const TempFolder folder;
  folder.write("m.mtl", kMark + "newmtl a\nKd 1 0 0\n");
  const ObjResult obj = read_obj(folder.write("a.obj", kMark + kObj));
  ASSERT_EQ(obj.parts.size(), 1u) << obj.problems.at(0);
  EXPECT_EQ(obj.parts[0].mesh.positions.at(0), (Point3d{0, 0, 7}));
  EXPECT_EQ(obj.notes, std::vector<std::string>{});
  ASSERT_TRUE(obj.find("a"));
  EXPECT_EQ(obj.find("a")->kd, (Vec3{1, 0, 0}));

  MeshResult off = read_off(folder.write("a.off", kMark + kOff));
  ASSERT_TRUE(off.mesh) << off.problems.at(0);
  EXPECT_EQ(off.notes, std::vector<std::string>{});
  MeshResult ply = read_ply(folder.write("a.ply", kMark + kPly));
  ASSERT_TRUE(ply.mesh) << ply.problems.at(0);
  EXPECT_EQ(ply.mesh->positions.at(0), (Point3d{0, 0, 7}));

  for (const bool little : {false, true}) {
    EXPECT_EQ(read_obj(folder.write("a.obj", utf16(kObj, little, true))).problems, std::vector<std::string>{kWide});
    EXPECT_EQ(read_off(folder.write("a.off", utf16(kOff, little, true))).problems, std::vector<std::string>{kWide});
    EXPECT_EQ(read_ply(folder.write("a.ply", utf16(kPly, little, true))).problems, std::vector<std::string>{kWide});
    folder.write("m.mtl", utf16("newmtl a\nKd 1 0 0\n", little, true));
    EXPECT_EQ(read_obj(folder.write("a.obj", kObj)).notes,
              std::vector<std::string>{std::string("line 4: cannot read \"m.mtl\": ") + kWide});
  }
}

TEST(TextFile, ScenesIncludedFilesAndSpectraMayHaveMarks) {
  const TempFolder folder;
  folder.write("light.spd", kMark + "400 1\n700 2\n");
  folder.write("part.pbrt", kMark + "LightSource \"point\" \"spectrum I\" \"light.spd\"\n");
  Diagnostics diagnostics;
  const SceneDescription scene =
      read_pbrt(folder.write("a.pbrt", kMark + "WorldBegin Include \"part.pbrt\" Shape \"sphere\"\n"), diagnostics);
  ASSERT_EQ(scene.lights.size(), 1u) << diagnostics.format_all();
  EXPECT_EQ(scene.lights[0].use.find("I")->numbers, (std::vector<double>{400, 1, 700, 2}));
  ASSERT_EQ(scene.shapes.size(), 1u) << diagnostics.format_all();
  EXPECT_EQ(scene.shapes[0].use.loc.column, 38);  // counted without the mark
  EXPECT_EQ(diagnostics.error_count(), 0) << diagnostics.format_all();

  folder.write("part.pbrt", utf16("LightSource \"point\"\n", true, true));
  read_pbrt(folder.path() / "a.pbrt", diagnostics);
  EXPECT_NE(diagnostics.format_all().find(kWide), std::string::npos) << diagnostics.format_all();
}

}  // namespace
}  // namespace etd
