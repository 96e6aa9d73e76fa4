// Shapes that are quadrics: spheres, cylinders and disks as scenes name them. Nothing is made of them, which is
// reported, when nothing is left of the surface.
#pragma once

#include "params/declaration.h"
#include "shapes/shape_geometry.h"

namespace etd {

struct SphereShape {
  static const ModelDecl& decl();
  static ShapeGeometry create(const ParamReader& p, const ShapeContext& context);
};
struct CylinderShape {
  static const ModelDecl& decl();
  static ShapeGeometry create(const ParamReader& p, const ShapeContext& context);
};
struct DiskShape {
  static const ModelDecl& decl();
  static ShapeGeometry create(const ParamReader& p, const ShapeContext& context);
};

}  // namespace etd
