// The surfaces that area lights can sit on: what an area light needs of its shape. Each can be sampled uniformly by
// area and, from points that see enough of it, uniformly by the solid angle it has there. Which of the two is used
// depends on the point alone, so that the density of a direction that was found otherwise is known.
#pragma once

#include <optional>

#include "core/solid_angle.h"
#include "lights/light_bounds.h"
#include "shapes/patch.h"
#include "shapes/quadric.h"
#include "shapes/triangle.h"

namespace etd {

// The points of a surface and their geometric normals.
struct SurfaceBounds {
  Bounds3 box;
  DirectionCone normals;
};

// Below this solid angle sampling by area is as good, and the differences of angles are not.
inline constexpr double kSmallSolidAngle = 1e-5;

// One triangle of a mesh that stays in place while the light lives.
class TriangleSurface {
 public:
  TriangleSurface(const Mesh& mesh, uint32_t triangle)
      : mesh_(&mesh), triangle_(triangle), area_(triangle_area(mesh, triangle)) {}

  float area() const { return area_; }
  SurfacePoint sample(Vec2 u, float& pdf_area) const {
    pdf_area = 1.0f / area_;
    return sample_triangle(*mesh_, triangle_, u);
  }
  float pdf_area(const SurfacePoint&) const { return 1.0f / area_; }
  SurfaceBounds bounds() const;

  // The surface as p sees it; nothing where sampling by area is to be used.
  struct View {
    const TriangleSurface& surface;
    Point3 p;
    SphericalTriangle seen;
    double solid_angle() const { return seen.solid_angle(); }
    SurfacePoint sample(Vec2 u) const;
  };
  std::optional<View> seen_from(Point3 p) const;

 private:
  const Mesh* mesh_;
  uint32_t triangle_;
  float area_;
};

// Two neighbouring triangles of a mesh that make a rectangle, with all that sampling it needs.
struct LightRectangle {
  // Returns the rectangle of the triangles `first` and first + 1, if they make one.
  static std::optional<LightRectangle> find(const Mesh& mesh, uint32_t first);

  // A triangle, from its right angle: x runs along the rectangle's x or against it, y as well.
  struct Half {
    Point3 corner, end_x, end_y;
    Vec2 uv, uv_x, uv_y;  // at these
    Vec3 ng;
    float error;  // TriangleFace's
  };
  Half halves[2];  // next to the frame's corner, and opposite to it
  RectangleFrame frame;
  float area;
  float edge;  // TriangleFace's, the greater one
};

class RectangleSurface {
 public:
  explicit RectangleSurface(const LightRectangle& rectangle) : rectangle_(&rectangle) {}

  float area() const { return rectangle_->area; }
  SurfacePoint sample(Vec2 u, float& pdf_area) const {
    pdf_area = 1.0f / area();
    return point({u.x, u.y});
  }
  float pdf_area(const SurfacePoint&) const { return 1.0f / area(); }
  SurfaceBounds bounds() const;

  struct View {
    const RectangleSurface& surface;
    SphericalRectangle seen;
    double solid_angle() const { return seen.solid_angle(); }
    SurfacePoint sample(Vec2 u) const { return surface.point(seen.sample(u)); }
  };
  std::optional<View> seen_from(Point3 p) const;

 private:
  // The point, without dpdu and dpdv, that lies these shares along the two edges from the corner.
  SurfacePoint point(Vec2T<double> at) const;

  const LightRectangle* rectangle_;
};

class QuadricSurface {
 public:
  explicit QuadricSurface(const Quadric& quadric);

  float area() const { return quadric_area(*quadric_); }
  SurfacePoint sample(Vec2 u, float& pdf_area) const {
    Vec3d q;
    const SurfacePoint s = sample_quadric(*quadric_, u, &q);
    pdf_area = quadric_pdf_area(*quadric_, q);
    return s;
  }
  float pdf_area(const SurfacePoint& s) const { return quadric_pdf_area(*quadric_, quadric_->unit_point(s.p)); }
  SurfaceBounds bounds() const;

  struct View {
    const QuadricSurface& surface;
    SphericalCap seen;
    double solid_angle() const { return seen.solid_angle(); }
    SurfacePoint sample(Vec2 u) const;
  };
  // Returns the view of a whole ball (no ellipsoid) from outside.
  std::optional<View> seen_from(Point3 p) const;

 private:
  const Quadric* quadric_;
  double ball_radius_;  // 0: it is none
};

// One bilinear patch of a mesh that stays in place while the light lives.
class PatchSurface {
 public:
  PatchSurface(const PatchMesh& mesh, uint32_t patch);

  float area() const { return area_; }
  SurfacePoint sample(Vec2 u, float& pdf_area) const {
    const SurfacePoint s = sample_patch(*mesh_, patch_, u);
    pdf_area = patch_pdf_area(*mesh_, patch_, s.parameters);
    return s;
  }
  float pdf_area(const SurfacePoint& s) const { return patch_pdf_area(*mesh_, patch_, s.parameters); }
  SurfaceBounds bounds() const;

  struct View {
    const PatchSurface& surface;
    SphericalRectangle seen;
    double solid_angle() const { return seen.solid_angle(); }
    SurfacePoint sample(Vec2 u) const;
  };
  // Returns the view of a rectangle; the solid angle of other patches has no closed form.
  std::optional<View> seen_from(Point3 p) const;

 private:
  const PatchMesh* mesh_;
  uint32_t patch_;
  float area_;
  bool is_rectangle_;
};

}  // namespace etd
