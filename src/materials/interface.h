// The surface that is not there: only a border between media. compile() leaves such shapes out while there are none.
#pragma once

#include "materials/material.h"

namespace etd {

inline const ModelDecl& interface_decl() {
  static const ModelDecl d{
      Family::kMaterial, "interface", "No surface: light passes unchanged. Separates participating media.", {}};
  return d;
}

}  // namespace etd
