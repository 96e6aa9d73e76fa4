// The immutable scene: flat arrays that every thread may read, and nothing but what rays read. Built by compile();
// scene/info.h has what people are told about it.
#pragma once

#include <memory>
#include <vector>

#include "accel/accelerator.h"
#include "accel/surface.h"
#include "cameras/footprint.h"
#include "film/pixel_ids.h"
#include "filters/filter.h"
#include "light_sampling/light_sampler.h"
#include "lights/light_data.h"
#include "materials/material.h"
#include "materials/material_data.h"

namespace etd {

// What a mesh, patch mesh or quadric is made of.
struct SurfaceBinding {
  uint32_t material = 0;
  uint32_t shape = 0;       // index into SceneNames::shapes
  uint32_t object = kNoId;  // index into SceneNames::objects; kNoId: that of the instance
  // The quadric's light, or where the lights of the mesh's triangles or patches start in `face_lights`; kNoId: does not
  // emit.
  uint32_t first_light = kNoId;
  bool has_holes = false;
  FloatSource alpha{1.0f, -1};
};

// A hit, ready for shading.
struct SurfaceHit {
  SurfacePoint point;
  const Material* material = nullptr;
  uint32_t light = kNoId;
};

// A closure and the frame in which it scatters.
struct Shading {
  const Bsdf& closure() const { return plain ? *plain : made; }

  const Bsdf* plain = nullptr;  // the material's own, or it is made for the place:
  Bsdf made;
  Frame frame;
  const Material* material = nullptr;  // of a mix the one that was chosen
};

class Scene {
 public:
  // The nearest hit, and whether there is any; where surfaces have holes, a hash of the ray decides whether it meets
  // them, so that they are there with the probability of their alpha.
  bool intersect(const Ray& ray, Hit& hit) const {
    return accelerator->intersect(ray, hit) && (!has_holes || find_solid(ray, hit));
  }
  bool occluded(const Ray& ray) const;
  // Share of a light's surface that is there: what is sampled on it shines with this factor. Scattering finds it with
  // this probability in the first place.
  float light_alpha(uint32_t light, const SurfacePoint& on_light, const ShadingContext& context) const {
    return light < light_alphas.size()
               ? std::clamp(textures.eval(light_alphas[light], point_coord(on_light), context), 0.0f, 1.0f)
               : 1.0f;
  }
  // Share of the surface that is there, and so the probability with which a ray meets it where it was hit.
  float alpha(const Hit& hit, const SurfacePoint& point, const ShadingContext& context) const {
    const SurfaceBinding& binding = binding_of(hit);
    return binding.has_holes ? textures.eval(binding.alpha, point_coord(point), context) : 1.0f;
  }
  SurfaceHit surface(const Hit& hit) const;
  // How the surface scatters there. `rng` decides between mixed materials.
  Shading shade(const SurfaceHit& surface, const ShadingContext& context, HashStream& rng) const;
  // What the surface that was hit is made of.
  const SurfaceBinding& binding_of(const Hit& hit) const {
    if (hit.on_patch()) return patch_bindings[hit.patch_mesh()];
    return hit.on_quadric() ? quadric_bindings[hit.primitive] : mesh_bindings[hit.geometry];
  }
  // Returns the ids of the object and the material, as SceneNames lists them, counted from 1.
  SurfaceIds ids_of(const Hit& hit) const {
    const SurfaceBinding& binding = binding_of(hit);
    uint32_t object = binding.object;
    if (object == kNoId && hit.instance < instance_objects.size()) object = instance_objects[hit.instance];
    return {object + 1, binding.material + 1};
  }
  size_t geometry_bytes() const;

  Geometry geometry;
  // One per mesh, patch mesh and quadric of `geometry`.
  std::vector<SurfaceBinding> mesh_bindings, patch_bindings, quadric_bindings;
  std::vector<uint32_t> instance_objects;  // by instance of `geometry`: index into SceneNames::objects
  std::vector<Material> materials;
  MaterialData material_data;
  TextureTable textures;
  std::vector<Light> lights;
  std::vector<uint32_t> face_lights;      // of the triangles and patches of emitting meshes, mesh by mesh
  bool has_holes = false;                 // any surface
  bool moves = false;                     // anything, so that the time of a ray matters
  std::vector<FloatSource> light_alphas;  // by light; only as long as the last that has holes
  std::vector<uint32_t> infinite_lights;  // those that rays can find
  LightData light_data;
  LightSampler light_sampler;  // the default one; integrators may make another
  Camera camera;
  Point3 viewer;  // where the camera is, about
  PixelFootprint footprint;
  CameraData camera_data;
  Filter filter;
  std::unique_ptr<Accelerator> accelerator;
  BoundingSphere seen;           // around most of what the camera sees; of radius 0 if that is nothing
  EmissionDisks emission_disks;  // where rays of infinite lights enter
  Vec3d origin;                  // world position that was moved to (0, 0, 0)

 private:
  // Returns where textures are looked up at a point, without a footprint.
  static TexCoord point_coord(const SurfacePoint& s) { return {s.uv, s.p, s.ng}; }
  // The same with the footprint of a pixel.
  TexCoord tex_coord(const SurfacePoint& s) const;
  bool is_hole(const Ray& ray, const Hit& hit) const;
  bool find_solid(Ray ray, Hit& hit) const;
};

}  // namespace etd
