// Ray queries one by one: what a ray costs, and what turning its hit into a surface point adds.
#include <benchmark/benchmark.h>

#include "accel/accelerator.h"
#include "accel/spawn.h"
#include "accel/surface.h"
#include "core/frame.h"
#include "core/hash.h"
#include "core/warp.h"

namespace {

using namespace etd;

// A closed room [-1, 1]^3 with a ball in it.
Geometry room() {
  Mesh m;
  for (int i = 0; i < 8; ++i) m.positions.push_back({i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : -1.0f});
  m.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                 {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  m.flip_ng = true;
  const Transform t = Transform::translate({0.3, -0.5, 0.2}) * Transform::scale({0.5, 0.5, 0.5});
  Geometry g;
  g.meshes.push_back(std::move(m));
  g.quadrics.emplace_back(t, false);
  g.groups[0].meshes = {0};
  g.groups[0].quadric_end = 1;
  return g;
}

// The rays of a random walk.
std::vector<Ray> walk(const Geometry& g, const Accelerator& accel, size_t count) {
  HashStream numbers(3);
  std::vector<Ray> rays = {{{0, 0.5f, 0}, {0, 0, 1}}};
  while (rays.size() < count) {
    Hit hit;
    if (!accel.intersect(rays.back(), hit)) break;
    const SurfacePoint s = surface_point(g, hit);
    const float u = numbers.next_float(), v = numbers.next_float();
    rays.push_back(spawn_ray(s, Frame::from_z(s.ng).to_world(sample_hemisphere_cosine({u, v}))));
  }
  return rays;
}

template <class F>
void for_each_ray(benchmark::State& state, F&& f) {
  const Geometry g = room();
  const Accelerator accel(g);
  const std::vector<Ray> rays = walk(g, accel, 100000);
  size_t i = 0;
  for (auto _ : state) {
    f(g, accel, rays[i]);
    i = i + 1 < rays.size() ? i + 1 : 0;
  }
}

void nearest_hit(benchmark::State& state) {
  for_each_ray(state, [](const Geometry&, const Accelerator& accel, const Ray& ray) {
    Hit hit;
    benchmark::DoNotOptimize(accel.intersect(ray, hit));
    benchmark::DoNotOptimize(hit);
  });
}
BENCHMARK(nearest_hit);

void nearest_hit_and_its_point(benchmark::State& state) {
  for_each_ray(state, [](const Geometry& g, const Accelerator& accel, const Ray& ray) {
    Hit hit;
    if (accel.intersect(ray, hit)) benchmark::DoNotOptimize(surface_point(g, hit));
  });
}
BENCHMARK(nearest_hit_and_its_point);

void occlusion_of_a_segment(benchmark::State& state) {
  for_each_ray(state, [](const Geometry&, const Accelerator& accel, Ray ray) {
    ray.t_max = 1.0f;
    benchmark::DoNotOptimize(accel.occluded(ray));
  });
}
BENCHMARK(occlusion_of_a_segment);

}  // namespace
