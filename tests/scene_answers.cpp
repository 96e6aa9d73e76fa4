#include "scene_answers.h"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace etd {
namespace {

bool parse_answer(const std::string& text, SceneAnswer& answer) {
  std::istringstream in(text);
  std::string quantity, sign, word, rest;
  if (!(in >> quantity >> sign >> answer.value) || sign != "=") return false;
  const std::optional<Quantity> parsed = parse_quantity(quantity);
  if (!parsed) return false;
  answer.what = text;
  answer.quantity = *parsed;
  if (!(in >> word)) return true;
  PixelBounds b;
  char comma[3];
  if (word != "in" || !(in >> b.x0 >> comma[0] >> b.x1 >> comma[1] >> b.y0 >> comma[2] >> b.y1)) return false;
  answer.region = b;
  return !(in >> rest) && std::all_of(comma, comma + 3, [](char c) { return c == ','; });
}

bool parse_mode(const std::string& text, SceneMode& mode) {
  std::istringstream in(text);
  std::string rest;
  if (!(in >> mode.name >> mode.spp)) return false;
  mode.spp_sobol = mode.spp;
  if (!(in >> std::ws).eof() && !(in >> mode.spp_sobol)) return false;
  return !(in >> rest) && mode.spp > 0 && (mode.name == "naive" || mode.name == "next_event" || mode.name == "mis");
}

}  // namespace

AnsweredScene read_comments(const std::filesystem::path& file) {
  AnsweredScene scene{.file = file, .answers = {}, .modes = {}, .problem = {}};
  const std::string answer = "# answer: ", mode = "# mode: ";
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    bool good = true;
    if (line.rfind(answer, 0) == 0)
      good = parse_answer(line.substr(answer.size()), scene.answers.emplace_back());
    else if (line.rfind(mode, 0) == 0)
      good = parse_mode(line.substr(mode.size()), scene.modes.emplace_back());
    if (!good) scene.problem += "not understood: " + line + "\n";
  }
  return scene;
}

AnsweredScene read_answers(const std::filesystem::path& file) {
  AnsweredScene scene = read_comments(file);
  if (scene.answers.empty()) scene.problem += "the scene has no answer\n";
  if (scene.modes.empty()) scene.problem += "the scene names no mode\n";
  return scene;
}

std::vector<AnsweredScene> answered_scenes(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code absent;
  for (const auto& entry : std::filesystem::directory_iterator(folder, absent))
    if (entry.path().extension() == ".pbrt") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<AnsweredScene> scenes;
  for (const auto& file : files) scenes.push_back(read_answers(file));
  return scenes;
}

}  // namespace etd
