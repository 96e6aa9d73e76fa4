#include "materials/surface_detail.h"

#include "io/layer_param.h"

namespace etd {

std::vector<ParamDecl> SurfaceDetail::params() {
  return {
      {.name = "displacement",
       .type = ParamType::kFloatTexture,
       .default_value = 0.0,
       .doc = "Height of bumps above the surface, in its units: tilts the shading normal, moves nothing."},
      {.name = "normalmap",
       .type = ParamType::kImageTexture,
       .doc = "Image of normals as (n + 1) / 2: red tilts towards growing u, green towards growing v, also where uv "
              "or the surface are mirrored."},
      layer_param("normalmap")};
}

SurfaceDetail SurfaceDetail::create(const ParamReader& p, TextureBuilder& b) {
  SurfaceDetail d;
  d.displacement = b.number(p, "displacement");
  const Param* file = p.given("normalmap");
  const bool is_texture = file && file->kind == ParamKind::kTexture;
  if (!file || is_texture) reject_layer_without_file(p, "normalmap");
  if (file) {
    d.normal_map = is_texture ? b.spectrum(p, "normalmap").texture
                              : b.image_texture(*file, "linear", layer_name(p), p.diagnostics());
    if (d.displacement.texture >= 0)
      p.diagnostics().warning(file->loc, "a material with a normal map ignores its \"displacement\"");
  }
  return d;
}

namespace {

// Steps over uv for differences: half the footprint of a pixel, which is as fine as can be seen; without one, small
// beside texels and large beside the rounding of uv.
float step_of(float change_x, float change_y) {
  constexpr float kUsual = 5e-4f, kSmallest = 1e-5f;
  const float footprint = std::abs(change_x) + std::abs(change_y);
  return footprint > 0.0f ? std::max(0.5f * footprint, kSmallest) : kUsual;
}

// The normal of the surface moved by d along n is along n - grad d, where grad is taken along the surface (Blinn 1978;
// d times the surface's curvature is left out).
Vec3 bumped(const FloatSource& height, const SurfacePoint& point, const TexCoord& at, const TextureTable& textures,
            const ShadingContext& context) {
  const Vec3 n = point.ns;
  const float area = dot(n, cross(point.dpdu, point.dpdv));
  if (area == 0.0f) return n;
  TexCoord beside = at, above = at;
  const float du = step_of(at.duv_dx.x, at.duv_dy.x), dv = step_of(at.duv_dx.y, at.duv_dy.y);
  beside.uv.x += du;
  beside.p = at.p + point.dpdu * du;
  above.uv.y += dv;
  above.p = at.p + point.dpdv * dv;
  const float d = textures.eval(height, at, context);
  const float d_u = (textures.eval(height, beside, context) - d) / du,
              d_v = (textures.eval(height, above, context) - d) / dv;
  const Vec3 gradient = (cross(point.dpdv, n) * d_u + cross(n, point.dpdu) * d_v) * (1.0f / area);
  return is_finite(gradient) ? normalize(n - gradient) : n;
}

// 1 where u, v and the normal are right-handed, -1 where mirrored uv, a mirrored object or a reversed orientation make
// them left-handed.
float handedness(const SurfacePoint& point) {
  return dot(point.ng, cross(point.dpdu, point.dpdv)) < 0.0f ? -1.0f : 1.0f;
}

}  // namespace

Frame SurfaceDetail::frame(const SurfacePoint& point, const TexCoord& at, const TextureTable& textures,
                           const ShadingContext& context) const {
  const Frame plain = Frame::from_z_tangent(point.ns, point.dpdu);
  Vec3 n = point.ns;
  if (normal_map >= 0) {
    const Spectrum rgb = textures.eval(SpectrumSource{{}, normal_map}, at, context);
    if (is_black(rgb)) return plain;  // outside of an image that is not repeated: no normal at all
    // The normal of the map is given towards growing u and v. The frame below is right-handed all the same: closures do
    // not tell y from -y.
    const Vec3 local{2.0f * rgb[0] - 1.0f, (2.0f * rgb[1] - 1.0f) * handedness(point), 2.0f * rgb[2] - 1.0f};
    if (!(dot(local, local) > 1e-8f)) return plain;
    n = normalize(plain.to_world(local));
  } else if (displacement.texture >= 0) {
    n = bumped(displacement, point, at, textures, context);
  } else {
    return plain;
  }
  return Frame::from_z_tangent(face_forward(n, point.ng), point.dpdu);
}

}  // namespace etd
