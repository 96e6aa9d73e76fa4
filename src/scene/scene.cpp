#include "scene/scene.h"

#include <bit>

#include "core/hash.h"

namespace etd {

namespace {

uint64_t bits(float a, float b) { return uint64_t(std::bit_cast<uint32_t>(a)) << 32 | std::bit_cast<uint32_t>(b); }

// A uniform number in [0, 1) that is the same whenever this ray meets this place.
float number_of(const Ray& r, const Hit& hit) {
  return unit_float(static_cast<uint32_t>(
      hash_combine(bits(r.o.x, r.o.y), bits(r.o.z, r.d.x), bits(r.d.y, r.d.z), bits(r.time, hit.t)) >> 32));
}

}  // namespace

bool Scene::occluded(const Ray& ray) const {
  Hit hit;
  return accelerator->occluded(ray) && (!has_holes || intersect(ray, hit));
}

bool Scene::is_hole(const Ray& ray, const Hit& hit) const {
  if (!binding_of(hit).has_holes) return false;
  const float share = alpha(hit, surface_point(geometry, hit), {ray.time});
  return !(share >= 1.0f) && !(number_of(ray, hit) < share);
}

// The nearest hit from `hit` on that is no hole. The ray goes on as it is, with what it has passed behind its start: a
// new origin would not meet the same points.
bool Scene::find_solid(Ray ray, Hit& hit) const {
  while (is_hole(ray, hit)) {
    ray.t_min = hit.t;
    if (!accelerator->intersect(ray, hit)) return hit = {}, false;
  }
  return true;
}

SurfaceHit Scene::surface(const Hit& hit) const {
  const SurfaceBinding& binding = binding_of(hit);
  SurfaceHit s;
  s.material = &materials[binding.material];
  s.point = surface_point(geometry, hit, !s.material->plain());
  if (binding.first_light != kNoId)
    s.light = hit.on_quadric() ? binding.first_light : face_lights[binding.first_light + hit.primitive];
  return s;
}

TexCoord Scene::tex_coord(const SurfacePoint& s) const {
  TexCoord at = point_coord(s);
  if (textures.textures.empty()) return at;
  const PixelFootprint::Step step = footprint.at(s.p, s.ng);
  at.dp_dx = step.dx;
  at.dp_dy = step.dy;
  // The change of uv whose image under (dpdu, dpdv) is nearest to that of p: normal equations.
  const double uu = double(dot(s.dpdu, s.dpdu)), uv = double(dot(s.dpdu, s.dpdv)), vv = double(dot(s.dpdv, s.dpdv));
  const double inverse = 1.0 / (uu * vv - uv * uv);
  const auto change = [&](Vec3 d) {
    const double u = double(dot(s.dpdu, d)), v = double(dot(s.dpdv, d));
    const double du = (vv * u - uv * v) * inverse, dv = (uu * v - uv * u) * inverse;
    constexpr double kMost = 1e8;
    if (!std::isfinite(du) || !std::isfinite(dv)) return Vec2{};
    return Vec2{static_cast<float>(std::clamp(du, -kMost, kMost)), static_cast<float>(std::clamp(dv, -kMost, kMost))};
  };
  at.duv_dx = change(step.dx);
  at.duv_dy = change(step.dy);
  return at;
}

Shading Scene::shade(const SurfaceHit& surface, const ShadingContext& context, HashStream& rng) const {
  Shading s;
  s.material = surface.material;
  s.plain = s.material->plain();
  if (s.plain) {
    s.frame = Frame::from_z(surface.point.ns);
    return s;
  }
  const TexCoord at = tex_coord(surface.point);
  s.material = &surface.material->resolve(at, textures, context, materials, rng);
  s.made = s.material->closure(at, textures, context);
  s.frame = s.material->frame(surface.point, at, textures, context);
  return s;
}

size_t Scene::geometry_bytes() const {
  size_t sum = geometry.quadrics.size() * sizeof(Quadric) + geometry.instances.size() * sizeof(GeometryInstance);
  for (const Mesh& mesh : geometry.meshes) sum += mesh.bytes();
  for (const PatchMesh& mesh : geometry.patch_meshes) sum += mesh.bytes();
  return sum;
}

}  // namespace etd
