// What a small or broken input can make the program do: no more than in proportion to its size, or a message that names
// a limit. Sizes here would take minutes, or the machine, where work grows faster than the text.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "document_block.h"
#include "formats/pbrt/reader.h"
#include "io/image.h"
#include "io/image_limits.h"
#include "io/obj.h"
#include "scene/compile.h"
#include "scene/info.h"
#include "scene/scene.h"
#include "temp_folder.h"

namespace etd {
namespace {

std::string repeated(std::string_view text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

// A scene that is read and compiled.
struct Compiled {
  explicit Compiled(const std::string& world, const Limits& limits = {}, const std::filesystem::path& folder = ".")
      : diagnostics(false, limits) {
    description = read_pbrt_text("WorldBegin\n" + world, "test.pbrt", folder, diagnostics);
    compiled = compile(description, {.width = 4, .height = 4, .spp = 1, .textures = {}}, diagnostics);
  }
  std::string messages() const { return diagnostics.format_all(); }
  bool says(std::string_view part) const { return messages().find(part) != std::string::npos; }
  size_t shown() const { return diagnostics.all().size(); }

  Diagnostics diagnostics;
  SceneDescription description;
  CompiledScene compiled;
};

// Objects of which each holds two instances of the one before it, around `inside`.
std::string doubling_objects(int levels, const std::string& inside) {
  std::string text = "ObjectBegin \"o0\"\n" + inside + "ObjectEnd\n";
  for (int i = 1; i < levels; ++i)
    text += fmt::format(
        "ObjectBegin \"o{0}\"\nObjectInstance \"o{1}\"\nTranslate 0 3 0\nObjectInstance \"o{1}\"\nObjectEnd\n", i,
        i - 1);
  return text + fmt::format("ObjectInstance \"o{}\"\n", levels - 1);
}

TEST(Growth, InstancesOfInstancesEndAtTheLimit) {
  const std::string moving = "ActiveTransform EndTime\nTranslate 1 0 0\nActiveTransform All\n";
  const std::vector<std::string> insides = {"Shape \"sphere\"\n", "", "AreaLightSource \"diffuse\"\nShape \"sphere\"\n",
                                            "LightSource \"point\"\n", moving + "Shape \"sphere\"\n"};
  for (const std::string& inside : insides) {
    Limits limits;
    limits.copies = 1000;
    const Compiled c(doubling_objects(40, inside), limits);
    EXPECT_TRUE(c.says("make too many copies")) << inside << c.messages();
    EXPECT_TRUE(c.says("the limit is 1000; --limit copies=N raises it")) << inside << c.messages();
    EXPECT_EQ(c.compiled.scene, nullptr);
  }
  const Compiled few(doubling_objects(9, "Shape \"sphere\"\n"));
  ASSERT_NE(few.compiled.scene, nullptr) << few.messages();
  EXPECT_EQ(few.compiled.info->summary.bounds.hi.y, 3 * 8 + 1);
}

TEST(Growth, WhatASceneListsIsNoCopy) {
  Limits limits;
  limits.copies = 10;
  const std::string object = "ObjectBegin \"o\"\nShape \"sphere\"\nShape \"disk\"\nObjectEnd\n";
  const Compiled c(object + repeated("Translate 1 0 0 ObjectInstance \"o\"\n", 1000), limits);
  ASSERT_NE(c.compiled.scene, nullptr) << c.messages();
  EXPECT_EQ(c.compiled.scene->geometry.instances.size(), 1000u);
}

TEST(Growth, DeepNestingIsAnErrorAndNoCrash) {
  std::string objects = "ObjectBegin \"o0\"\nShape \"sphere\"\nObjectEnd\n";
  std::string textures = "Texture \"t0\" \"spectrum\" \"constant\"\n", backwards, mixes;
  constexpr int kLevels = 30'000;
  for (int i = 1; i < kLevels; ++i) {
    objects += fmt::format("ObjectBegin \"o{}\"\nObjectInstance \"o{}\"\nObjectEnd\n", i, i - 1);
    textures += fmt::format("Texture \"t{}\" \"spectrum\" \"scale\" \"texture tex\" \"t{}\"\n", i, i - 1);
    backwards +=
        fmt::format("Texture \"t{}\" \"spectrum\" \"scale\" \"texture tex\" \"t{}\"\n", kLevels - i, kLevels - i - 1);
    mixes += fmt::format("MakeNamedMaterial \"m{}\" \"string type\" \"mix\" \"string materials\" [\"m{}\" \"m0\"]\n",
                         kLevels - i, kLevels - i - 1);
  }
  objects += fmt::format("ObjectInstance \"o{}\"\n", kLevels - 1);
  backwards += "Texture \"t0\" \"spectrum\" \"constant\"\n";
  mixes += "MakeNamedMaterial \"m0\" \"string type\" \"diffuse\"\n";
  for (const std::string& world : {objects, textures, backwards, mixes}) {
    const Compiled c(world);
    EXPECT_TRUE(c.says("is made of too many levels of others")) << c.messages();
    EXPECT_TRUE(c.says("the limit is 1000; --limit nesting=N raises it"));
    EXPECT_FALSE(c.says("there is no"));
  }
}

TEST(Growth, TexturesOfTexturesEndAtTheLimit) {
  std::string textures = "Texture \"t0\" \"spectrum\" \"constant\"\n";
  for (int i = 1; i < 40; ++i)
    textures += fmt::format(
        "Texture \"t{0}\" \"spectrum\" \"mix\" \"texture tex1\" \"t{1}\" \"texture tex2\" \"t{1}\"\n", i, i - 1);
  const Compiled c(textures);
  EXPECT_TRUE(c.says("a lookup of texture \"t9\" asks 1023 textures")) << c.messages();
  EXPECT_TRUE(c.says("the limit is 1000; --limit lookups=N raises it"));
  Limits limits;
  limits.lookups = 1023;
  EXPECT_FALSE(Compiled(textures, limits).says("texture \"t9\" asks"));
}

TEST(Growth, FilesThatIncludeEachOtherEndAtTheLimit) {
  const TempFolder folder;
  for (int i = 0; i < 40; ++i)
    folder.write(fmt::format("{}.pbrt", i), i < 39 ? repeated(fmt::format("Include \"{}.pbrt\"\n", i + 1), 2) : "");
  Limits limits;
  limits.repeated = 1 << 20;
  const Compiled c("Include \"0.pbrt\"", limits, folder.path());
  EXPECT_TRUE(c.says("what is used again from here on is too much")) << c.messages();
  EXPECT_TRUE(c.says("the limit is 1M; --limit repeated=SIZE raises it"));
  EXPECT_EQ(c.diagnostics.error_count(), 1);
}

TEST(Growth, FilesMayIncludeEachOtherDeeply) {
  const TempFolder folder;
  constexpr int kFiles = 2000;
  for (int i = 0; i < kFiles; ++i) {
    const std::string next = fmt::format("\"{}.pbrt\"", i + 1);
    const bool last = i + 1 == kFiles;
    folder.write(fmt::format("{}.pbrt", i), last ? "Shape \"sphere\" Include \"0.pbrt\""
                                                 : fmt::format("CoordinateSystem \"c\" Translate 1 0 0 {} {}",
                                                               i % 2 ? "Import" : "Include", next));
  }
  const Compiled c("Import \"0.pbrt\" Shape \"disk\" CoordSysTransform \"c\"", {}, folder.path());
  // The last file includes the first, and what is imported leaves nothing behind.
  EXPECT_TRUE(c.says("this file includes itself")) << c.messages();
  EXPECT_TRUE(c.says("coordinate system \"c\" is not defined"));
  EXPECT_EQ(c.diagnostics.error_count(), 2);
  ASSERT_EQ(c.description.shapes.size(), 2u);
  EXPECT_EQ(c.description.shapes[0].to_world.start.point({}).x, kFiles - 1);
  EXPECT_TRUE(c.description.shapes[1].to_world.start.is_identity());
}

TEST(Growth, DefaultsOfManyBlocksTakeTheRoomOfTheirText) {
  constexpr int kBlocks = 20'000;
  std::string world;
  for (int i = 0; i < kBlocks; ++i)
    world += fmt::format("AttributeBegin Attribute \"shape\" \"float radius\" {} \"float zmax{}\" 1\n", i + 1, i);
  world += "Shape \"sphere\"\n" + repeated("AttributeEnd\n", kBlocks - 1) +
           "Shape \"sphere\" AttributeEnd\nShape \"sphere\"\n";
  const Compiled c(world);
  ASSERT_EQ(c.messages(), "");
  const std::vector<ShapeDesc>& shapes = c.description.shapes;
  ASSERT_EQ(shapes.size(), 3u);
  EXPECT_EQ(shapes[0].use.find("radius")->numbers[0], kBlocks);
  EXPECT_EQ(shapes[1].use.find("radius")->numbers[0], 1);
  EXPECT_EQ(shapes[2].use.find("radius"), nullptr);
}

TEST(Growth, NumbersOfDefaultsAndSpectraEndAtTheLimit) {
  const TempFolder folder;
  folder.write("flat.spd", repeated("400 1\n", 1) + "500 1\n");
  Limits limits;
  limits.repeated = 1000;
  const std::string spectrum = "Material \"diffuse\" \"spectrum reflectance\" \"flat.spd\"\n";
  const std::string mesh = "Attribute \"shape\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ]\n";
  for (const std::string& world : {repeated(spectrum, 33), mesh + repeated("Shape \"trianglemesh\"\n", 14)}) {
    const Compiled c(world, limits, folder.path());
    EXPECT_TRUE(c.says("what is used again from here on is too much")) << c.messages();
  }
  EXPECT_EQ(Compiled(repeated(spectrum, 32), limits, folder.path()).messages(), "");
}

TEST(Growth, MessagesAreCountedBeyondALimit) {
  constexpr int kMany = 20'000;
  for (const std::string& world :
       {repeated("ObjectBegin \"o\"\n", kMany), repeated("Shape \"sphere\" \"float radius\" -1\n", kMany),
        repeated("Shape \"sphere\" \"float radius\" -1 ", kMany)}) {
    const Compiled c(world);
    EXPECT_GE(c.diagnostics.error_count(), kMany);
    EXPECT_EQ(c.shown(), 100u);
    EXPECT_LT(c.messages().size(), 100'000u);
    EXPECT_TRUE(c.says(fmt::format("{} errors; not all are shown: the limit is 100; --limit messages=N raises it\n",
                                   c.diagnostics.error_count())));
  }
}

TEST(Growth, LongWordsAreCutInMessages) {
  const std::string word(10'000'000, 'S');
  for (const std::string& world :
       {word, "Shape \"" + word + "\"", "Shape \"" + word, "Shape \"sphere\" \"float " + word + "\" 1",
        "Shape \"sphere\" \"" + word + " radius\" 1", "NamedMaterial \"" + word + "\"", "Include \"" + word + "\"",
        "Material \"diffuse\" \"texture reflectance\" \"" + word + "\"", "CoordSysTransform \"" + word + "\"",
        "Material \"diffuse\" \"spectrum reflectance\" \"" + word + "\"",
        "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"" + repeated("a/", 100'000) + "\"",
        "Shape \"" + repeated("\\q", 100'000) + "\""}) {
    const Compiled c(world);
    EXPECT_GT(c.diagnostics.error_count(), 0) << world.substr(0, 50);
    EXPECT_LT(c.diagnostics.error_count(), 5) << world.substr(0, 50);
    EXPECT_LT(c.messages().size(), 10'000u) << world.substr(0, 50);
  }
}

TEST(Growth, WhatFollowsAMistypedDirectiveIsPassedOver) {
  const Compiled c("Shpae \"trianglemesh\" \"point3 P\" [ " + repeated("0.12345 1.5 -2.25 ", 200'000) +
                   "]\nShape \"sphere\"\n");
  EXPECT_TRUE(c.says("did you mean Shape?"));
  EXPECT_EQ(c.diagnostics.error_count(), 1);
  EXPECT_EQ(c.description.shapes.size(), 1u);
}

TEST(Growth, SuggestionsAreLookedForOnlyWhereTheyAreShown) {
  constexpr int kNames = 20'000;
  std::string world;
  for (int i = 0; i < kNames; ++i)
    world += fmt::format(
        "Texture \"t{0:06}\" \"spectrum\" \"constant\"\nMakeNamedMaterial \"m{0:06}\" \"string type\" \"diffuse\"\n",
        i);
  for (int i = 0; i < kNames; ++i)
    world += fmt::format("Material \"diffuse\" \"texture reflectance\" \"x{0:06}\"\nNamedMaterial \"n{0:06}\"\n", i);
  const Compiled c(world);
  EXPECT_EQ(c.diagnostics.error_count(), 2 * kNames);
  EXPECT_TRUE(c.says("did you mean \"m0"));
}

TEST(Growth, ManyParametersOfOneShape) {
  std::string world = "Shape \"sphere\"";
  for (int i = 0; i < 50'000; ++i) world += fmt::format(" \"float x{}\" 1", i);
  world += repeated(" \"float radius\" 1", 50'000);
  const Compiled c(world);
  EXPECT_EQ(c.diagnostics.error_count(), 99'999);
}

// Sizes of terabytes in headers of a few bytes, which the libraries that read them believe.
TEST(Growth, HeadersOfImagesAreHeldAgainstTheirFiles) {
  using namespace std::string_literals;
  const TempFolder folder;
  const auto error = [&](const std::string& name, const std::string& bytes) {
    return read_image(folder.write(name, bytes)).error;
  };
  EXPECT_EQ(error("a.exr", "\x76\x2f\x31\x01\x02\0\0\0owner\0string\0\0\x94\x35\x77RRRRRRRRRRRR"s),
            "the attribute \"owner\" of its header should have 2000000000 bytes, but only 12 follow");
  EXPECT_EQ(error("a.gif", "GIF89a\xff\xff\xff\xff\0\0\0"s).substr(0, 48),
            "its 65535 x 65535 pixels take 16384 MiB in memor");
  EXPECT_EQ(error("a.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 100000 +X 100000\n").substr(0, 51),
            "its 100000 x 100000 pixels take 114441 MiB in memor");
  // A progressive JPEG keeps all its coefficients.
  EXPECT_NE(error("a.jpg", "\xff\xd8\xff\xc2\0\x11\x08\xff\xdc\xff\xdc\x03\1\x22\0\2\x11\0\3\x11\0"s)
                .find("the limit is 256M; --limit unpacked=SIZE raises it"),
            std::string::npos);
  EXPECT_EQ(image_size_problem(100, 100, 3, 30, {}), "");  // small ones may be packed as well as they can
}

TEST(Growth, FacesEndAtTheLimit) {
  const TempFolder folder;
  Limits limits;
  limits.corners = 5;
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  const std::string tail = "the limit is 5; --limit corners=N raises it";
  EXPECT_EQ(read_obj(folder.write("a.obj", vertices + "f 1 2 3 4 1 2\n"), limits).problems.at(0),
            "line 5: \"f\" has too many values; " + tail);
  EXPECT_TRUE(read_obj(folder.write("b.obj", vertices + "f 1 2 3 4\n"), limits).problems.empty());
  const std::string off = "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  EXPECT_EQ(read_off(folder.write("a.off", off + "6 0 1 2 3 0 1\n"), limits).problems.at(0),
            "line 7: a face of too many corners; " + tail);
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  EXPECT_EQ(read_ply(folder.write("a.ply", ply + "6 0 1 2 3 0 1\n"), limits).problems.at(0),
            "line 14: face 0: a face of too many corners; " + tail);
}

TEST(Limits, AreSetByName) {
  Limits limits;
  EXPECT_EQ(set_limit(limits, "copies=5000000"), "");
  EXPECT_EQ(limits.copies, 5'000'000u);
  EXPECT_EQ(set_limit(limits, "unpacked=2G"), "");
  EXPECT_EQ(limits.unpacked, uint64_t{2} << 30);
  EXPECT_EQ(set_limit(limits, "nesting=20000"), "\"20000\" is no value for \"nesting\"; valid: 1 to 10000");
  EXPECT_EQ(set_limit(limits, "copies"), "\"\" is no value for \"copies\"; valid: 1 to 1152921504606846976");
  EXPECT_EQ(set_limit(limits, "unpacked=much"),
            "\"much\" is no value for \"unpacked\"; valid: sizes such as 500M or 2G");
  EXPECT_NE(set_limit(limits, "copy=1").find("sets no limit; valid: messages=N, copies=N"), std::string::npos);
  EXPECT_EQ(limit_text(limits, &Limits::unpacked), "the limit is 2G; --limit unpacked=SIZE raises it");
}

TEST(Limits, TheGuideListsThemAll) {
  std::string table = "| limit | unless raised | what it is of |\n|---|---|---|\n";
  for (const LimitDecl& d : limit_declarations())
    table += fmt::format("| `{}` | {} | {} |\n", d.name, limit_value_text(d, Limits().*(d.value)), d.doc);
  if (updates_expected()) return write_document_block("guide.md", "limits", table);
  EXPECT_EQ(read_document_block("guide.md", "limits").value_or(""), table);
  EXPECT_NE(describe_limits().find("copies     1000000  Shapes and instances"), std::string::npos) << describe_limits();
}

}  // namespace
}  // namespace etd
