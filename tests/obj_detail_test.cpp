// Bump and normal maps of OBJ files: light that a tilted diffuse surface reflects is kd cos / pi of what arrives.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "formats/pbrt/reader.h"
#include "io/image_write.h"
#include "io/pfm.h"
#include "render/session.h"
#include "render_helper.h"
#include "scene/scene.h"
#include "spectrum/srgb.h"
#include "temp_folder.h"

namespace etd {
namespace {

// The unit square with its texture coordinates, seen from straight above around its middle, in light that would be
// reflected as 0.5 where it falls straight on the surface.
class ObjDetail : public testing::Test {
 protected:
  ObjDetail() {
    folder_.write("square.obj",
                  "mtllib square.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                  "usemtl m\nf 1/1 2/2 3/3 4/4\n");
    std::vector<float> ramp;
    for (int i = 0; i < 64; ++i) ramp.insert(ramp.end(), 3, (static_cast<float>(i) + 0.5f) / 64);
    folder_.write("ramp.pfm", encode_pfm(64, 1, ramp));
    folder_.write("tilted.pfm", encode_pfm(1, 1, std::vector<float>{0.8f, 0.5f, 0.9f}));  // (0.6, 0, 0.8)
  }

  SceneDescription read(const std::string& detail, std::array<double, 3> light, double size) {
    folder_.write("square.mtl", "newmtl m\nKd .5 .5 .5\n" + detail);
    const std::string text = fmt::format(
        "LookAt {0} {0} 9 {0} {0} 0 0 1 0 Camera \"orthographic\" \"float screenwindow\" [ {1} {2} {1} {2} ]\n"
        "Film \"rgb\" \"integer xresolution\" 4 \"integer yresolution\" 4 PixelFilter \"box\" WorldBegin\n"
        "LightSource \"distant\" \"rgb L\" [ {3} {3} {3} ] \"point3 from\" [ {4} {5} {6} ] \"point3 to\" [ 0 0 0 ]\n"
        "Scale {7} {7} {7} Shape \"objmesh\" \"string filename\" \"square.obj\"",
        0.5 * size, -0.1 * size, 0.1 * size, M_PI, light[0], light[1], light[2], size);
    return read_pbrt_text(text, "test", folder_.path(), diagnostics_);
  }

  // The reflected light, which is the same everywhere.
  float reflected(const std::string& detail, std::array<double, 3> light, double size = 1, float tolerance = 1e-4f) {
    const SceneDescription description = read(detail, light, size);
    EXPECT_FALSE(diagnostics_.has_errors()) << diagnostics_.format_all();
    RenderOverrides overrides;
    overrides.spp = 2;
    const std::vector<float> rgb = picture(render_description(description, overrides));
    for (const float v : rgb) EXPECT_NEAR(v, rgb[0], tolerance) << detail;
    return rgb[0];
  }

  TempFolder folder_;
  Diagnostics diagnostics_;
};

TEST_F(ObjDetail, NormalMapsTiltTowardsU) {
  const std::string map = "norm tilted.pfm\n";
  EXPECT_NEAR(reflected("", {0, 0, 1}), 0.5, 1e-4);
  EXPECT_NEAR(reflected(map, {0, 0, 1}), 0.5 * 0.8, 1e-4);
  EXPECT_NEAR(reflected(map, {0.6, 0, 0.8}), 0.5, 1e-4);
  EXPECT_NEAR(reflected(map, {-0.6, 0, 0.8}), 0.5 * 0.28, 1e-4);
  EXPECT_EQ(diagnostics_.format_all(), "");
}

// 8 bits of a normal map are numbers, not colours.
TEST_F(ObjDetail, NormalMapsAreLinear) {
  const std::array<float, 3> bytes = {204, 128, 230};
  std::vector<float> as_colour, n;
  for (const float b : bytes) {
    as_colour.push_back(srgb_to_linear(b / 255));
    n.push_back(2 * b / 255 - 1);
  }
  ASSERT_EQ(write_rgb(folder_.path() / "n.png", 1, 1, as_colour), "");
  const double cos = n[2] / std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  EXPECT_NEAR(reflected("norm n.png\n", {0, 0, 1}), 0.5 * cos, 1e-4);
}

// A map that holds a tilt in its left half alone.
TEST_F(ObjDetail, OptionsOfNormalMapsMoveThem) {
  folder_.write("half.pfm", encode_pfm(2, 1, std::vector<float>{0.8f, 0.5f, 0.9f, 0.5f, 0.5f, 1.0f}));
  EXPECT_NEAR(reflected("norm -s .01 .01 1 -o .25 0 0 half.pfm\n", {0, 0, 1}, 1, 1e-2f), 0.5 * 0.8, 1e-2);
  EXPECT_NEAR(reflected("norm -s .01 .01 1 -o .75 half.pfm\n", {0, 0, 1}, 1, 1e-2f), 0.5, 1e-2);
  // Outside of the unit square, a clamped map changes nothing.
  EXPECT_NEAR(reflected("norm -clamp on -o 2 0 0 tilted.pfm\n", {0, 0, 1}), 0.5, 1e-4);
  EXPECT_NEAR(reflected("norm -o 2 0 0 tilted.pfm\n", {0, 0, 1}), 0.5 * 0.8, 1e-4);
}

// A height of 0.75 u has the normal (-0.6, 0, 0.8).
TEST_F(ObjDetail, BumpsHaveTheirHeightInUnitsOfTheFile) {
  for (const char* map : {"map_Bump -bm 0.75 ramp.pfm\n", "bump -bm 1.5 -s .5 .5 1 -o .25 0 0 ramp.pfm\n",
                          "map_bump ramp.pfm -bm 0.75\n"})
    for (const double size : {1.0, 2.0}) {
      EXPECT_NEAR(reflected(map, {0, 0, 1}, size), 0.5 * 0.8, 1e-3) << map;
      EXPECT_NEAR(reflected(map, {-0.6, 0, 0.8}, size), 0.5, 1e-3) << map;
    }
  EXPECT_NEAR(reflected("map_Bump -bm -0.75 ramp.pfm\n", {0.6, 0, 0.8}), 0.5, 1e-3);
  EXPECT_NEAR(reflected("map_Bump ramp.pfm\n", {0, 0, 1}), 0.5 / std::sqrt(2.0), 1e-3);
  EXPECT_EQ(diagnostics_.format_all(), "");
}

TEST_F(ObjDetail, TheSameFileTwiceHasHeightsOfItsSizes) {
  folder_.write("square.mtl", "newmtl m\nmap_Bump ramp.pfm\n");
  const SceneDescription other = read_pbrt_text(
      "WorldBegin Shape \"objmesh\" \"string filename\" \"square.obj\" Scale 5 5 5 Shape \"objmesh\" \"string "
      "filename\" \"square.obj\"",
      "two", folder_.path(), diagnostics_);
  ASSERT_EQ(other.materials.size(), 2u);
  EXPECT_NE(other.materials[0].use.find("displacement")->strings, other.materials[1].use.find("displacement")->strings);
}

TEST_F(ObjDetail, TheNormalMapWinsAndSaysSo) {
  EXPECT_NEAR(reflected("map_Bump -bm 9 ramp.pfm\nnorm tilted.pfm\n", {0, 0, 1}), 0.5 * 0.8, 1e-4);
  EXPECT_NE(diagnostics_.format_all().find("materials with a bump and a normal map, the normal map is used: m"),
            std::string::npos)
      << diagnostics_.format_all();
}

// Any material can refer to a texture for its normals.
TEST_F(ObjDetail, NormalMapsMayBeTextures) {
  const std::string text =
      "LookAt 0 0 9 0 0 0 0 1 0 Camera \"orthographic\" Film \"rgb\" \"integer xresolution\" 2 \"integer yresolution\" "
      "2\nWorldBegin LightSource \"distant\" \"rgb L\" [ 3.14159265 3.14159265 3.14159265 ] \"point3 from\" [ 0 0 1 ] "
      "\"point3 to\" [ 0 0 0 ]\nTexture \"n\" \"spectrum\" \"constant\" \"rgb value\" [ 0.8 0.5 0.9 ]\n"
      "Material \"diffuse\" \"texture normalmap\" \"n\" Scale 9 9 9\nShape \"bilinearmesh\" \"point3 P\" "
      "[ -1 -1 0 1 -1 0 -1 1 0 1 1 0 ]";
  RenderOverrides overrides;
  overrides.spp = 2;
  EXPECT_NEAR(picture(render_text(text, ".", overrides))[0], 0.5 * 0.8, 1e-4);
  Diagnostics wrong;
  SceneDescription bad = read_pbrt_text(
      "WorldBegin Material \"diffuse\" \"texture normalmap\" \"gone\" Shape \"sphere\"", "test", ".", wrong);
  EXPECT_FALSE(prepare_render(bad, {}, wrong));
  EXPECT_NE(wrong.format_all().find("there is no spectrum texture \"gone\""), std::string::npos) << wrong.format_all();
}

}  // namespace
}  // namespace etd
