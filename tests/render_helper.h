// Renders scenes in tests, and turns films into the numbers that tests compare.
//
// The replicates of a film are independent renders, so the mean of anything over a region is, from replicate to
// replicate, a sample of independent numbers of the same normal distribution (each is a mean over very many paths):
// what t-tests ask for, whatever the sampler does within a replicate and however pixels differ.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/bounds.h"
#include "film/film.h"
#include "render/settings.h"
#include "verify/statistics.h"

namespace etd {

// A file of the project, such as "tests/scenes/closed/sky.pbrt".
std::filesystem::path source_path(const std::string& relative);

// Render a pbrt scene to the end. Anything wrong with scene or overrides throws std::runtime_error with all messages.
Film render_scene(const std::filesystem::path& file, const RenderOverrides& overrides);
Film render_description(const SceneDescription& description, const RenderOverrides& overrides);
// `folder` is where relative file names in the text start, "tests/scenes/agree" for example.
Film render_text(const std::string& text, const std::string& folder, const RenderOverrides& overrides);

// A part of the light, in one channel or as the mean of R, G and B.
struct Quantity {
  enum class Component { kBeauty, kEmission, kDirect, kIndirect };
  Component component = Component::kBeauty;
  std::optional<int> channel;
};
// "beauty", "direct.G" and the like; nothing for any other text.
std::optional<Quantity> parse_quantity(const std::string& text);

// The mean over the samples of `sums`.
double value(const PixelSums& sums, const Quantity& quantity);

// For each replicate the mean over pixels of a region (equal weight for each), times `factor`.
RunningStats region_mean(const Film& film, const PixelBounds& region, const Quantity& quantity, double factor = 1.0);
// Over all pixels of the film.
RunningStats image_mean(const Film& film, const Quantity& quantity = {});

// Whether a relative error `relative` in a mean of this size would be found with a probability of 9 in 10 by a t-test
// at the level, given the standard error of what is tested and its degrees of freedom.
bool would_be_seen(double relative, double mean, double standard_error, double dof, double level);

// The picture's R, G, B, row by row.
std::vector<float> picture(const Film& film);

// For a failing test: writes `ours` and the difference ours - theirs (red where ours is brighter, blue where it is
// darker, full where the difference is a tenth of the mean) as PNG into a new temporary folder, which stays. Returns
// a line that says where.
std::string write_evidence(const std::string& name, int width, int height, const std::vector<float>& ours,
                           const std::vector<float>& theirs);

}  // namespace etd
