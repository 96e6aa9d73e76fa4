// Pins every message that a wrong scene gives: tests/scenes/broken/NAME.pbrt must be answered with exactly the text of
// NAME.expected. With ETENDUE_UPDATE_EXPECTED set, the expected files are rewritten instead. Scenes whose name ends in
// "_allowed" are read with unsupported uses allowed.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "formats/pbrt/reader.h"
#include "places.h"
#include "render/settings.h"
#include "scene/compile.h"
#include "scene/scene.h"

namespace etd {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = source_path("tests/scenes/broken");

std::string slurp(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(kFolder))
    if (entry.path().extension() == ".pbrt") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

// File names in messages are those of this checkout; the expected files name them from the folder of the scenes, which
// they call FOLDER where it stands alone.
std::string with_relative_paths(std::string text) {
  const std::string folder = kFolder.string(), prefix = folder + "/";
  for (size_t at = text.find(prefix); at != std::string::npos; at = text.find(prefix, at))
    text.erase(at, prefix.size());
  for (size_t at = text.find(folder); at != std::string::npos; at = text.find(folder, at))
    text.replace(at, folder.size(), "FOLDER");
  return text;
}

class BrokenScene : public ::testing::TestWithParam<std::string> {};

TEST_P(BrokenScene, SaysExactlyWhatIsWrong) {
  const std::string& name = GetParam();
  const bool allowed = name.size() > 8 && name.substr(name.size() - 8) == "_allowed";
  Diagnostics diagnostics(allowed);
  const SceneDescription scene = read_pbrt(kFolder / (name + ".pbrt"), diagnostics);
  const RenderSettings settings = make_settings(scene, {}, diagnostics);
  compile(scene, {settings.film.width, settings.film.height}, diagnostics);
  EXPECT_EQ(diagnostics.has_errors(), !allowed);
  const std::string messages = with_relative_paths(diagnostics.format_all());
  const fs::path expected = kFolder / (name + ".expected");
  if (std::getenv("ETENDUE_UPDATE_EXPECTED")) {
    std::ofstream(expected, std::ios::binary) << messages;
    return;
  }
  EXPECT_EQ(messages, slurp(expected));
}

INSTANTIATE_TEST_SUITE_P(Pbrt, BrokenScene, ::testing::ValuesIn(scene_names()),
                         [](const auto& scene) { return scene.param; });

}  // namespace
}  // namespace etd
