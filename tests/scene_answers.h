// Scenes that carry the answer to their own integral: an analytic scene is a pbrt file whose comments say what must be
// measured, so that scene, derivation and constant stand together. Besides prose, the comments may hold
//
//   # answer: QUANTITY = VALUE [in X0,X1,Y0,Y1]
//       QUANTITY is beauty, emission, direct or indirect, followed by .R, .G or .B, or by nothing for the mean of the
//       three; measured is the mean over all pixels or over those in [X0, X1) x [Y0, Y1).
//   # mode: NAME SPP [SPP_SOBOL]
//       a mode of the path integrator (naive, next_event, mis) that converges to the answers, and how many samples per
//       pixel it takes for an error of 1 % in any of them to be seen, with the independent sampler and with Sobol's.
//
// Resolution and everything else are the scene's own.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "render_helper.h"

namespace etd {

struct SceneAnswer {
  std::string what;  // the line as it stands in the file
  Quantity quantity;
  double value = 0;
  std::optional<PixelBounds> region;
};

struct SceneMode {
  std::string name;
  uint32_t spp = 0, spp_sobol = 0;
};

struct AnsweredScene {
  std::filesystem::path file;
  std::vector<SceneAnswer> answers;
  std::vector<SceneMode> modes;
  std::string problem;  // of the comments; empty if there is none
};

// What the comments say, be it nothing.
AnsweredScene read_comments(const std::filesystem::path& file);
// The same; without an answer and a mode there is a problem.
AnsweredScene read_answers(const std::filesystem::path& file);
// All scenes of a folder, by name.
std::vector<AnsweredScene> answered_scenes(const std::filesystem::path& folder);

}  // namespace etd
