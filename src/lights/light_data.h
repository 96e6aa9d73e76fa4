// What lights are too small to hold themselves. Nothing in it moves while lights are added.
#pragma once

#include <deque>
#include <filesystem>
#include <map>

#include "core/animated_transform.h"
#include "lights/environment_map.h"
#include "lights/portal_map.h"

namespace etd {

// Images that lights have read, by file.
using LightImages = std::map<std::filesystem::path, Image>;

struct LightData {
  std::deque<EnvironmentMap> environments;
  std::deque<PortalMap> portals;
  std::deque<Image> images;
  std::deque<GridDistribution> grids;
  std::deque<AnimatedTransform> motions;
  // These are the maps of the files that were read, null where that failed: a light of an object is read once for all
  // of its instances.
  std::map<std::filesystem::path, const EnvironmentMap*> environment_of;
  // A slide belongs to a projection light's file and field of view.
  struct Slide {
    const Image* image = nullptr;
    const GridDistribution* texels = nullptr;
  };
  std::map<std::pair<std::filesystem::path, double>, Slide> slide_of;
  LightImages* kept = nullptr;  // what was read for the same lights before; what is read is added

  size_t bytes() const {
    size_t sum = 0;
    for (const EnvironmentMap& map : environments) sum += map.bytes();
    for (const PortalMap& portal : portals) sum += portal.bytes();
    for (const Image& image : images) sum += image.bytes();
    for (const GridDistribution& grid : grids) sum += grid.bytes();
    return sum;
  }
};

}  // namespace etd
