// The warning that a scene must come out black.
#include <gtest/gtest.h>

#include "formats/pbrt/reader.h"
#include "scene/compile.h"
#include "scene/scene.h"

namespace etd {
namespace {

constexpr const char* kMetal = "Material \"conductor\"\nShape \"sphere\"\n";
constexpr const char* kPoint = "LightSource \"point\"\n";

bool warns(const std::string& world) {
  Diagnostics diagnostics;
  EXPECT_TRUE(compile(read_pbrt_text("WorldBegin\n" + world, "test", ".", diagnostics), {16, 16}, diagnostics).scene)
      << diagnostics.format_all();
  return diagnostics.format_all().find("nothing can be seen") != std::string::npos;
}

TEST(NothingShows, WhenSmoothSurfacesMeetLightsWithoutASize) {
  for (const char* light : {kPoint, "LightSource \"spot\"\n", "LightSource \"distant\"\n",
                            "LightSource \"distant\"\nLightSource \"point\"\n"}) {
    EXPECT_TRUE(warns(std::string(light) + kMetal)) << light;
    EXPECT_TRUE(warns(std::string(light) + "Material \"dielectric\"\nShape \"sphere\"\n" + kMetal)) << light;
    EXPECT_TRUE(warns(std::string(light) + "Material \"thindielectric\"\nShape \"disk\"\n")) << light;
    EXPECT_TRUE(warns(std::string(light) +
                      "MakeNamedMaterial \"a\" \"string type\" \"conductor\"\nMakeNamedMaterial \"b\" \"string type\" "
                      "\"dielectric\"\nMaterial \"mix\" \"string materials\" [ \"a\" \"b\" ]\nShape \"sphere\"\n"))
        << light;
  }
}

TEST(NothingShows, NotWhenAnythingElseIsThere) {
  EXPECT_FALSE(warns(std::string(kPoint) + "LightSource \"infinite\"\n" + kMetal));
  EXPECT_FALSE(warns(std::string(kPoint) + kMetal + "AreaLightSource \"diffuse\"\nShape \"disk\"\n"));
  EXPECT_FALSE(warns(std::string(kPoint) + kMetal + "Material \"diffuse\"\nShape \"disk\"\n"));
  EXPECT_FALSE(warns(std::string(kPoint) + "Material \"conductor\" \"float roughness\" 0.1\nShape \"sphere\"\n"));
  EXPECT_FALSE(warns(std::string(kPoint) + "Material \"coateddiffuse\" \"float roughness\" 0\nShape \"sphere\"\n"));
  EXPECT_FALSE(warns(std::string(kPoint) +
                     "Texture \"r\" \"float\" \"checkerboard\" \"float tex1\" 0 \"float tex2\" 0.3\n"
                     "Material \"conductor\" \"texture roughness\" \"r\"\nShape \"sphere\"\n"));
  EXPECT_FALSE(warns(kMetal));
  EXPECT_FALSE(warns(kPoint));
  EXPECT_FALSE(warns(std::string(kPoint) + "Material \"conductor\"\nMaterial \"diffuse\"\nShape \"sphere\"\n"));
}

}  // namespace
}  // namespace etd
