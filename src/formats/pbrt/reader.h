// The reader of the pbrt-v4 scene language: text in, a SceneDescription out.
#pragma once

#include <filesystem>
#include <string>

#include "params/diagnostics.h"
#include "scene/description.h"

namespace etd {

// Reads a scene and everything it includes. All that is wrong or unsupported is reported, and what comes back is
// complete enough to be checked further: compile() may be called on it even after errors, to find the rest of them.
// Parameters of models are left to compile(), which checks them against their declarations.
SceneDescription read_pbrt(const std::filesystem::path& file, Diagnostics& diagnostics);

// The same from a text. `name` is what messages call it; relative file names in it start in `folder`.
SceneDescription read_pbrt_text(std::string text, const std::string& name, const std::filesystem::path& folder,
                                Diagnostics& diagnostics);

// How a file looks at a scene: what it says before its WorldBegin, where reading ends if there is one, replaces what
// `view` says: camera, film, filter, sampler, integrator, times of motion. A file without a camera is an error.
ViewDescription read_pbrt_view(const std::filesystem::path& file, const ViewDescription& view,
                               Diagnostics& diagnostics);

}  // namespace etd
