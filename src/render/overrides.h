// Values that the command line (or a caller in code) puts in place of a scene's own: text becomes a parameter of the
// declared type, so that it is checked by the same rules and messages as one in a file.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "render/settings.h"

namespace etd {

// Applies "film.NAME", "sampler.NAME" and "integrator.NAME" = text to the three uses. Lists are separated by commas.
// Unknown names and texts that are no value of the declared type are errors.
struct OverridableModels {
  ModelUse& film;
  ModelUse& sampler;
  ModelUse& integrator;
};
void apply_overrides(const std::vector<std::pair<std::string, std::string>>& set, const OverridableModels& models,
                     Diagnostics& diagnostics);

// The options of the command line that stand for these overrides, as far as they decide what the samples of the image
// are: not crop, features, threads, tiles, and limits of time and error.
std::vector<std::string> sample_options(const RenderOverrides& overrides);

}  // namespace etd
