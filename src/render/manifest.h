// What the ids in a picture stand for: names for people, kept in the picture's metadata.
#pragma once

#include <string>
#include <vector>

#include "film/film.h"
#include "params/diagnostics.h"
#include "render/output.h"
#include "scene/names.h"

namespace etd {

// Labels stand at id - 1 (film/pixel_ids.h): "sphere, box.pbrt:12", "tree (instance), wood.pbrt:40", "red (diffuse),
// box.pbrt:3".
struct IdLabels {
  std::vector<std::string> objects, materials;
};
// An error when there are more than ids can tell apart.
IdLabels label_ids(const SceneNames& names, Diagnostics& diagnostics);

// Adds "etendue:id.object" and "etendue:id.material" to the metadata of an image with these layers: JSON objects from
// the ids that it shows to their labels.
void add_manifests(const IdLabels& labels, const Film& film, Metadata& metadata);

}  // namespace etd
