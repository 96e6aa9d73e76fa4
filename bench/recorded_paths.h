// Paths that a render takes, recorded by the integrator itself: what benchmarks replay in parts. They are drawn by
// Integrator::replay(), which runs the code of a render and changes no bit of it, so the program that is measured
// carries no counters.
#pragma once

#include <filesystem>
#include <functional>

#include "accel/ray.h"
#include "integrators/path_record.h"
#include "render/session.h"

namespace etd {

// Reads and prepares a pbrt scene. Throws std::runtime_error with what is wrong with it.
PreparedRender load_for_bench(const std::filesystem::path& scene, const RenderOverrides& overrides);

// Calls `f` for every path of the render, tile by tile as a render goes. Throws std::runtime_error when the integrator
// has no paths that can be drawn alone.
void for_each_path(const PreparedRender& prepared, const std::function<void(const PathRecord&)>& f);

enum class RayKind : uint8_t { kCamera, kIndirect, kShadow };

// Calls `f` for every ray of a path in the order in which the integrator traced them.
void for_each_ray(const PreparedRender& prepared, const PathRecord& path,
                  const std::function<void(RayKind, const Ray&)>& f);

}  // namespace etd
