#include "shapes/quadric_shapes.h"

#include <fmt/format.h>

#include "shapes/alpha.h"

namespace etd {

namespace {

ParamDecl radius_param(const char* doc) {
  return {.name = "radius", .default_value = 1.0, .min = 0, .above_min = true, .unit = "m", .doc = doc};
}

ParamDecl phimax_param() {
  return {.name = "phimax",
          .default_value = 360.0,
          .min = 0,
          .max = 360,
          .above_min = true,
          .unit = "degrees",
          .doc = "How far the surface goes around z, counted from x towards y."};
}

void report_empty(const ParamReader& p, const char* first, const char* second) {
  const Param* given = p.given(second) ? p.given(second) : p.given(first);
  p.diagnostics().error(given ? given->value_loc : p.use().loc,
                        fmt::format("nothing of the {} lies between \"{}\" and \"{}\"", p.decl().name, first, second));
}

float phi_max_of(const ParamReader& p) {
  const double degrees = p.number("phimax");
  return degrees == 360 ? 2 * kPi : static_cast<float>(degrees * (M_PI / 180));
}

}  // namespace

const ModelDecl& SphereShape::decl() {
  static const ModelDecl d{
      Family::kShape,
      "sphere",
      "A sphere around the origin, or the part of it between two heights and around z.",
      {radius_param("Radius."),
       {.name = "zmin", .unit = "m", .doc = "Where it begins along z; the lowest point if absent."},
       {.name = "zmax", .unit = "m", .doc = "Where it ends along z; the highest point if absent."},
       phimax_param(),
       alpha_param()}};
  return d;
}

ShapeGeometry SphereShape::create(const ParamReader& p, const ShapeContext&) {
  const double radius = p.number("radius");
  const double a = p.given("zmin") ? p.number("zmin") : -radius, b = p.given("zmax") ? p.number("zmax") : radius;
  // What lies beyond the poles cuts nothing off.
  const auto in_unit = [radius](double z) { return static_cast<float>(std::min(1.0, std::max(-1.0, z / radius))); };
  const QuadricPart part{QuadricPart::Kind::kSphere, in_unit(std::min(a, b)), in_unit(std::max(a, b)), phi_max_of(p)};
  if (part.lo >= part.hi) return report_empty(p, "zmin", "zmax"), ShapeGeometry();
  return {.quadric = QuadricShape{Transform::scale({radius, radius, radius}), part}};
}

const ModelDecl& CylinderShape::decl() {
  static const ModelDecl d{Family::kShape,
                           "cylinder",
                           "A cylinder around z without its ends, whose normals point outward.",
                           {radius_param("Radius."),
                            {.name = "zmin", .default_value = -1.0, .unit = "m", .doc = "Where it begins along z."},
                            {.name = "zmax", .default_value = 1.0, .unit = "m", .doc = "Where it ends along z."},
                            phimax_param(),
                            alpha_param()}};
  return d;
}

ShapeGeometry CylinderShape::create(const ParamReader& p, const ShapeContext&) {
  const double radius = p.number("radius"), a = p.number("zmin"), b = p.number("zmax");
  if (a == b) return report_empty(p, "zmin", "zmax"), ShapeGeometry();
  const double lo = std::min(a, b), height = std::max(a, b) - lo;
  return {.quadric = QuadricShape{Transform::translate({0, 0, lo}) * Transform::scale({radius, radius, height}),
                                  {QuadricPart::Kind::kCylinder, 0, 1, phi_max_of(p)}}};
}

const ModelDecl& DiskShape::decl() {
  static const ModelDecl d{
      Family::kShape,
      "disk",
      "A disk across z, or a ring, whose normal is +z.",
      {{.name = "height", .default_value = 0.0, .unit = "m", .doc = "Where it lies along z."},
       radius_param("Outer radius."),
       {.name = "innerradius", .default_value = 0.0, .min = 0, .unit = "m", .doc = "Radius of the hole."},
       phimax_param(),
       alpha_param()}};
  return d;
}

ShapeGeometry DiskShape::create(const ParamReader& p, const ShapeContext&) {
  const double radius = p.number("radius"), inner = p.number("innerradius") / radius;
  if (static_cast<float>(inner) >= 1.0f) return report_empty(p, "radius", "innerradius"), ShapeGeometry();
  return {.quadric = QuadricShape{
              Transform::translate({0, 0, p.number("height")}) * Transform::scale({radius, radius, radius}),
              {QuadricPart::Kind::kDisk, static_cast<float>(inner), 1, phi_max_of(p)}}};
}

}  // namespace etd
