// What lights are too small to hold themselves. Nothing in it moves while lights are added.
#pragma once

#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <vector>

#include "core/animated_transform.h"
#include "lights/environment_map.h"
#include "lights/light_surfaces.h"
#include "lights/portal_map.h"

namespace etd {

// Images that lights have read, by file.
using LightImages = std::map<std::filesystem::path, std::shared_ptr<const Image>>;

struct LightData {
  std::deque<EnvironmentMap> environments;
  std::deque<PortalMap> portals;
  std::vector<std::shared_ptr<const Image>> images;
  std::deque<GridDistribution> grids;
  std::deque<AnimatedTransform> motions;
  std::deque<LightRectangle> rectangles;
  // What keeps an image, and where it is then.
  const Image* keep(std::shared_ptr<const Image> image) { return images.emplace_back(std::move(image)).get(); }

  // The image of a use of an area light, null where it could not be read: it is on many shapes.
  std::map<const ModelUse*, const Image*> image_of;
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
    size_t sum = rectangles.size() * sizeof(LightRectangle);
    for (const EnvironmentMap& map : environments) sum += map.bytes();
    for (const PortalMap& portal : portals) sum += portal.bytes();
    for (const auto& image : images) sum += image->bytes();
    for (const GridDistribution& grid : grids) sum += grid.bytes();
    return sum;
  }
};

}  // namespace etd
