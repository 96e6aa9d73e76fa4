// Detail that is finer than the geometry: bumps and normal maps, which change the normal that shading uses and nothing
// else. Every material has them.
#pragma once

#include "core/frame.h"
#include "shapes/surface_point.h"
#include "textures/resolve.h"

namespace etd {

struct SurfaceDetail {
  FloatSource displacement;  // along the shading normal, in units of the scene
  int32_t normal_map = -1;   // a texture of the table

  static std::vector<ParamDecl> params();
  static SurfaceDetail create(const ParamReader& p, TextureBuilder& b);

  // The frame in which the surface scatters: z is the changed normal, on the side of ng.
  Frame frame(const SurfacePoint& point, const TexCoord& at, const TextureTable& textures,
              const ShadingContext& context) const;
};

}  // namespace etd
