// Options that say different things about one setting.
#pragma once

#include <string>

#include "render/settings.h"

namespace etd::cli {

// "--spp 4 and --set sampler.pixelsamples=8 contradict each other"; empty when none do. The first `shorthands` entries
// of overrides.set were given as options of their own, such as --mode.
std::string find_contradiction(const RenderOverrides& overrides, size_t shorthands);

// Options that are short for `--set`.
struct Shorthand {
  const char *option, *setting, *help, *type;
};
inline constexpr Shorthand kShorthands[] = {
    {"--max-depth", "integrator.maxdepth", "the longest path, in scattering events", "N"},
    {"--mode", "integrator.mode", "how paths find light: naive, next_event or mis", "NAME"},
    {"--components", "integrator.components", "all, or only direct, indirect or emission", "NAME"}};

}  // namespace etd::cli
