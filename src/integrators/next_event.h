// Next-event estimation: the light that one sampled light sends straight to a vertex of a path.
#pragma once

#include "accel/spawn.h"
#include "core/mis.h"
#include "integrators/guiding/guided_scatter.h"
#include "samplers/sampler.h"
#include "scene/scene.h"

namespace etd {

struct NextEvent {
  const LightSampler& lights;
  bool mis = false;  // scattering at the vertex finds the same light too, and a heuristic weighs the two
  MisHeuristic heuristic = MisHeuristic::kPower;

  // Under MIS scattering reaches every direction as well.
  LightSampling sampling() const { return mis ? LightSampling::kCompensated : LightSampling::kComplete; }
};

// The vertex belongs to a path from the camera.
struct NextEventVertex {
  const SurfacePoint& point;
  const GuidedScatter& scatter;
  const Ray& ray;  // that arrived
  const ShadingContext& context;

  Vec3 wo() const { return -ray.d; }
};

// Who asks for light at a point that is seen along wo. The same receiver tells how light that scattering found could
// have been chosen.
inline LightReceiver light_receiver(const SurfacePoint& point, const Bsdf& bsdf, Vec3 wo, float time) {
  return {point, wo, (bsdf.lobes() & kTransmission) != 0, time};
}

// Returns the radiance that leaves the vertex along wo, weighted. Draws the next two dimensions of the sampler: for the
// light, and for the point on it. Counts the shadow ray, and tells the recorder (path_record.h) what it does.
template <class Recorder>
Spectrum next_event(const Scene& scene, const NextEvent& how, const NextEventVertex& v, Sampler& sampler,
                    HashStream& rng, RayCounts& rays, Recorder& recorder) {
  const double u_light = sampler.get_choice();
  const Vec2 u_point = sampler.get_2d();
  const LightReceiver receiver = light_receiver(v.point, v.scatter.bsdf(), v.wo(), v.context.time);
  const auto choice = how.lights.sample(u_light, &receiver);
  if (!choice) return Spectrum();
  recorder.light(choice->light, choice->probability);
  const Light& light = scene.lights[choice->light];
  const auto s = light.sample_li(v.point.p, u_point, v.context, how.sampling());
  if (!s) return Spectrum();
  const auto [f, scatter_density] = v.scatter.eval_pdf(v.wo(), s->wi, rng);
  recorder.light_sample(*s, f);
  if (is_black(f)) return Spectrum();
  ++rays.shadow;
  const bool infinite = light.is_infinite();
  if (scene.occluded(infinite ? spawn_ray(v.point, s->wi, v.ray) : shadow_ray(v.point, s->on_light, v.ray)))
    return Spectrum();
  const float pdf = choice->probability * s->pdf;
  const bool both = how.mis && !s->is_delta;
  const float scatter_pdf = both ? v.scatter.pdf(s->wi, scatter_density) : 0.0f;
  const float weight = both ? mis_weight(how.heuristic, pdf, scatter_pdf) : 1.0f;
  recorder.light_visible(scatter_pdf, weight);
  return f * s->radiance * (weight / pdf * scene.light_alpha(choice->light, s->on_light, v.context));
}

}  // namespace etd
