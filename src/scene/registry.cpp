#include "scene/registry.h"

#include "cameras/camera.h"
#include "film/film_model.h"
#include "filters/filter.h"
#include "lights/area_light.h"
#include "lights/light.h"
#include "materials/material.h"
#include "samplers/sampler.h"
#include "shapes/shape.h"
#include "textures/resolve.h"

namespace etd {

std::span<const ModelDecl* const> models(Family family) {
  switch (family) {
    case Family::kShape:
      return shape_models();
    case Family::kMaterial:
      return material_models();
    case Family::kTexture:
      return texture_models();
    case Family::kLight:
      return light_models();
    case Family::kAreaLight:
      return area_light_models();
    case Family::kCamera:
      return camera_models();
    case Family::kFilter:
      return filter_models();
    case Family::kSampler:
      return sampler_models();
    case Family::kFilm:
      return film_models();
    case Family::kIntegrator:
      break;  // a floor above: integrators/make_integrator.h
  }
  return {};
}

const ModelDecl* find_model(Family family, std::string_view name) {
  for (const ModelDecl* model : models(family))
    if (model->name == name) return model;
  return nullptr;
}

SceneNames::Item name_item(Family family, const ModelUse& use) {
  const ModelDecl* decl = find_model(family, use.model);
  return {decl ? std::string_view(decl->name) : std::string_view(), use.loc};
}

}  // namespace etd
