// What it costs to choose one of many lights for a receiver, and to tell the probability of one.
#include <benchmark/benchmark.h>

#include "core/hash.h"
#include "light_sampling/light_sampler.h"
#include "lights/light_list.h"

namespace {

using namespace etd;

// Point lights all over a cube. The receivers go along a line slowly, as those of neighbouring pixels do.
void choose_a_light(benchmark::State& state, const char* name) {
  HashStream rng(1);
  std::vector<Light> lights;
  for (int64_t i = 0; i < state.range(0); ++i) {
    const Point3 at{rng.next_float(), rng.next_float(), rng.next_float()};
    lights.emplace_back(PointLight<IsotropicIntensity>{at, {Spectrum(rng.next_float())}});
  }
  const LightSampler sampler = make_light_sampler(name, {lights});
  LightReceiver r;
  r.n = {0, 0, 1};
  uint64_t k = 0;
  for (auto _ : state) {
    r.p = {0.3f, static_cast<float>(k++ % 100000) * 1e-5f, 0.5f};
    benchmark::DoNotOptimize(sampler.sample(static_cast<double>(rng.next_float()), &r));
  }
}
BENCHMARK_CAPTURE(choose_a_light, bvh, "bvh")->Arg(1)->Arg(100)->Arg(10000)->Arg(1000000);
BENCHMARK_CAPTURE(choose_a_light, power, "power")->Arg(1)->Arg(100)->Arg(1000000);

}  // namespace
