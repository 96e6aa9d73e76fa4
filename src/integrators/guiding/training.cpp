#include "integrators/guiding/training.h"

#include "integrators/light_path.h"

namespace etd {

namespace {

constexpr uint64_t kPathsPerItem = 4096;
// An item that has as many photons as this for each of its paths starts no more of them, so that memory is bounded.
constexpr uint64_t kMostPhotonsPerPath = 8;
constexpr uint64_t kGuideStream = uint64_t{3} << 61;  // neither pixels nor photon maps have it
enum Phase : uint32_t { kTrace, kBuild };

}  // namespace

GuideTraining::GuideTraining(const Scene& scene, const LightSampler& lights, const GuideSettings& settings,
                             const IntegratorContext& context)
    : scene_(scene), settings_(settings), context_(context), emitters_(scene.lights, lights, scene.emission_disks) {}

void GuideTraining::begin(uint32_t phase) {
  if (phase == kTrace) guide_.start(work_items(phase));
  if (phase == kBuild) guide_.begin_build();
}

size_t GuideTraining::work_items(uint32_t phase) const {
  if (phase == kBuild) return guide_.parts();
  return static_cast<size_t>((settings_.paths + kPathsPerItem - 1) / kPathsPerItem);
}

void GuideTraining::run(uint32_t phase, size_t item) {
  if (phase == kTrace) trace(item);
  if (phase == kBuild) guide_.build(item);
}

void GuideTraining::end() {
  if (!guide_.built()) guide_.end_build();
}

void GuideTraining::run_all() {
  if (guide_.built()) return;
  for (const uint32_t phase : {kTrace, kBuild}) {
    begin(phase);
    for (size_t item = 0; item < work_items(phase); ++item) run(phase, item);
  }
  end();
}

// Photons are there twice while the build begins; what is made of them takes less.
uint64_t GuideTraining::most_bytes() const {
  return 2 * sizeof(GuidePhoton) * kMostPhotonsPerPath * (settings_.paths + kPathsPerItem);
}

void GuideTraining::trace(size_t item) {
  const LightPathSettings settings{.max_depth = settings_.max_depth};
  RayCounts rays;
  const auto at_vertex = [&](const LightPathVertex& v) {
    const float flux = mean_value(v.flux);
    if (v.scatter.bsdf().has_smooth_lobe() && flux > 0.0f && std::isfinite(flux))
      guide_.add(item, {v.surface.point.p, DirectedFlux::encode(v.wo()), flux,
                        Guide::side_of(face_forward(v.surface.point.ng, v.wo())),
                        v.depth == 1 && settings_.next_event_estimation});
    return true;
  };
  const uint64_t begin = item * kPathsPerItem, end = std::min(begin + kPathsPerItem, settings_.paths);
  for (uint64_t path = begin; path < end && guide_.photons(item) < kMostPhotonsPerPath * kPathsPerItem; ++path) {
    Sampler sampler(context_.sampler, context_.seed);
    sampler.start(kGuideStream, 0, static_cast<uint32_t>(path));
    follow_light_path(
        scene_, emitters_, settings, sampler, rays, [](const LightPathStart&) {}, at_vertex);
  }
  guide_.finish_item(item);
}

}  // namespace etd
