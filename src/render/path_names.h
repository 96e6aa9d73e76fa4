// What people call the parts of a recorded path: the words that its table and its JSON share.
#pragma once

#include <string>

#include "render/replay.h"

namespace etd {

const char* component_name(int depth);  // "emission", "direct" or "indirect"
const char* end_text(PathEnd end);      // "it met no surface"
std::string lobe_text(Lobe lobe);       // "diffuse reflection"

// A thing of the scene: what it is, what it is called, and where that stands ("scene.pbrt:12"); both may be empty.
struct PathItem {
  std::string model, name, place;
  const std::string& label() const { return name.empty() ? model : name; }
};
PathItem shape_item(const ReplayedScene& in, const Hit& hit);
PathItem light_item(const ReplayedScene& in, uint32_t light);
PathItem material_item(const ReplayedScene& in, const Material* material);

// Returns p in the coordinates of the scene's file.
Point3d file_position(const ReplayedScene& in, Point3 p);

}  // namespace etd
