// EXR files of several parts and layers wherever a picture is wanted: in the commands that look at images, in normal
// maps and in openings. One is chosen by the same rules everywhere, or an error lists them.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "cli_fixture.h"
#include "formats/pbrt/reader.h"
#include "image_bytes.h"
#include "io/picture.h"
#include "render/session.h"
#include "scene/scene.h"

namespace etd {
namespace {

using Box = std::array<int, 4>;
constexpr Box kWindow = {0, 0, 3, 1}, kHalf = {0, 0, 1, 1};

ExrChannel flat(const std::string& name, float value) {
  return {name, [value](int, int) { return value; }, 1};
}
std::vector<ExrChannel> rgb(float first, const std::string& prefix = "") {
  return {flat(prefix + "R", first), flat(prefix + "G", first + 1), flat(prefix + "B", first + 2)};
}
std::vector<ExrChannel> both(std::vector<ExrChannel> a, const std::vector<ExrChannel>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

const std::vector<ExrPart>& depth_first() {
  static const std::vector<ExrPart> parts = {{"depth", kWindow, kWindow, {flat("Z", 9)}, ""},
                                             {"beauty", kWindow, kWindow, rgb(0.25f), ""},
                                             {"direct", kWindow, kWindow, rgb(0.5f, "direct."), ""},
                                             {"stderr", kWindow, kWindow, rgb(0.125f, "stderr."), ""},
                                             {"crop", kHalf, kWindow, rgb(2, "crop."), ""}};
  return parts;
}
const std::vector<ExrPart>& two_eyes() {
  static const std::vector<ExrPart> parts = {{"left", kWindow, kWindow, both(rgb(0.25f), rgb(0.5f, "direct.")), ""},
                                             {"right", kWindow, kWindow, both(rgb(0.75f), rgb(1, "direct.")), ""}};
  return parts;
}

std::vector<float> first_pixel(const LayersResult& read) {
  if (!read.image) return {};
  std::vector<float> rgb = layer_rgb(*read.image, read.layer).rgb;
  rgb.resize(std::min<size_t>(rgb.size(), 3));
  return rgb;
}

TEST(ImageParts, ThePictureIsChosenAndOtherPartsAreBesideIt) {
  const TempFolder folder;
  const auto file = folder.write("a.exr", exr_bytes(depth_first()));
  const LayersResult picture = read_any_layers(file);
  EXPECT_EQ(first_pixel(picture), (std::vector<float>{0.25f, 1.25f, 2.25f})) << picture.error;
  EXPECT_TRUE(picture.is_picture);
  ASSERT_TRUE(picture.image);
  // Those of the same pixels: channels without a layer are called by their part.
  EXPECT_EQ(picture.image->channels, (std::vector<std::string>{"R", "G", "B", "depth.Z", "direct.R", "direct.G",
                                                               "direct.B", "stderr.R", "stderr.G", "stderr.B"}));
  EXPECT_EQ(picture.image->plane("depth.Z"), std::vector<float>(8, 9));
  EXPECT_EQ(picture.image->plane("stderr.B"), std::vector<float>(8, 2.125f));
  const LayersResult depth = read_any_layers(file, "depth");
  EXPECT_EQ(first_pixel(depth), (std::vector<float>{9, 9, 9}));
  EXPECT_FALSE(depth.is_picture);
  const LayersResult crop = read_any_layers(file, "crop");
  EXPECT_EQ(first_pixel(crop), (std::vector<float>{2, 3, 4}));
  EXPECT_EQ(crop.image.value().width, 2);
  EXPECT_EQ(read_any_layers(file, "dirct").error,
            "it has no part or layer \"dirct\", but \"depth\" (Z), \"beauty\" (R, G, B), \"direct\" (R, G, B), "
            "\"stderr\" (R, G, B), \"crop\" (R, G, B)\n  did you mean \"direct\"?");
  const PartsResult parts = read_parts(file);
  ASSERT_EQ(parts.parts.size(), 5u) << parts.error;
  EXPECT_EQ(parts.parts[4].name, "crop");
  EXPECT_EQ(parts.parts[4].width, 2);
  EXPECT_EQ(read_parts(folder.path() / "none.exr").error, "the file does not exist");
}

TEST(ImageParts, WhereSeveralWouldDoOneIsNamed) {
  const TempFolder folder;
  const auto file = folder.write("a.exr", exr_bytes(two_eyes()));
  EXPECT_EQ(read_any_layers(file).error,
            "it has several parts or layers, \"left\" (R, G, B), \"right\" (R, G, B)\n  --layer NAME says which one to "
            "take");
  const LayersResult right = read_any_layers(file, "right");  // its picture, not the layer beside it
  EXPECT_EQ(first_pixel(right), (std::vector<float>{0.75f, 1.75f, 2.75f})) << right.error;
  EXPECT_EQ(right.image.value().find("direct.R") >= 0, true);
  EXPECT_EQ(right.image.value().channels.size(), 6u);
  EXPECT_EQ(read_any_layers(file, "direct").error,
            "it has several parts or layers \"direct\", but \"left\" (R, G, B), \"left.direct\" (R, G, B), \"right\" "
            "(R, G, B), \"right.direct\" (R, G, B)\n  PART.LAYER says which one to take");
  EXPECT_EQ(first_pixel(read_any_layers(file, "right.direct")), (std::vector<float>{1, 2, 3}));
  const auto none = folder.write("b.exr", exr_bytes({{"", kWindow, kWindow, {flat("U", 1), flat("V", 2)}, ""}}));
  EXPECT_EQ(layer_rgb(*read_any_layers(none).image, "").error, "the image has not the channels of a picture, but U, V");
  const auto grey = folder.write("c.exr", exr_bytes({{"", kWindow, kWindow, {flat("Y", 1), flat("A", 2)}, ""}}));
  EXPECT_EQ(first_pixel(read_any_layers(grey)), (std::vector<float>{1, 1, 1}));
}

class ImagePartsCli : public Cli {};

TEST_F(ImagePartsCli, TonemapAndDiffChooseAsTexturesDo) {
  folder_.write("a.exr", exr_bytes(depth_first()));
  folder_.write("eyes.exr", exr_bytes(two_eyes()));
  folder_.write("plain.exr", exr_bytes({{"", kWindow, kWindow, rgb(0.25f), ""}}));
  folder_.write("direct.exr", exr_bytes({{"", kWindow, kWindow, rgb(0.5f), ""}}));
  ASSERT_EQ(run("tonemap a.exr a.png").exit_code, 0);
  ASSERT_EQ(run("tonemap plain.exr plain.png").exit_code, 0);
  ASSERT_EQ(run("tonemap a.exr direct.png --layer direct").exit_code, 0);
  ASSERT_EQ(run("tonemap direct.exr direct2.png").exit_code, 0);
  EXPECT_EQ(text(folder_.path() / "a.png"), text(folder_.path() / "plain.png"));
  EXPECT_EQ(text(folder_.path() / "direct.png"), text(folder_.path() / "direct2.png"));
  EXPECT_EQ(run("diff a.exr plain.exr").exit_code, 0);
  EXPECT_EQ(run("diff eyes.exr eyes.exr --layer right").exit_code, 0);
  EXPECT_EQ(run("diff a.exr a.exr --layer crop").exit_code, 0);
  for (const std::string command : {"tonemap eyes.exr x.png", "diff eyes.exr eyes.exr", "diff plain.exr eyes.exr"}) {
    const Finished done = run(command);
    EXPECT_EQ(done.exit_code, 2) << command;
    EXPECT_EQ(done.err,
              "etendue: eyes.exr: it has several parts or layers, \"left\" (R, G, B), \"right\" (R, G, B)\n"
              "  --layer NAME says which one to take\n");
  }
  EXPECT_TRUE(has(run("tonemap a.exr x.png --layer dept").err, "did you mean \"depth\"?"));
  EXPECT_TRUE(has(run("tonemap a.exr x.png --alpha --layer direct").err,
                  "a.exr: the layer \"direct\" has no alpha: channels R, G, B and A of its own"));
}

TEST_F(ImagePartsCli, InfoListsTheParts) {
  folder_.write("a.exr", exr_bytes(depth_first()));
  folder_.write("eyes.exr", exr_bytes(two_eyes()));
  const Finished a = run("info a.exr");
  EXPECT_EQ(a.exit_code, 0) << a.err;
  for (const char* line :
       {"parts                     5\n", "picture                   part 2 \"beauty\", unless --layer NAME",
        "part 1                    \"depth\"\npixels                    4x2 at 0,0 of 4x2\nchannels                  "
        "Z\n",
        "part 5                    \"crop\"\npixels                    2x2 at 0,0 of 4x2\n"})
    EXPECT_TRUE(has(a.out, line)) << line << "\n" << a.out;
  const Finished eyes = run("info eyes.exr");
  EXPECT_EQ(eyes.exit_code, 0);
  EXPECT_TRUE(has(eyes.out, "it has several parts or layers, \"left\" (R, G, B), \"right\" (R, G, B)")) << eyes.out;
}

// What a render writes of itself into each part that it is split into.
std::string render_attributes(const std::string& scene, const std::string& seed) {
  const auto text = [](const std::string& name, const std::string& value) {
    return exr_attribute("etendue:" + name, "string", value);
  };
  return text("scene_path", scene) + text("scene_hash", "0") + text("version", "0") +
         text("options", R"(["--seed",")" + seed + R"("])") + text("strongest", "[]");
}

TEST_F(ImagePartsCli, ReplayTakesThePartThatKnowsItsRender) {
  const std::string scene = folder_.write("s.pbrt", kScene).string(), one = render_attributes(scene, "1"),
                    two = render_attributes(scene, "2");
  const auto write = [&](const char* name, const std::string& first, const std::string& second) {
    folder_.write(name,
                  exr_bytes({{"left", kWindow, kWindow, rgb(1), first}, {"right", kWindow, kWindow, rgb(2), second}}));
  };
  write("second.exr", "", two);
  write("same.exr", two, two);
  write("both.exr", one, two);
  const std::string sample = " --pixel 11,7 --sample 3";
  const std::string by_scene = run("replay s.pbrt --seed 2" + sample).out;
  EXPECT_NE(by_scene, "");
  for (const char* image : {"second.exr", "same.exr", "both.exr --layer right"})
    EXPECT_EQ(run("replay " + std::string(image) + sample).out, by_scene) << image;
  for (const auto& [arguments, message] : std::vector<std::pair<std::string, std::string>>{
           {"both.exr", "both.exr: its parts \"left\", \"right\" were rendered in different ways\n  --layer NAME"},
           {"both.exr --layer middle", "it has no part \"middle\", but \"left\", \"right\""},
           {"second.exr --layer left", "do not say how etendue rendered it"},
           {"s.pbrt --layer left", "--layer is for images"}}) {
    const Finished done = run("replay " + arguments + sample);
    EXPECT_EQ(done.exit_code, 2) << arguments;
    EXPECT_TRUE(has(done.err, message)) << arguments << "\n" << done.err;
  }
}

// A scene with this camera and material, compiled: what was said of it.
std::string messages_of(const TempFolder& folder, const std::string& camera, const std::string& material) {
  folder.write("eyes.exr", exr_bytes(two_eyes()));
  Diagnostics diagnostics;
  const SceneDescription scene =
      read_pbrt(folder.write("s.pbrt", fmt::format("Film \"rgb\" \"integer xresolution\" 4 \"integer yresolution\" 4\n"
                                                   "Camera \"perspective\" {}\nWorldBegin\nLightSource \"infinite\"\n"
                                                   "Material \"diffuse\" {}\nShape \"sphere\"\n",
                                                   camera, material)),
                diagnostics);
  prepare_render(scene, {}, diagnostics);
  return diagnostics.format_all();
}

TEST(ImageParts, NormalMapsAndOpeningsNameTheirs) {
  const TempFolder folder;
  const std::string lens = "\"float lensradius\" 0.1 \"float focaldistance\" 3 ", map = "\"string normalmap\" ",
                    opening = lens + "\"string aperture\" ", hint = "\"string layer\" beside the file's name";
  EXPECT_EQ(messages_of(folder, opening + "\"eyes.exr\" \"string layer\" \"left\"", ""), "");
  EXPECT_EQ(messages_of(folder, "", map + "\"eyes.exr\" \"string layer\" \"right.direct\""), "");
  for (const auto& [camera, material] :
       std::vector<std::pair<std::string, std::string>>{{opening + "\"eyes.exr\"", ""}, {"", map + "\"eyes.exr\""}}) {
    const std::string messages = messages_of(folder, camera, material);
    EXPECT_TRUE(has(messages, "it has several parts or layers, \"left\" (R, G, B), \"right\" (R, G, B)")) << messages;
    EXPECT_TRUE(has(messages, hint)) << messages;
  }
  const std::string none = messages_of(folder, opening + "\"eyes.exr\" \"string layer\" \"up\"", "");
  EXPECT_TRUE(has(none, "it has no part or layer \"up\"")) << none;
  for (const auto& [camera, material, file] :
       std::vector<std::array<std::string, 3>>{{opening + "\"star\" \"string layer\" \"left\"", "", "aperture"},
                                               {"\"string layer\" \"left\"", "", "aperture"},
                                               {"", "\"string layer\" \"left\"", "normalmap"}}) {
    const std::string messages = messages_of(folder, camera, material);
    EXPECT_TRUE(has(messages, "warning: \"layer\" changes nothing without a file as \"" + file + "\"")) << messages;
  }
}

}  // namespace
}  // namespace etd
