// One path told step by step, with the very numbers that the integrator computed: what replaying a sample shows.
// An algorithm takes a recorder as a template parameter; NoRecorder, which all samples of an image are drawn with,
// leaves nothing of it in the program.
#pragma once

#include <optional>
#include <vector>

#include "bsdfs/bsdf.h"
#include "cameras/camera.h"
#include "film/pixel_sample.h"
#include "film/sample_id.h"
#include "scene/scene.h"

namespace etd {

// Light that the path ran into. Densities are per solid angle and may be infinite; pdf_light is that of choosing and
// sampling the light, 0 where no light sampling could have found it.
struct EmissionRecord {
  uint32_t light = kNoId;
  Spectrum radiance;
  float pdf_scatter = 0, pdf_light = 0;
  float mis_weight = 1;
  std::optional<Spectrum> contribution;  // nothing when this component of the light is not kept
};

// Light that was asked for by sampling a light.
struct LightRecord {
  uint32_t light = kNoId;
  float probability = 0;              // of choosing it
  std::optional<LightSample> sample;  // nothing when it sends no light here
  Spectrum f_cos;                     // black: the rest was not computed
  bool visible = false;
  float pdf_scatter = 0;  // with which scattering would find it
  float mis_weight = 1;
  std::optional<Spectrum> contribution;
};

// Scattering leads to an EmissionRecord, sampling a light to a LightRecord.
enum class LightFoundBy : uint8_t { kScattering, kLightSampling };

struct RouletteRecord {
  float survival = 1;  // probability
  bool survived = false;
};

struct PathVertex {
  int depth = 0;        // scattering events before it
  Spectrum throughput;  // on arrival
  Vec3 wo;
  // Where the path left the scene, there is no surface.
  bool on_surface = false;
  Hit hit;
  SurfaceHit surface;
  Vec3 ns;                             // after bumps
  const Material* material = nullptr;  // of a mix the chosen one
  std::vector<EmissionRecord> emission;
  std::optional<LightRecord> light;
  std::optional<BsdfSample> scatter;
  std::optional<RouletteRecord> roulette;
};

// kLeftOut: the rest of the path was not to be rendered.
enum class PathEnd { kEscaped, kDepth, kAbsorbed, kRoulette, kLeftOut };

struct PathRecord {
  SampleId id;
  uint32_t replicate = 0, index = 0;
  CameraSample camera;
  Ray ray;
  std::vector<PathVertex> vertices;  // none where the algorithm tells nothing of its paths
  PathEnd end = PathEnd::kEscaped;
  PixelSample sample;  // contributions summed in their order, and what else the film receives
};

struct NoRecorder {
  void camera(const CameraSample&, const Ray&) {}
  void vertex(int, const Spectrum&, Vec3) {}
  void surface(const Hit&, const SurfaceHit&, const Shading&) {}
  void emission(uint32_t, const Spectrum&, float, float, float) {}
  void light(uint32_t, float) {}
  void light_sample(const LightSample&, const Spectrum&) {}
  void light_visible(float, float) {}
  void contribution(LightFoundBy, const Spectrum&) {}
  void scatter(const BsdfSample&) {}
  void roulette(float, bool) {}
  void end(PathEnd) {}
};

class PathRecorder {
 public:
  explicit PathRecorder(PathRecord& record) : record_(record) {}

  void camera(const CameraSample& sample, const Ray& ray) { record_.camera = sample, record_.ray = ray; }
  void vertex(int depth, const Spectrum& throughput, Vec3 wo) {
    PathVertex& v = record_.vertices.emplace_back();
    v.depth = depth, v.throughput = throughput, v.wo = wo;
  }
  void surface(const Hit& hit, const SurfaceHit& surface, const Shading& shading) {
    PathVertex& v = last();
    v.on_surface = true;
    v.hit = hit, v.surface = surface;
    v.ns = shading.frame.z, v.material = shading.material;
  }
  void emission(uint32_t light, const Spectrum& radiance, float pdf_scatter, float pdf_light, float mis_weight) {
    last().emission.push_back({light, radiance, pdf_scatter, pdf_light, mis_weight, {}});
  }
  void light(uint32_t light, float probability) {
    last().light.emplace();
    last().light->light = light, last().light->probability = probability;
  }
  void light_sample(const LightSample& sample, const Spectrum& f_cos) {
    last().light->sample = sample, last().light->f_cos = f_cos;
  }
  void light_visible(float pdf_scatter, float mis_weight) {
    last().light->visible = true;
    last().light->pdf_scatter = pdf_scatter, last().light->mis_weight = mis_weight;
  }
  // Records what the emission or light sample that was told last adds to the image. Where there was no light to choose,
  // none was told.
  void contribution(LightFoundBy by, const Spectrum& radiance) {
    PathVertex& v = last();
    if (by == LightFoundBy::kScattering)
      v.emission.back().contribution = radiance;
    else if (v.light)
      v.light->contribution = radiance;
  }
  void scatter(const BsdfSample& sample) { last().scatter = sample; }
  void roulette(float survival, bool survived) { last().roulette = {survival, survived}; }
  void end(PathEnd end) { record_.end = end; }

 private:
  PathVertex& last() { return record_.vertices.back(); }

  PathRecord& record_;
};

}  // namespace etd
