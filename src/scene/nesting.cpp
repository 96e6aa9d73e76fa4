#include "scene/nesting.h"

#include <fmt/format.h>

#include <algorithm>

namespace etd {

bool check_object_nesting(const SceneDescription& description, Diagnostics& diagnostics) {
  std::vector<uint64_t> levels;  // by object
  for (const ObjectDesc& object : description.objects) {
    uint64_t& level = levels.emplace_back(1);
    // Objects only contain earlier ones.
    for (const InstanceDesc& i : object.instances) level = std::max(level, levels[static_cast<size_t>(i.object)] + 1);
    if (level <= diagnostics.limits().nesting) continue;
    report_nesting(object.loc, fmt::format("object \"{}\"", object.name), diagnostics);
    return false;
  }
  return true;
}

void report_nesting(SourceLoc loc, std::string_view what, Diagnostics& diagnostics) {
  diagnostics.error(loc, fmt::format("{} is made of too many levels of others", what),
                    "levels within each other: " + limit_text(diagnostics.limits(), &Limits::nesting));
}

}  // namespace etd
