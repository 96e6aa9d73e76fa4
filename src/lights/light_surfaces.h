// The surfaces that area lights can sit on: what an area light needs of its shape.
#pragma once

#include "shapes/quadric.h"
#include "shapes/triangle.h"

namespace etd {

// One triangle of a mesh that stays in place while the light lives.
struct TriangleSurface {
  const Mesh* mesh = nullptr;
  uint32_t triangle = 0;
  float total_area = 0;

  TriangleSurface(const Mesh& m, uint32_t t) : mesh(&m), triangle(t), total_area(triangle_area(m, t)) {}
  float area() const { return total_area; }
  SurfacePoint sample(Vec2 u, float& pdf_area) const {
    pdf_area = 1.0f / total_area;
    return sample_triangle(*mesh, triangle, u);
  }
  float pdf_area(Point3) const { return 1.0f / total_area; }
};

struct QuadricSurface {
  const Quadric* quadric = nullptr;

  explicit QuadricSurface(const Quadric& q) : quadric(&q) {}
  float area() const { return quadric_area(*quadric); }
  SurfacePoint sample(Vec2 u, float& pdf_area) const {
    Vec3 q;
    const SurfacePoint s = sample_quadric(*quadric, u, &q);
    pdf_area = quadric_pdf_area(*quadric, q);
    return s;
  }
  float pdf_area(Point3 p) const { return quadric_pdf_area(*quadric, quadric->unit_point(p)); }
};

}  // namespace etd
