// What one replayed sample looks like: as a table for people, in one line of a list, and as JSON for programs.
#pragma once

#include <array>
#include <string>

#include "film/sensor.h"
#include "integrators/path_record.h"
#include "params/source.h"
#include "scene/names.h"

namespace etd {

// What a path refers to: its scene, the files that the scene was read from, and the film.
struct ReplayedScene {
  const Scene& scene;
  const SceneNames& names;
  const Sources& sources;
  const Sensor& sensor;
};

// What the film received of a sample; black of an invalid one.
struct Received {
  std::array<double, 3> rgb{};
  double luminance = 0;
  bool valid = true;
};
Received received_by_film(const PathRecord& path, const ReplayedScene& in);

// Every vertex with what was computed there, every contribution, their sum, and what the film received. Radiance is
// written so that it reads back as the same bits.
std::string replay_text(const PathRecord& path, const ReplayedScene& in);

// The surfaces up to the light that contributes most, and how it was found: "floor > glass S > glass S > area light".
std::string replay_line(const PathRecord& path, const ReplayedScene& in);

// The same as replay_text() as one JSON object. Numbers that JSON does not have are the texts "NaN", "Infinity" and
// "-Infinity".
std::string replay_json(const PathRecord& path, const ReplayedScene& in);

}  // namespace etd
