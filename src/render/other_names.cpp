#include "render/other_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "render/registry.h"

namespace etd {

namespace {

// What converges to the picture of the path integrator, as far as it can render a scene at all, and "lightpath", which
// is our "light". "ambientocclusion" and "function" compute something else and are not here.
constexpr std::array<std::string_view, 7> kIntegrators = {"volpath", "simplepath", "simplevolpath", "bdpt",
                                                          "mlt",     "lightpath",  "randomwalk"};
constexpr std::array<std::string_view, 5> kSamplers = {"paddedsobol", "zsobol", "halton", "pmj02bn", "stratified"};

}  // namespace

std::span<const std::string_view> other_names(Family family) {
  if (family == Family::kIntegrator) return kIntegrators;
  if (family == Family::kSampler) return kSamplers;
  return {};
}

std::string_view our_name(Family family, std::string_view other) {
  if (family == Family::kSampler) return "sobol";
  return other == "lightpath" ? "light" : "path";
}

void take_other_name(Family family, ModelUse& use, Diagnostics& diagnostics) {
  const std::span<const std::string_view> names = other_names(family);
  if (std::find(names.begin(), names.end(), use.model) == names.end()) return;
  const std::string_view ours = our_name(family, use.model);
  const ModelDecl& decl = *find_any_model(family, ours);
  std::string dropped;
  const auto drop = [&](const Param& param) {
    if (decl.find(param.name)) return false;
    dropped += (dropped.empty() ? "" : ", ") + param.name;
    return true;
  };
  use.params.erase(std::remove_if(use.params.begin(), use.params.end(), drop), use.params.end());
  // Our "sobol" is what pbrt calls "paddedsobol".
  if (use.model != "paddedsobol" || !dropped.empty())
    diagnostics.note(use.loc, fmt::format("{} \"{}\" is rendered with \"{}\"{}{}", family_name(family), use.model, ours,
                                          dropped.empty() ? "" : ", without its ", dropped));
  use.model = ours;
}

}  // namespace etd
