// What is said about files that are not there.
#include "io/missing_file.h"

#include <gtest/gtest.h>

#include "formats/pbrt/reader.h"
#include "scene/compile.h"
#include "scene/scene.h"
#include "temp_folder.h"

namespace etd {
namespace {

class MissingFile : public ::testing::Test {
 protected:
  MissingFile() {
    std::filesystem::create_directories(folder_.path() / "textures/wood");
    folder_.write("textures/wood/Oak.png", "");
    folder_.write("mesh.ply", "");
  }
  std::string hint(const std::string& name) const { return missing_file_hint({folder_.path()}, name); }
  std::string here() const { return folder_.path().string(); }

  TempFolder folder_;
};

TEST_F(MissingFile, IsSilentAboutWhatIsThere) {
  EXPECT_EQ(hint("mesh.ply"), "");
  EXPECT_EQ(hint("textures/wood/Oak.png"), "");
  EXPECT_EQ(hint("textures"), "");  // another problem, which the reader of the file tells
  EXPECT_EQ(hint(here() + "/mesh.ply"), "");
}

TEST_F(MissingFile, SaysWhereItWasLookedFor) {
  EXPECT_EQ(hint("nothing.png"), "it was looked for in " + here());
  EXPECT_EQ(hint("textures/nothing.png"), "it was looked for in " + here() + "/textures");
  EXPECT_EQ(hint("images/nothing.png"), "it was looked for in " + here() + "/images (no folder)");
  EXPECT_EQ(hint("/nowhere/nothing.png"), "it was looked for in /nowhere (no folder)");
  EXPECT_EQ(missing_file_hint({folder_.path(), folder_.path(), folder_.path() / "textures"}, "a.png"),
            "it was looked for in " + here() + " and in " + here() + "/textures");
  EXPECT_EQ(missing_file_hint({std::filesystem::path()}, "no such file"),
            "it was looked for in " + std::filesystem::current_path().string());
}

TEST_F(MissingFile, FindsWhatWasMeant) {
  for (const char* name :
       {"textures\\wood\\Oak.png", "textures\\wood/oak.png", "C:\\Users\\me\\scene\\textures\\wood\\Oak.png",
        "/elsewhere/scene/textures/wood/Oak.png", "Textures/Wood/OAK.PNG", ".\\textures\\wood\\Oak.png"})
    EXPECT_NE(hint(name).find("\ndid you mean \"textures/wood/Oak.png\"?"), std::string::npos) << hint(name);
  EXPECT_NE(hint("..\\meshes\\mesh.ply").find("did you mean \"mesh.ply\"?"), std::string::npos);
  // A folder is no file.
  EXPECT_EQ(hint("old/textures").find("did you mean"), std::string::npos);
}

// "\n" and "\t" in a scene are the ends of lines and tabs that nobody meant.
TEST_F(MissingFile, KnowsEscapesThatWereFolders) {
  folder_.write("textures/new.png", "");
  EXPECT_NE(hint("textures\new.png").find("did you mean \"textures/new.png\"?"), std::string::npos);
  EXPECT_NE(hint("a\textures\new.png").find("did you mean \"textures/new.png\"?"), std::string::npos);
  EXPECT_NE(hint("a\bunny.ply").find("folders are separated by slashes: \"a/bunny.ply\""), std::string::npos);
}

TEST_F(MissingFile, ExplainsBackslashesWhereNothingIsFound) {
  EXPECT_EQ(hint("C:\\scenes\\absent.png"),
            "it was looked for in " + here() + "\nfolders are separated by slashes: \"scenes/absent.png\"");
}

// Every kind of file that a scene can name.
TEST_F(MissingFile, IsAnsweredInEveryDirective) {
  for (const char* text :
       {"WorldBegin\nInclude \"a\\\\x.pbrt\"", "WorldBegin\nImport \"a\\\\x.pbrt\"",
        "WorldBegin\nShape \"plymesh\" \"string filename\" \"a\\\\x.ply\"",
        "WorldBegin\nShape \"offmesh\" \"string filename\" \"a\\\\x.off\"",
        "WorldBegin\nShape \"objmesh\" \"string filename\" \"a\\\\x.obj\"",
        "WorldBegin\nTexture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"a\\\\x.png\"",
        "WorldBegin\nMaterial \"diffuse\" \"string normalmap\" \"a\\\\x.png\"",
        "WorldBegin\nMaterial \"diffuse\" \"spectrum reflectance\" \"a\\\\x.spd\"",
        "WorldBegin\nLightSource \"infinite\" \"string filename\" \"a\\\\x.exr\"",
        "WorldBegin\nLightSource \"goniometric\" \"string filename\" \"a\\\\x.exr\"",
        "WorldBegin\nLightSource \"projection\" \"string filename\" \"a\\\\x.exr\"",
        "WorldBegin\nAreaLightSource \"diffuse\" \"string filename\" \"a\\\\x.exr\"\nShape \"sphere\"",
        "Camera \"perspective\" \"string aperture\" \"a\\\\x.exr\" \"float lensradius\" 1\nWorldBegin"}) {
    Diagnostics diagnostics;
    EXPECT_FALSE(compile(read_pbrt_text(text, "test", folder_.path(), diagnostics), {16, 16}, diagnostics).scene)
        << text;
    EXPECT_EQ(diagnostics.error_count(), 1) << diagnostics.format_all();
    const std::string all = diagnostics.format_all();
    EXPECT_NE(all.find("it was looked for in " + here()), std::string::npos) << all;
    EXPECT_NE(all.find("folders are separated by slashes: \"a/x."), std::string::npos) << all;
  }
}

}  // namespace
}  // namespace etd
