#include "lights/area_light.h"

#include "lights/light_list.h"
#include "params/model_list.h"

namespace etd {

std::span<const ModelDecl* const> area_light_models() {
  static const std::vector<const ModelDecl*> all = declarations(AreaLightModels{});
  return all;
}

AreaLights make_area_lights(const ModelUse& use, const AreaLightContext& context, Diagnostics& diagnostics) {
  AreaLights made;
  const auto make = [&]<class T>(std::type_identity<T>, const ParamReader& p) { made = T::create(p, context); };
  if (!with_model(AreaLightModels{}, use, diagnostics, make))
    make(std::type_identity<DiffuseArea>(), {DiffuseArea::decl(), use, diagnostics});
  return made;
}

}  // namespace etd
