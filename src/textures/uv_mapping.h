// The affine map from a surface's uv to texture coordinates that two-dimensional textures share.
#pragma once

#include "core/vec.h"
#include "params/declaration.h"

namespace etd {

struct UvMapping {
  float su = 1, sv = 1, du = 0, dv = 0;

  static std::vector<ParamDecl> params() {
    return {{.name = "uscale", .default_value = 1.0, .doc = "Repetitions along u."},
            {.name = "vscale", .default_value = 1.0, .doc = "Repetitions along v."},
            {.name = "udelta", .default_value = 0.0, .doc = "Added to the scaled u."},
            {.name = "vdelta", .default_value = 0.0, .doc = "Added to the scaled v."}};
  }
  static UvMapping create(const ParamReader& p) {
    return {static_cast<float>(p.number("uscale")), static_cast<float>(p.number("vscale")),
            static_cast<float>(p.number("udelta")), static_cast<float>(p.number("vdelta"))};
  }
  // Always finite: coordinates beyond all numbers count as 0.
  Vec2 operator()(Vec2 uv) const {
    const float s = su * uv.x + du, t = sv * uv.y + dv;
    return {std::isfinite(s) ? s : 0.0f, std::isfinite(t) ? t : 0.0f};
  }
};

// A declaration with the parameters of the mapping behind its own.
inline ModelDecl with_uv_mapping(ModelDecl decl) {
  for (ParamDecl& p : UvMapping::params()) decl.params.push_back(std::move(p));
  return decl;
}

}  // namespace etd
