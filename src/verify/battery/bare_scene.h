// Models as scenes make them: through compile(), from a description that holds nothing else.
#pragma once

#include <memory>
#include <string>

#include "scene/description.h"
#include "scene/scene.h"

namespace etd {

// Every slot filled, no shapes and no lights.
SceneDescription bare_description();

struct BareScene {
  std::shared_ptr<const Scene> scene;  // null when something is wrong:
  std::string problem;
};
BareScene compile_bare(const SceneDescription& description, int width = 16, int height = 9);

}  // namespace etd
