#include "scene/registry.h"

#include "cameras/camera.h"
#include "filters/filter.h"
#include "samplers/sampler.h"

namespace etd {

std::span<const ModelDecl* const> models(Family family) {
  switch (family) {
    case Family::kCamera:
      return camera_models();
    case Family::kFilter:
      return filter_models();
    case Family::kSampler:
      return sampler_models();
    default:
      return {};
  }
}

const ModelDecl* find_model(Family family, std::string_view name) {
  for (const ModelDecl* model : models(family))
    if (model->name == name) return model;
  return nullptr;
}

}  // namespace etd
