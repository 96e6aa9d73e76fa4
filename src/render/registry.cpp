#include "render/registry.h"

#include <fmt/format.h>

#include <vector>

#include "integrators/make_integrator.h"
#include "render/other_names.h"
#include "scene/registry.h"

namespace etd {

std::span<const ModelDecl* const> all_models(Family family) {
  return family == Family::kIntegrator ? integrator_models() : models(family);
}

const ModelDecl* find_any_model(Family family, std::string_view name) {
  for (const ModelDecl* model : all_models(family))
    if (model->name == name) return model;
  return nullptr;
}

const ModelDecl* require_model(Family family, const ModelUse& use, Diagnostics& diagnostics) {
  if (const ModelDecl* model = find_any_model(family, use.model)) return model;
  std::vector<std::string_view> names;
  for (const ModelDecl* model : all_models(family)) names.push_back(model->name);
  names.insert(names.end(), other_names(family).begin(), other_names(family).end());
  const std::string_view near = nearest_name(use.model, names);
  diagnostics.error(use.loc, fmt::format("there is no {} \"{}\"", family_name(family), use.model),
                    (near.empty() ? "" : fmt::format("did you mean \"{}\"? ", near)) +
                        fmt::format("valid: {}", fmt::join(names, ", ")));
  return nullptr;
}

}  // namespace etd
