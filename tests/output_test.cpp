#include "render/output.h"

#include <gtest/gtest.h>

#include <cstring>

#include "noise_integrator.h"
#include "temp_folder.h"

namespace etd {
namespace {

Film noise(const FilmSettings& settings, uint32_t spp) {
  Film film(settings);
  NoiseIntegrator integrator(settings);
  RenderObserver nobody;
  render(integrator, film, {spp, 2}, nobody);
  return film;
}

const FilmSettings kFilm{.width = 24, .height = 20, .crop = {3, 2, 20, 17}, .replicates = 2};

TEST(Output, ThePictureIsTheSumOfItsLayersBitForBitInTheFile) {
  const TempFolder folder;
  const Film film = noise(kFilm, 6);
  const auto path = folder.path() / "layers.exr";
  ASSERT_EQ(write_output(path, make_layers(film), 0), "");
  const LayersResult read = read_layers(path);
  ASSERT_TRUE(read.image) << read.error;
  EXPECT_EQ(read.image->width, 17);
  EXPECT_EQ(read.image->height, 15);
  EXPECT_EQ(read.image->x, 3);
  EXPECT_EQ(read.image->y, 2);
  EXPECT_EQ(read.image->full_width, 24);
  EXPECT_EQ(read.image->full_height, 20);
  for (const std::string c : {"R", "G", "B"}) {
    const auto picture = read.image->plane(c), emission = read.image->plane("emission." + c),
               direct = read.image->plane("direct." + c), indirect = read.image->plane("indirect." + c);
    ASSERT_EQ(picture.size(), 17u * 15u);
    for (size_t i = 0; i < picture.size(); ++i) {
      const float sum = (emission[i] + direct[i]) + indirect[i];
      ASSERT_EQ(float_bits(picture[i]), float_bits(sum)) << c << ' ' << i;
      ASSERT_GT(picture[i], 0.0f);
    }
  }
}

TEST(Output, LayersAreMeansAndErrors) {
  const Film film = noise(kFilm, 6);
  const LayeredImage image = make_layers(film);
  EXPECT_EQ(image.channels.size(), 24u);
  const size_t i = 4 * 17 + 5;  // pixel 8, 6
  const PixelSums sums = film.total(8, 6);
  EXPECT_EQ(image.plane("direct.G")[i], static_cast<float>(sums.direct[1] / 6));
  EXPECT_EQ(image.plane("albedo.B")[i], static_cast<float>(sums.albedo[2] / 6));
  EXPECT_EQ(image.plane("normal.Z")[i], 1.0f);
  EXPECT_EQ(image.plane("depth.Z")[i], 4.0f);
  EXPECT_EQ(image.plane("coverage.A")[i], 1.0f);
  EXPECT_EQ(image.plane("stderr.Y")[i], static_cast<float>(film.standard_error(8, 6)[3]));
}

TEST(Output, FeaturesCanBeAbsentAndOneSampleHasInfiniteError) {
  FilmSettings settings = kFilm;
  settings.features = false;
  settings.replicates = 1;
  const LayeredImage image = make_layers(noise(settings, 1));
  EXPECT_EQ(image.find("albedo.R"), -1);
  EXPECT_EQ(image.channels.size(), 16u);
  EXPECT_EQ(image.plane("stderr.R")[0], kInfinity);
  // A film that nothing was added to is black, not a division by zero.
  const LayeredImage empty = make_layers(Film(kFilm));
  EXPECT_EQ(empty.plane("R")[0], 0.0f);
  EXPECT_EQ(empty.plane("depth.Z")[0], 0.0f);
}

TEST(Output, OtherFormatsHoldThePicture) {
  const TempFolder folder;
  const LayeredImage image = make_layers(noise(kFilm, 4));
  for (const char* name : {"a.png", "a.jpg", "a.hdr", "a.pfm"}) {
    EXPECT_EQ(write_output(folder.path() / name, image, -3), "") << name;
    EXPECT_GT(std::filesystem::file_size(folder.path() / name), 100u) << name;
  }
  EXPECT_NE(write_output(folder.path() / "absent" / "a.exr", image, 0), "");
}

TEST(Output, MetadataTellHowTheImageWasMade) {
  RenderSettings settings;
  settings.integrator.model = "path";
  settings.seed = 0xffffffffffffffffull;
  RenderResult result;
  result.rays.shadow = 1ull << 40;
  result.stopped_by = StoppedBy::kInterrupt;
  const Metadata data = make_metadata("folder/box.pbrt", settings, "paths end at depth 5", result);
  const auto text = [&data](const std::string& name) -> std::string {
    for (const auto& [key, value] : data)
      if (key == "etendue:" + name && std::holds_alternative<std::string>(value)) return std::get<std::string>(value);
    return "no text of this name";
  };
  EXPECT_EQ(text("scene"), "box.pbrt");
  EXPECT_EQ(text("integrator"), "path");
  EXPECT_EQ(text("integrator.mode"), "mis");
  EXPECT_EQ(text("seed"), "18446744073709551615");
  EXPECT_EQ(text("rays.shadow"), "1099511627776");
  EXPECT_EQ(text("biased"), "paths end at depth 5");
  EXPECT_EQ(text("interrupted"), "true");
  EXPECT_EQ(text("stopped_by"), "interrupt");
  EXPECT_EQ(text("size"), "1280x720");
}

TEST(Output, StoppingByErrorIsABiasAndStoppingByTimeIsNot) {
  RenderSettings settings;
  settings.integrator.model = "path";
  settings.spp_unlimited = true;
  const auto text = [&settings](const std::string& name, const std::string& bias, const RenderResult& result) {
    for (const auto& [key, value] : make_metadata("a.pbrt", settings, bias, result))
      if (key == "etendue:" + name) return std::get<std::string>(value);
    return std::string("nothing of this name");
  };
  RenderResult result;
  result.stopped_by = StoppedBy::kTime;
  EXPECT_EQ(text("stopped_by", "", result), "time");
  EXPECT_EQ(text("biased", "", result), "nothing");
  EXPECT_EQ(text("interrupted", "", result), "false");
  EXPECT_EQ(text("spp_planned", "", result), "unlimited");
  result.error_tests = 2;  // it could have ended earlier
  EXPECT_EQ(text("biased", "", result), "adaptive stopping (the error was tested 2 times)");
  result.error_tests = 1, result.stopped_by = StoppedBy::kError;
  EXPECT_EQ(text("stopped_by", "", result), "error");
  EXPECT_EQ(text("biased", "depth 5", result), "depth 5; adaptive stopping (the error was tested 1 time)");
}

}  // namespace
}  // namespace etd
