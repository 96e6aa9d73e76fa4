// The list of lights and their dispatch. To add one: its header, its name in the lists, its constructor line.
#include "lights/light.h"

#include "lights/constant_infinite.h"
#include "lights/diffuse_area.h"

namespace etd {

namespace {
using Lights = TypeList<DiffuseAreaLight<TriangleSurface>, DiffuseAreaLight<SphereSurface>, ConstantInfiniteLight>;
}  // namespace

template <class T>
Light::Light(const T& light) {
  storage_.store<Lights>(light);
}
template Light::Light(const DiffuseAreaLight<TriangleSurface>&);
template Light::Light(const DiffuseAreaLight<SphereSurface>&);
template Light::Light(const ConstantInfiniteLight&);

bool Light::is_infinite() const {
  return dispatch<bool, Lights>(storage_, [](const auto& l) { return l.is_infinite(); });
}

std::optional<LightSample> Light::sample_li(Point3 p, Vec2 u) const {
  return dispatch<std::optional<LightSample>, Lights>(storage_, [&](const auto& l) { return l.sample_li(p, u); });
}

float Light::pdf_li(Point3 p, Vec3 wi, const SurfacePoint* on_light) const {
  return dispatch<float, Lights>(storage_, [&](const auto& l) { return l.pdf_li(p, wi, on_light); });
}

Spectrum Light::emitted(const SurfacePoint* on_light, Vec3 w) const {
  return dispatch<Spectrum, Lights>(storage_, [&](const auto& l) { return l.emitted(on_light, w); });
}

Spectrum Light::power() const {
  return dispatch<Spectrum, Lights>(storage_, [](const auto& l) { return l.power(); });
}

uint32_t Light::kind_count() { return static_cast<uint32_t>(Lights::kCount); }

std::span<const ModelDecl* const> light_models() {
  static const ModelDecl* const all[] = {&ConstantInfiniteLight::decl()};
  return all;
}

std::span<const ModelDecl* const> area_light_models() {
  static const ModelDecl* const all[] = {&diffuse_area_decl()};
  return all;
}

}  // namespace etd
