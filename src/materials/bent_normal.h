// Shading normals bent towards the viewer, so that what a mirror would show is never behind the surface (Keller et al.
// 2017, "The Iray light transport simulation and rendering system").
#pragma once

#include "core/frame.h"

namespace etd {

// The frame turned by the least angle after which the mirror image of wo about its z lies above the surface of normal
// ng, on the side of wo. The frame itself where that is so already, and where wo grazes the surface edge on.
Frame bend_to_viewer(const Frame& frame, Vec3 ng, Vec3 wo);

}  // namespace etd
