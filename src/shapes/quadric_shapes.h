// Shapes that are quadrics: spheres, cylinders and disks as scenes name them.
#pragma once

#include "params/declaration.h"
#include "shapes/quadric.h"

namespace etd {

// A quadric before its transform.
struct QuadricShape {
  Transform unit_to_object;
  QuadricPart part;
};

const ModelDecl& sphere_decl();
const ModelDecl& cylinder_decl();
const ModelDecl& disk_decl();

// Makes the shape of a checked use of one of them; nothing, and reported, when nothing is left of the surface.
std::optional<QuadricShape> make_quadric_shape(const ParamReader& p);

}  // namespace etd
