// A mesh file as a scene: the mesh on a ground, in soft light, seen from a good place.
#pragma once

#include <filesystem>

#include "params/diagnostics.h"
#include "scene/description.h"

namespace etd {

// Whether a file ending (io/gzip.h: uncompressed_ending) names a mesh that read_mesh_scene() reads.
bool is_mesh_ending(std::string_view ending);

// Reads an OFF, PLY or OBJ file by its ending (compressed or not) and builds the scene around it. y is up, as in most
// of these files; z is where the mesh is more than 1.4 times as long along z as along x and y (figures that stand in
// z). The camera sees the bounding sphere from 30 degrees to the right of the front and 22 degrees above; the mesh is
// grey unless an OBJ file has materials. Problems are reported, and the description is then only good for finding more.
SceneDescription read_mesh_scene(const std::filesystem::path& file, Diagnostics& diagnostics);

}  // namespace etd
