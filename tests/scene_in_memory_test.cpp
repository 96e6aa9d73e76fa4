// Scenes whose meshes and images were made in code: they must look like those that come from files.
#include <gtest/gtest.h>

#include "formats/pbrt/reader.h"
#include "io/pfm.h"
#include "model_uses.h"
#include "render_helper.h"
#include "same_bits.h"
#include "scene/compile.h"
#include "temp_folder.h"

namespace etd {
namespace {

const std::string kView = R"(
Film "rgb" "integer xresolution" 16 "integer yresolution" 12
LookAt 0 0 4  0 0 0  0 1 0
Camera "perspective" "float fov" 40
WorldBegin
LightSource "infinite" "rgb L" [ 0.4 0.5 0.6 ]
LightSource "point" "point3 from" [ 1 2 3 ] "rgb I" [ 9 8 7 ]
)";

// Places in the description refer to `diagnostics`.
SceneDescription read(const std::string& world, const TempFolder& folder, Diagnostics& diagnostics) {
  SceneDescription scene = read_pbrt_text(kView + world, "test.pbrt", folder.path(), diagnostics);
  EXPECT_FALSE(diagnostics.has_errors()) << diagnostics.format_all();
  return scene;
}

SceneDescription read(const std::string& world, const TempFolder& folder) {
  Diagnostics diagnostics;
  return read(world, folder, diagnostics);
}

RenderOverrides overrides() {
  RenderOverrides o;
  o.spp = 8;
  o.seed = 1;
  return o;
}

TEST(SceneInMemory, AMeshLooksLikeItsFile) {
  const TempFolder folder;
  folder.write("a.obj",
               "v -1 -1 0\nv 1 -1 0.25\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0.5 1\nvt 0.5 0.5\nvn 0 0.1 1\n"
               "vn 0.2 0 1\nvn 0 -0.1 1\nvn 0 0 1\nf 1/1/1 2/2/2 4/4/4\nf 2/2/2 3/3/3 4/4/4\nf 3/3/3 1/1/1 4/4/4\n");
  const SceneDescription file = read(
      "Texture \"c\" \"spectrum\" \"checkerboard\" \"float uscale\" 4 \"float vscale\" 4\n"
      "Material \"diffuse\" \"texture reflectance\" \"c\"\nShape \"objmesh\" \"string filename\" \"a.obj\"\n",
      folder);
  ASSERT_EQ(file.shapes.size(), 1u);

  MeshData mesh;
  mesh.positions = {{-1, -1, 0}, {1, -1, 0.25}, {0, 0, 1}, {0, 1, 0}};
  mesh.normals = {{0, 0.1f, 1}, {0.2f, 0, 1}, {0, 0, 1}, {0, -0.1f, 1}};
  mesh.uvs = {{0, 0}, {1, 0}, {0.5f, 0.5f}, {0.5f, 1}};
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}, {3, 0, 2}};
  SceneDescription made = file;
  made.shapes[0].use = use_of("trianglemesh");
  made.shapes[0].mesh = std::make_shared<const MeshData>(std::move(mesh));
  expect_same_bits(render_description(made, overrides()), render_description(file, overrides()));
}

TEST(SceneInMemory, AnImageLooksLikeItsFile) {
  std::vector<float> texels;
  for (int i = 0; i < 8 * 8 * 3; ++i) texels.push_back(static_cast<float>(i * 37 % 64) / 64);
  for (const char* filter : {"bilinear", "trilinear"}) {
    const std::string world = std::string("Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"a.pfm\"") +
                              " \"string filter\" \"" + filter +
                              "\"\nMaterial \"diffuse\" \"texture reflectance\" \"t\"\nShape \"sphere\"\n";
    const TempFolder folder, without_file, cache;
    folder.write("a.pfm", encode_pfm(8, 8, texels));
    SceneDescription made = read(world, without_file);
    made.images["a.pfm"] = std::make_shared<const Image>(8, 8, 3, texels);
    const Film expected = render_description(read(world, folder), overrides());
    expect_same_bits(render_description(made, overrides()), expected);

    // It stays where it is however little memory is left for files.
    RenderOverrides no_memory = overrides();
    no_memory.texture_memory = 0;
    no_memory.texture_cache = cache.path();
    expect_same_bits(render_description(made, no_memory), expected);
    EXPECT_EQ(cache.entries(), 0);
  }
}

TEST(SceneInMemory, LayersOfTexturesAreNotSilentlyIgnored) {
  const TempFolder folder;
  Diagnostics diagnostics;
  SceneDescription scene = read(R"(Texture "t" "spectrum" "imagemap" "string filename" "a.exr" "string layer" "x"
Material "diffuse" "texture reflectance" "t"
Shape "sphere"
)",
                                folder, diagnostics);
  scene.images["a.exr"] = std::make_shared<const Image>(2, 2, 3, std::vector<float>(12, 0.5f));
  EXPECT_TRUE(compile(scene, {.width = 16, .height = 12}, diagnostics).scene);
  EXPECT_NE(diagnostics.format_all().find("\"layer\" changes nothing: image \"a.exr\" is in memory"), std::string::npos)
      << diagnostics.format_all();
}

// Renders the world with "a.pfm" as a file and as an image in memory, and expects the same bits.
void expect_as_file(const std::string& world, int width, int height) {
  SCOPED_TRACE(world);
  std::vector<float> texels;
  for (int i = 0; i < width * height * 3; ++i) texels.push_back(static_cast<float>(i * 37 % 64) / 64);
  const TempFolder folder, without_file;
  folder.write("a.pfm", encode_pfm(width, height, texels));
  SceneDescription made = read(world, without_file);
  made.images["a.pfm"] = std::make_shared<const Image>(width, height, 3, texels);
  const Film expected = render_description(read(world, folder), overrides());
  expect_same_bits(render_description(made, overrides()), expected);
  // The image is what the picture is made of.
  made.images["a.pfm"] = std::make_shared<const Image>(width, height, 3, std::vector<float>(texels.size(), 0.5f));
  EXPECT_NE(picture(render_description(made, overrides())), picture(expected));
}

const std::string kBall = "Material \"diffuse\"\nShape \"sphere\" \"float radius\" 0.7\n";
const std::string kFile = " \"string filename\" \"a.pfm\"\n";

TEST(SceneInMemory, ImagesOfLightsLookLikeTheirFiles) {
  expect_as_file("LightSource \"infinite\"" + kFile + kBall, 8, 8);
  expect_as_file("LightSource \"infinite\"" + kFile + kBall, 8, 4);
  expect_as_file("LightSource \"infinite\" \"point3 portal\" [ -1 -1 2  -1 1 2  1 1 2  1 -1 2 ]" + kFile + kBall, 8, 8);
  const std::string above = "AttributeBegin\nTranslate 0 0 3\nRotate 180 0 1 0\n";
  expect_as_file(above + "LightSource \"goniometric\" \"rgb I\" [ 9 9 9 ]" + kFile + "AttributeEnd\n" + kBall, 8, 8);
  expect_as_file(above + "LightSource \"projection\" \"float scale\" 9" + kFile + "AttributeEnd\n" + kBall, 6, 4);
  const std::string emits = "AreaLightSource \"diffuse\" \"bool twosided\" true" + kFile;
  expect_as_file(emits + kBall, 6, 4);
  expect_as_file(emits +
                     "Shape \"trianglemesh\" \"point3 P\" [ -1 -1 0  1 -1 0  0 1 0 ] \"point2 uv\" [ 0 0  1 0  0 1 ]\n"
                     "Shape \"bilinearmesh\" \"point3 P\" [ -1 -1 1  1 -1 1  -1 -0.8 1  1 -0.8 1 ]\n",
                 6, 4);
}

TEST(SceneInMemory, AnApertureLooksLikeItsFile) {
  const TempFolder folder, without_file;
  std::vector<float> texels(4 * 6, 0.0f);
  for (size_t i = 0; i < texels.size(); i += 5) texels[i] = static_cast<float>(i + 1);
  std::vector<float> rgb;
  for (const float t : texels) rgb.insert(rgb.end(), 3, t);
  folder.write("a.pfm", encode_pfm(4, 6, rgb));
  for (const std::string camera : {"perspective", "orthographic"}) {
    const auto with_lens = [&](SceneDescription scene) {
      Param radius = number("lensradius", 0.5), aperture = text("aperture", "a.pfm");
      scene.camera = use_of(camera, {radius, number("focaldistance", 2), aperture});
      return scene;
    };
    const Film expected = render_description(with_lens(read(kBall, folder)), overrides());
    SceneDescription made = with_lens(read(kBall, without_file));
    made.images["a.pfm"] = std::make_shared<const Image>(4, 6, 3, rgb);
    expect_same_bits(render_description(made, overrides()), expected);
  }
}

// Light that is not finite would spoil everything, wherever its image comes from.
TEST(SceneInMemory, ImagesOfLightsAreMended) {
  const TempFolder folder;
  Diagnostics diagnostics;
  SceneDescription scene = read("LightSource \"infinite\" \"string layer\" \"x\"" + kFile + kBall, folder, diagnostics);
  std::vector<float> texels(8 * 4 * 3, 1.0f);
  texels[3] = std::numeric_limits<float>::quiet_NaN();
  scene.images["a.pfm"] = std::make_shared<const Image>(8, 4, 3, texels);
  EXPECT_TRUE(compile(scene, {.width = 16, .height = 12}, diagnostics).scene);
  EXPECT_NE(diagnostics.format_all().find("its texel (1, 0) is not finite"), std::string::npos);
  EXPECT_NE(diagnostics.format_all().find("\"layer\" changes nothing"), std::string::npos);
  scene.images["a.pfm"] =
      std::make_shared<const Image>(8, 4, 3, std::vector<float>(8 * 4 * 3, std::numeric_limits<float>::infinity()));
  EXPECT_FALSE(compile(scene, {.width = 16, .height = 12}, diagnostics).scene);
}

}  // namespace
}  // namespace etd
