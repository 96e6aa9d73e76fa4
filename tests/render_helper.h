// Renders scenes in tests.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "places.h"
#include "render/settings.h"
#include "verify/statistics/film_mean.h"

namespace etd {

struct LayeredImage;

// Render a pbrt scene to the end. Anything wrong with scene or overrides throws std::runtime_error with all messages.
Film render_scene(const std::filesystem::path& file, const RenderOverrides& overrides);
Film render_description(const SceneDescription& description, const RenderOverrides& overrides);
// `folder` is where relative file names in the text start, "tests/scenes/agree" for example.
Film render_text(const std::string& text, const std::string& folder, const RenderOverrides& overrides);

// The same, to the image with all its layers.
LayeredImage render_image(const std::string& text, const std::string& folder, const RenderOverrides& overrides);

// The picture's R, G, B, row by row.
std::vector<float> picture(const Film& film);

// For a failing test: writes `ours` and the difference ours - theirs (red where ours is brighter, blue where it is
// darker, full where the difference is a tenth of the mean) as PNG into a new temporary folder, which stays. Returns
// a line that says where.
std::string write_evidence(const std::string& name, int width, int height, const std::vector<float>& ours,
                           const std::vector<float>& theirs);

}  // namespace etd
