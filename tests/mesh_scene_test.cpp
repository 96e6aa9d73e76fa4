// Meshes in scenes: compressed files, the shapes offmesh and objmesh, and a mesh file as a scene of its own.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "formats/mesh/reader.h"
#include "formats/pbrt/reader.h"
#include "io/gzip.h"
#include "io/mesh.h"
#include "render/session.h"
#include "scene/compile.h"
#include "scene/info.h"
#include "scene/scene.h"
#include "temp_folder.h"
#include "verify/statistics/film_mean.h"

namespace etd {
namespace {

// A gzip file that stores its content uncompressed (RFC 1951 and 1952).
std::string gzip(std::string_view text) {
  std::string out("\x1f\x8b\x08\0\0\0\0\0\0\3", 10);
  const auto add = [&out](uint32_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i) & 255u);
  };
  uint32_t crc = ~0u;
  for (const char c : text) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1 ? 0xedb88320u : 0u);
  }
  add(1, 1);
  add(static_cast<uint32_t>(text.size()), 2);
  add(~static_cast<uint32_t>(text.size()), 2);
  out += text;
  add(~crc, 4);
  add(static_cast<uint32_t>(text.size()), 4);
  return out;
}

constexpr const char* kOff = "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 2 3\n";
constexpr const char* kPly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

TEST(Gzip, GivesBackWhatWasCompressed) {
  constexpr unsigned char kThousand[] = {31, 139, 8,  0,   0, 0, 0,   0,   2,  3,  171, 168, 24, 5, 163,
                                         96, 20,  12, 119, 0, 0, 230, 201, 65, 59, 232, 3,   0,  0};  // letters x
  EXPECT_EQ(gunzip({reinterpret_cast<const char*>(kThousand), sizeof(kThousand)}).bytes, std::string(1000, 'x'));
  EXPECT_EQ(gunzip(gzip("one ") + gzip("two") + std::string(100, '\0')).bytes, "one two");
  const std::string packed = gzip(kPly);
  EXPECT_EQ(gunzip(packed.substr(0, packed.size() - 9)).error, "the compressed data end early");
  std::string damaged = packed;
  damaged[packed.size() / 2] = static_cast<char>(damaged[packed.size() / 2] ^ 0x55);
  EXPECT_FALSE(gunzip(damaged).error.empty());
  EXPECT_EQ(uncompressed_ending("a/b.PLY.GZ"), ".ply");
  EXPECT_EQ(uncompressed_ending("a.gz/b.Off"), ".off");
  EXPECT_EQ(uncompressed_ending("b"), "");
}

TEST(Gzip, MeshesMayBeCompressed) {
  const TempFolder folder;
  EXPECT_TRUE(read_ply(folder.write("a.ply.gz", gzip(kPly))).mesh);
  EXPECT_TRUE(read_ply(folder.write("a.ply", gzip(kPly))).mesh);
  EXPECT_TRUE(read_off(folder.write("a.off.gz", gzip(kOff))).mesh);
  EXPECT_EQ(read_ply(folder.write("b.ply.gz", gzip(kPly).substr(0, 50))).problems.at(0),
            "the compressed data end early");
}

struct Compiled {
  Diagnostics diagnostics;
  SceneDescription description;
  std::optional<PreparedRender> prepared;
  std::string messages() const { return diagnostics.format_all(); }
};

void prepare(Compiled& c) {
  RenderOverrides overrides;
  overrides.size = {16, 12};
  overrides.spp = 4;
  c.prepared = prepare_render(c.description, overrides, c.diagnostics);
}

TEST(MeshShapes, OffAndObjInTheLanguage) {
  const TempFolder folder;
  folder.write("a.off", kOff);
  folder.write("m.mtl", "newmtl red\nKd 1 0 0\nd 0.25\nnewmtl lamp\nKd 0 0 0\nKe 2 3 4\n");
  folder.write("a.obj",
               "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl red\nf 1 2 3\nusemtl lamp\nf 1 2 3\n"
               "usemtl gone\nf 1 2 3\n");
  for (const bool materials : {true, false}) {
    Compiled c;
    const std::string text = std::string(
                                 "WorldBegin Material \"conductor\" Shape \"offmesh\" \"string filename\" \"a.off\" "
                                 "Shape \"objmesh\" \"string filename\" \"a.obj\" \"bool materials\" ") +
                             (materials ? "true" : "false");
    c.description = read_pbrt_text(text, "test", folder.path(), c.diagnostics);
    prepare(c);
    ASSERT_TRUE(c.prepared) << c.messages();
    const Scene& scene = *c.prepared->compiled.scene;
    EXPECT_EQ(c.prepared->compiled.info->summary.triangles, 6u);
    EXPECT_EQ(scene.geometry.meshes.size(), materials ? 5u : 2u);
    EXPECT_EQ(scene.lights.size(), materials ? 1u : 0u);
    EXPECT_EQ(c.messages().find("materials that no MTL file has, the current one is used: gone") != std::string::npos,
              materials)
        << c.messages();
    if (!materials) continue;
    EXPECT_EQ(c.description.shapes[1].material, 0);
    EXPECT_EQ(
        c.description.materials[static_cast<size_t>(c.description.shapes[2].material)].use.find("reflectance")->numbers,
        (std::vector<double>{1, 0, 0}));
    EXPECT_EQ(c.description.shapes[4].material, 0);
    EXPECT_EQ(c.description.shapes[2].use.find("alpha")->numbers, std::vector<double>{0.25});
    EXPECT_FALSE(c.description.shapes[3].use.find("alpha"));
  }
}

// Emission of 1 over the part of the picture that a mesh covers, in a window of 4 x 4 with pixels of 1/16.
double covered(const std::string& shape, const std::filesystem::path& folder, std::string& messages) {
  Compiled c;
  c.description = read_pbrt_text(
      "Film \"rgb\" \"integer xresolution\" 64 \"integer yresolution\" 64 LookAt 1 1 3  1 1 0  0 1 0\n"
      "Camera \"orthographic\" \"float screenwindow\" [ -2 2 -2 2 ] PixelFilter \"box\"\nWorldBegin\n"
      "AreaLightSource \"diffuse\" \"bool twosided\" true Shape " +
          shape,
      "test", folder, c.diagnostics);
  RenderOverrides overrides;
  overrides.spp = 2;
  c.prepared = prepare_render(c.description, overrides, c.diagnostics);
  messages = c.messages();
  if (!c.prepared) return -1;
  RenderObserver nobody;
  const FinishedRender done = run_render(*c.prepared, nobody);
  return 16 * image_mean(done.film).mean();
}

TEST(MeshShapes, ConcaveFacesCoverThemselvesFromEveryFirstCorner) {
  const TempFolder folder;
  const std::array<const char*, 6> kL = {"2 1 0", "1 1 0", "1 2 0", "0 2 0", "0 0 0", "2 0 0"};
  for (size_t first = 0; first < 6; ++first) {
    std::string obj, off = "OFF\n6 1 0\n", corners;
    std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    for (size_t i = 0; i < 6; ++i) {
      obj += fmt::format("v {}\n", kL[(first + i) % 6]);
      off += fmt::format("{}\n", kL[(first + i) % 6]);
      ply += fmt::format("{}\n", kL[(first + i) % 6]);
    }
    folder.write("l.obj", obj + "f 1 2 3 4 5 6\n");
    folder.write("l.off", off + "6 0 1 2 3 4 5\n");
    folder.write("l.ply", ply + "6 0 1 2 3 4 5\n");
    for (const char* shape : {"\"objmesh\" \"string filename\" \"l.obj\"", "\"offmesh\" \"string filename\" \"l.off\"",
                              "\"plymesh\" \"string filename\" \"l.ply\""}) {
      std::string messages;
      EXPECT_NEAR(covered(shape, folder.path(), messages), 3.0, 1e-6) << shape << first;
      EXPECT_EQ(messages, "");
    }
  }
}

TEST(MeshShapes, TellsWhatNobodyCanSee) {
  const TempFolder folder;
  folder.write("m.mtl", "newmtl a\nd 0\nnewmtl glass\nd 0\nillum 4\nnewmtl b\nd 1\nTr 1\n");
  const std::string faces = "mtllib m.mtl\nv 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nusemtl glass\nf 1 2 3 4\nusemtl ";
  std::string messages;
  folder.write("a.obj", faces + "a\nf 1 2 3 4\n");
  covered("\"objmesh\" \"string filename\" \"a.obj\"", folder.path(), messages);
  EXPECT_NE(messages.find("a.obj: materials of opacity 0 (d or Tr), which nobody can see: a\n"), std::string::npos)
      << messages;
  folder.write("b.obj", "mtllib m.mtl\nv 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nusemtl b\nf 1 2 3 4\n");
  EXPECT_NEAR(covered("\"objmesh\" \"string filename\" \"b.obj\"", folder.path(), messages), 4.0, 1e-6);
  EXPECT_NE(messages.find("\"b\" has opacity 1"), std::string::npos) << messages;
}

TEST(MeshShapes, FacesOfTwoVerticesAreLeftOutWithOneNote) {
  const TempFolder folder;
  folder.write("a.off", "OFF\n5 4 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n1 1 0\n4 0 1 2 3\n2 0 4\n1 4\n0\n");
  std::string messages;
  EXPECT_NEAR(covered("\"offmesh\" \"string filename\" \"a.off\"", folder.path(), messages), 4.0, 1e-6);
  EXPECT_NE(messages.find("note: a.off: left out: 3 faces of fewer than 3 different vertices, 1 vertex that no face "
                          "uses"),
            std::string::npos)
      << messages;
}

TEST(MeshShapes, ProblemsInFilesAreErrorsAtTheirShape) {
  const TempFolder folder;
  folder.write("a.obj", "v 0 0 0\nf 1 2 3\n");
  Compiled c;
  c.description = read_pbrt_text(
      "WorldBegin Shape \"objmesh\" \"string filename\" \"a.obj\"\nShape \"offmesh\" \"string filename\" \"gone.off\"\n"
      "Shape \"objmesh\" \"string file\" \"a.obj\"",
      "test", folder.path(), c.diagnostics);
  prepare(c);
  EXPECT_FALSE(c.prepared);
  for (const char* part : {"test:1:46: error: a.obj: line 2: vertex 2 does not exist",
                           "gone.off: the file does not exist", "\"objmesh\" takes: filename, materials"})
    EXPECT_NE(c.messages().find(part), std::string::npos) << part << "\n" << c.messages();
}

// However many shapes name a file, and however they write its name.
TEST(MeshShapes, AFileIsReadAndReportedOnce) {
  const TempFolder folder;
  folder.write("a.ply", kPly);
  folder.write("a.obj", "mtllib none.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  folder.write("coloured.off", "COFF\n3 1 0\n0 0 0 1 0 0 1\n1 0 0 1 0 0 1\n0 1 0 1 0 0 1\n3 0 1 2\n");
  folder.write("bad.ply", "ply\n");
  folder.write("bad.obj", "v 0 0 0\nf 1 2 3\n");
  const auto shapes = [](const std::string& text) {
    std::string all;
    for (int i = 0; i < 5; ++i) all += fmt::format("Translate 2 0 0 {}\n", text);
    return all;
  };
  const auto read = [&](const std::string& world, Diagnostics& diagnostics) {
    return read_pbrt(folder.write("s.pbrt", "WorldBegin\nLightSource \"infinite\"\n" + world), diagnostics);
  };
  const auto count = [](const std::string& text, const std::string& word) {
    int n = 0;
    for (size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
    return n;
  };
  {
    Diagnostics diagnostics;
    const SceneDescription scene = read(shapes("Shape \"offmesh\" \"string filename\" \"coloured.off\"") +
                                            shapes("Shape \"offmesh\" \"string filename\" \"./coloured.off\"") +
                                            shapes("Shape \"plymesh\" \"string filename\" \"a.ply\"") +
                                            shapes("Shape \"objmesh\" \"string filename\" \"a.obj\""),
                                        diagnostics);
    for (size_t i = 15; i < 20; ++i) EXPECT_EQ(scene.shapes.at(i).mesh, scene.shapes.back().mesh) << i;
    SceneFiles files;
    const auto prepared = prepare_render(scene, {}, diagnostics, {}, &files);
    ASSERT_TRUE(prepared) << diagnostics.format_all();
    EXPECT_EQ(prepared->compiled.info->summary.triangles, 20u);
    const auto mesh = [&](size_t i) { return files.shapes.at(&scene.shapes.at(i)).mesh; };
    for (size_t i = 1; i < 10; ++i) EXPECT_EQ(mesh(i), mesh(0)) << i;
    for (size_t i = 11; i < 15; ++i) EXPECT_EQ(mesh(i), mesh(10)) << i;
    const std::string messages = diagnostics.format_all();
    EXPECT_EQ(count(messages, "coloured.off: "), 1) << messages;
    EXPECT_EQ(count(messages, "none.mtl"), 1) << messages;
    EXPECT_EQ(count(messages, "materials that no MTL file has"), 1) << messages;
  }
  {
    Diagnostics diagnostics;
    const SceneDescription scene =
        read(shapes("Shape \"plymesh\" \"string filename\" \"bad.ply\"") +
                 shapes("Shape \"objmesh\" \"string filename\" \"bad.obj\"") +
                 shapes("Shape \"objmesh\" \"string filename\" \"bad.obj\" \"bool materials\" false"),
             diagnostics);
    EXPECT_FALSE(prepare_render(scene, {}, diagnostics));
    EXPECT_EQ(diagnostics.error_count(), 3) << diagnostics.format_all();
  }
}

TEST(MeshScene, AMeshFileIsAScene) {
  const TempFolder folder;
  folder.write("m.mtl", "newmtl glass\nillum 4\nNi 1.45\nnewmtl gold\nKd 0 0 0\nKs 1 .8 .3\nNs 50\n");
  const std::filesystem::path files[] = {
      folder.write("a.off", kOff), folder.write("b.PLY.gz", gzip(kPly)),
      folder.write("c.obj", "mtllib m.mtl\nv 5 0 0\nv 6 0 0\nv 5 1 0\nusemtl glass\nf 1 2 3\nusemtl gold\nf 3 2 1\n")};
  for (const auto& file : files) {
    Compiled c;
    c.description = read_mesh_scene(file, c.diagnostics);
    prepare(c);
    ASSERT_TRUE(c.prepared) << c.messages();
    EXPECT_EQ(c.messages(), "");
    RenderObserver nobody;
    const FinishedRender done = run_render(*c.prepared, nobody);
    // The mesh is in the middle of the picture, the ground around it, and everything is lit.
    EXPECT_GT(done.film.sums(0, 11, 0).direct[0], 0.0) << file;
    EXPECT_EQ(done.film.sums(8, 0, 0).emission[0], 0.0) << file;
  }
}

TEST(MeshScene, NoMeshNoScene) {
  Compiled c;
  c.description = read_mesh_scene("gone.off", c.diagnostics);
  prepare(c);
  EXPECT_FALSE(c.prepared);
  EXPECT_NE(c.messages().find("gone.off: the file does not exist"), std::string::npos) << c.messages();
}

}  // namespace
}  // namespace etd
