// Shading normals far from the geometric ones, in pictures.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "render_helper.h"

namespace etd {
namespace {

// A coarse smooth ball in a sky of 1.
std::string coarse_ball(const std::string& material, const std::string& normals) {
  return fmt::format(R"(
Integrator "path" "integer maxdepth" 3 "string shadingnormals" "{}"
Film "rgb" "integer xresolution" 64 "integer yresolution" 64
PixelFilter "box"
LookAt 0.3 -4 0.5  0 0 0  0 0 1
Camera "perspective" "float fov" 31
WorldBegin
LightSource "infinite"
Material {}
Include "../closed/parts/icosahedron.pbrt"
)",
                     normals, material);
}

// How many numbers of the picture are nearly black: below a tenth of the sky.
long count_black(const std::string& material, const std::string& normals) {
  RenderOverrides o;
  o.spp = 16;
  const std::vector<float> rgb = picture(render_text(coarse_ball(material, normals), "tests/scenes/agree", o));
  return std::count_if(rgb.begin(), rgb.end(), [](float x) { return x < 0.1f; });
}

TEST(ShadingNormals, NoBlackEdgesOnACoarseBall) {
  const std::string diffuse = R"("diffuse" "rgb reflectance" [ 1 1 1 ])",
                    mirror = R"("conductor" "rgb reflectance" [ 0.95 0.95 0.95 ])",
                    satin = R"("conductor" "rgb reflectance" [ 0.95 0.95 0.95 ] "float roughness" 0.05)",
                    coat = R"("coateddiffuse" "float roughness" 0)";
  EXPECT_EQ(count_black(diffuse, "exact"), 0);
  EXPECT_GT(count_black(mirror, "exact"), 50);  // what bending is for
  EXPECT_EQ(count_black(coat, "bent"), 0);
  EXPECT_EQ(count_black(mirror, "bent"), 0);
  EXPECT_EQ(count_black(satin, "bent"), 0);
  EXPECT_EQ(count_black(diffuse, "bent"), 0);
}

// No light comes through closed walls, however their normals lean.
TEST(ShadingNormals, AClosedRoomUnderABrightSkyIsDark) {
  for (const char* material : {R"("diffuse" "rgb reflectance" [ 1 1 1 ])", R"("conductor" "float roughness" 0.3)",
                               R"("conductor")", R"("coateddiffuse")"})
    for (const char* normals : {"exact", "bent"}) {
      RenderOverrides o;
      o.spp = 32;
      const Film film = render_text(fmt::format(R"(
Integrator "path" "integer maxdepth" 8 "string shadingnormals" "{}"
Film "rgb" "integer xresolution" 16 "integer yresolution" 16
LookAt 0 -0.9 0  0 0 0  0 0 1
Camera "perspective" "float fov" 90
WorldBegin
LightSource "infinite" "float scale" 1000
LightSource "point" "point3 from" [ 0 0 1.5 ] "float scale" 1000
AttributeBegin
Scale 0.2 0.2 0.2
Texture "wrinkles" "float" "wrinkled"
AttributeEnd
Material {} "texture displacement" "wrinkles"
Include "../closed/parts/box.pbrt"
)",
                                                normals, material),
                                    "tests/scenes/agree", o);
      for (const float x : picture(film)) ASSERT_EQ(x, 0.0f) << material << ' ' << normals;
    }
}

}  // namespace
}  // namespace etd
