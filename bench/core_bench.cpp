// What the smallest pieces that every path runs through cost, so that a change to one of them is seen.
#include <benchmark/benchmark.h>

#include "core/frame.h"
#include "core/hash.h"
#include "core/warp.h"

namespace {

void hash_of_a_sample(benchmark::State& state) {
  uint64_t index = 0;
  for (auto _ : state) benchmark::DoNotOptimize(etd::hash_combine(7, index++, 3));
}
BENCHMARK(hash_of_a_sample);

void cosine_bounce_in_a_frame(benchmark::State& state) {
  etd::HashStream numbers(1);
  etd::Vec3 direction{0, 0, 1};
  for (auto _ : state) {
    const float u = numbers.next_float(), v = numbers.next_float();
    direction = etd::Frame::from_z(direction).to_world(etd::sample_hemisphere_cosine({u, v}));
    benchmark::DoNotOptimize(direction);
  }
}
BENCHMARK(cosine_bounce_in_a_frame);

void point_on_a_triangle(benchmark::State& state) {
  etd::HashStream numbers(2);
  for (auto _ : state) {
    const float u = numbers.next_float(), v = numbers.next_float();
    benchmark::DoNotOptimize(etd::sample_triangle_uniform({u, v}));
  }
}
BENCHMARK(point_on_a_triangle);

}  // namespace
