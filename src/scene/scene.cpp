#include "scene/scene.h"

namespace etd {

SurfaceHit Scene::surface(const Hit& hit) const {
  const bool on_quadric = hit.geometry == kQuadricGeometry;
  const SurfaceBinding& binding = on_quadric ? quadric_bindings[hit.primitive] : mesh_bindings[hit.geometry];
  SurfaceHit s;
  s.point = surface_point(geometry, hit);
  s.material = &materials[binding.material];
  if (binding.first_light != kNoId)
    s.light = on_quadric ? binding.first_light : triangle_lights[binding.first_light + hit.primitive];
  return s;
}

Shading Scene::shade(const SurfaceHit& surface, HashStream& rng) const {
  const TexCoord at{surface.point.uv};
  const Material& material = surface.material->resolve(at, textures, materials, rng);
  return {material.closure(at, textures), Frame::from_z_tangent(surface.point.ns, surface.point.dpdu)};
}

size_t Scene::geometry_bytes() const {
  size_t sum = geometry.quadrics.size() * sizeof(Quadric) + geometry.instances.size() * sizeof(GeometryInstance);
  for (const Mesh& mesh : geometry.meshes) sum += mesh.bytes();
  return sum;
}

}  // namespace etd
