#include "contradictions.h"

#include <fmt/format.h>

#include <vector>

namespace etd::cli {
namespace {

// What an option says of a setting.
struct Saying {
  std::string setting, value;
  std::string option;  // as it was written
};

std::vector<Saying> sayings(const RenderOverrides& o, size_t shorthands) {
  std::vector<Saying> all;
  const auto add = [&all](const char* setting, const std::string& value, const std::string& option) {
    all.push_back({setting, value, option});
  };
  if (o.size) {
    const auto [width, height] = *o.size;
    const std::string option = fmt::format("--size {}x{}", width, height);
    add("film.xresolution", std::to_string(width), option);
    add("film.yresolution", std::to_string(height), option);
  }
  if (o.crop) {
    const std::string value = fmt::format("{},{},{},{}", o.crop->x0, o.crop->x1, o.crop->y0, o.crop->y1);
    add("film.pixelbounds", value, "--crop " + value);
    add("film.cropwindow", value, "--crop " + value);
  }
  if (o.spp) add("sampler.pixelsamples", std::to_string(*o.spp), fmt::format("--spp {}", *o.spp));
  if (o.seed) add("sampler.seed", std::to_string(*o.seed), fmt::format("--seed {}", *o.seed));
  for (size_t i = 0; i < o.set.size(); ++i) {
    const auto& [setting, value] = o.set[i];
    std::string option = fmt::format("--set {}={}", setting, value);
    for (const Shorthand& s : kShorthands)
      if (i < shorthands && setting == s.setting) option = fmt::format("{} {}", s.option, value);
    all.push_back({setting, value, std::move(option)});
  }
  return all;
}

}  // namespace

std::string find_contradiction(const RenderOverrides& overrides, size_t shorthands) {
  const std::vector<Saying> all = sayings(overrides, shorthands);
  for (size_t i = 0; i < all.size(); ++i)
    for (size_t j = 0; j < i; ++j)
      if (all[i].setting == all[j].setting && all[i].value != all[j].value)
        return fmt::format("{} and {} contradict each other", all[j].option, all[i].option);
  return {};
}

}  // namespace etd::cli
