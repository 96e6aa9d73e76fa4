#include "io/mesh.h"

#include <algorithm>

namespace etd {

void drop_unused_vertices(MeshData& mesh, std::span<uint32_t> corners) {
  const size_t count = mesh.positions.size() / mesh.motion_steps;
  constexpr uint32_t kUnused = 0xffffffffu;
  std::vector<uint32_t> renamed(count, kUnused);
  for (const uint32_t c : corners) renamed[c] = 0;
  if (std::find(renamed.begin(), renamed.end(), kUnused) == renamed.end()) return;
  uint32_t kept = 0;
  for (uint32_t& name : renamed)
    if (name != kUnused) name = kept++;
  // `values` holds those of all motion steps, or of one, or nothing.
  const auto keep = [&](auto& values) {
    size_t next = 0;
    for (size_t i = 0; i < values.size(); ++i)
      if (renamed[i % count] != kUnused) values[next++] = values[i];
    values.resize(next);
  };
  keep(mesh.positions);
  keep(mesh.normals);
  keep(mesh.uvs);
  for (uint32_t& c : corners) c = renamed[c];
}

}  // namespace etd
