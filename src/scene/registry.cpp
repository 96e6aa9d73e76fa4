#include "scene/registry.h"

namespace etd {

std::span<const ModelDecl* const> models(Family) { return {}; }

const ModelDecl* find_model(Family family, std::string_view name) {
  for (const ModelDecl* model : models(family))
    if (model->name == name) return model;
  return nullptr;
}

}  // namespace etd
