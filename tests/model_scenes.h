// Small scenes in tests/scenes/models/, one for each model and for each of its parameters that changes the picture. The
// name of the file says what it shows:
//
//   FAMILY-MODEL.pbrt                   the model with its defaults, "material-conductor.pbrt"
//   FAMILY-MODEL-PARAMETER.pbrt         one parameter of it, "material-conductor-roughness.pbrt"
//   FAMILY-MODEL-PARAMETER-VALUE.pbrt   one of the values to choose from, "texture-imagemap-wrap-black.pbrt"
//
// Comments "# mode: NAME SPP" (scene_answers.h) name the modes in which it converges, "mis" always, and the samples of
// the fast test. NAME.expected beside it holds the means of the picture and of its blocks of 4 x 4 pixels, rendered in
// mode "mis" with very many more samples.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "film/film.h"
#include "params/declaration.h"
#include "scene/description.h"
#include "scene_answers.h"
#include "verify/statistics/statistics.h"

namespace etd {

struct ModelScene {
  std::filesystem::path file;
  Family family = Family::kShape;
  std::string model, parameter, value;  // the last two may be empty
  std::vector<SceneMode> modes;
  std::string problem;  // of name and comments; empty if there is none
};

// All of them, by name.
std::vector<ModelScene> model_scenes();
// "arealight" and the like: the family as file names have it.
std::string file_word(Family family);

// Calls `f` for every use of a model in the scene.
void for_each_use(SceneDescription& scene, const std::function<void(Family, ModelUse&)>& f);

struct RegionMeans {
  PixelBounds region;
  std::array<MeanEstimate, 3> rgb;
};

// Returns the means of the whole picture, then those of each block.
std::vector<RegionMeans> region_means(const Film& film);
// The means stand in a text file, a line for each region. A file that does not exist or is none of these reads as
// empty.
void write_means(const std::filesystem::path& file, const std::vector<RegionMeans>& means);
std::vector<RegionMeans> read_means(const std::filesystem::path& file);

}  // namespace etd
