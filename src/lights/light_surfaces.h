// The surfaces that area lights can sit on: what an area light needs of its shape.
#pragma once

#include "shapes/sphere.h"
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

struct SphereSurface {
  const Sphere* sphere = nullptr;

  explicit SphereSurface(const Sphere& s) : sphere(&s) {}
  float area() const { return sphere_area(*sphere); }
  SurfacePoint sample(Vec2 u, float& pdf_area) const {
    Vec3 n;
    const SurfacePoint s = sample_sphere(*sphere, u, &n);
    pdf_area = sphere_pdf_area(*sphere, n);
    return s;
  }
  float pdf_area(Point3 p) const {
    const Point3 q = sphere->to_object.point(p);
    return sphere_pdf_area(*sphere, normalize(Vec3{q.x, q.y, q.z}));
  }
};

}  // namespace etd
