#include "textures/mapping.h"

#include <fmt/format.h>

#include "textures/resolve.h"

namespace etd {

ModelDecl with_mapping(ModelDecl decl) {
  const std::vector<ParamDecl> params = {
      {.name = "mapping",
       .type = ParamType::kString,
       .default_value = std::string("uv"),
       .choices = {"uv", "spherical", "cylindrical", "planar"},
       .doc =
           "What the two coordinates s and t are: the surface's uv, or angles, height or distances in texture space."},
      {.name = "uscale", .default_value = 1.0, .doc = "Mapping uv: repetitions along u."},
      {.name = "vscale", .default_value = 1.0, .doc = "Mapping uv: repetitions along v."},
      {.name = "udelta", .default_value = 0.0, .doc = "Mappings uv and planar: added to s."},
      {.name = "vdelta", .default_value = 0.0, .doc = "Mappings uv and planar: added to t."},
      {.name = "v1",
       .type = ParamType::kVector3,
       .default_value = std::vector<double>{1, 0, 0},
       .doc = "Mapping planar: s is the product of this vector and the point."},
      {.name = "v2",
       .type = ParamType::kVector3,
       .default_value = std::vector<double>{0, 1, 0},
       .doc = "Mapping planar: t is the product of this vector and the point."}};
  decl.params.insert(decl.params.end(), params.begin(), params.end());
  return decl;
}

void warn_of_unread_mapping(const ParamReader& p, std::initializer_list<std::string_view> unread,
                            std::string_view reader) {
  for (const std::string_view name : unread)
    if (const Param* given = p.given(name))
      p.diagnostics().warning(given->loc, fmt::format("\"{}\" is not read by {}", name, reader));
}

Mapping2 Mapping2::create(const ParamReader& p, TextureBuilder& b) {
  const std::string name = p.string("mapping");
  Mapping2 m;
  m.du = static_cast<float>(p.number("udelta"));
  m.dv = static_cast<float>(p.number("vdelta"));
  if (name == "uv") {
    m.su = static_cast<float>(p.number("uscale"));
    m.sv = static_cast<float>(p.number("vscale"));
    warn_of_unread_mapping(p, {"v1", "v2"}, "the mapping uv");
    return m;
  }
  m.space = b.space(p);
  if (name == "planar") {
    const std::vector<double> v1 = p.numbers("v1"), v2 = p.numbers("v2");
    m.kind = Kind::kPlanar;
    m.v1 = to_float(Vec3d{v1[0], v1[1], v1[2]});
    m.v2 = to_float(Vec3d{v2[0], v2[1], v2[2]});
    warn_of_unread_mapping(p, {"uscale", "vscale"}, "the mapping planar");
    return m;
  }
  m.kind = name == "spherical" ? Kind::kSpherical : Kind::kCylindrical;
  warn_of_unread_mapping(p, {"uscale", "vscale", "udelta", "vdelta", "v1", "v2"}, fmt::format("the mapping {}", name));
  return m;
}

Mapping3 Mapping3::create(const ParamReader& p, TextureBuilder& b) { return {b.space(p)}; }

namespace {

float finite(float x) { return std::isfinite(x) ? x : 0.0f; }
Vec2 finite(Vec2 v) { return {finite(v.x), finite(v.y)}; }
Vec3 finite(Vec3 v) { return {finite(v.x), finite(v.y), finite(v.z)}; }

// Coordinates st at a point, with their gradients there, and how they change over the footprint.
MappedPoint2 with_changes(Vec2 st, Vec3 ds, Vec3 dt, const MappedPoint3& at) {
  return {finite(st), finite(Vec2{dot(ds, at.dx), dot(dt, at.dx)}), finite(Vec2{dot(ds, at.dy), dot(dt, at.dy)})};
}

constexpr float kInv2Pi = 0.5f * kInvPi;

// s = theta / pi from +z, t = phi / (2 pi) from +x towards +y.
MappedPoint2 spherical(const MappedPoint3& at) {
  const Vec3 v = at.p - Point3{};
  const float rho2 = v.x * v.x + v.y * v.y, rho = std::sqrt(rho2), r2 = rho2 + v.z * v.z;
  const float phi = std::atan2(v.y, v.x);
  const Vec3 ds = Vec3{v.x * v.z / rho, v.y * v.z / rho, -rho} * (kInvPi / r2);
  const Vec3 dt = Vec3{-v.y, v.x, 0} * (kInv2Pi / rho2);
  return with_changes({std::atan2(rho, v.z) * kInvPi, (phi < 0 ? phi + 2 * kPi : phi) * kInv2Pi}, ds, dt, at);
}

// s = phi / (2 pi) from -x towards -y, t = z.
MappedPoint2 cylindrical(const MappedPoint3& at) {
  const Vec3 v = at.p - Point3{};
  const Vec3 ds = Vec3{-v.y, v.x, 0} * (kInv2Pi / (v.x * v.x + v.y * v.y));
  return with_changes({(kPi + std::atan2(v.y, v.x)) * kInv2Pi, v.z}, ds, {0, 0, 1}, at);
}

}  // namespace

MappedPoint2 Mapping2::operator()(const TexCoord& at, const TextureTable& table) const {
  if (kind == Kind::kUv)
    return {finite(Vec2{su * at.uv.x + du, sv * at.uv.y + dv}), finite(Vec2{su * at.duv_dx.x, sv * at.duv_dx.y}),
            finite(Vec2{su * at.duv_dy.x, sv * at.duv_dy.y})};
  const MappedPoint3 in_space = Mapping3{space}(at, table);
  if (kind == Kind::kSpherical) return spherical(in_space);
  if (kind == Kind::kCylindrical) return cylindrical(in_space);
  const Vec3 v = in_space.p - Point3{};
  return with_changes({du + dot(v, v1), dv + dot(v, v2)}, v1, v2, in_space);
}

MappedPoint3 Mapping3::operator()(const TexCoord& at, const TextureTable& table) const {
  const Affine& to_texture = table.spaces[static_cast<size_t>(space)];
  return {Point3{} + finite(to_texture.point(at.p) - Point3{}), finite(to_texture.vector(at.dp_dx)),
          finite(to_texture.vector(at.dp_dy))};
}

}  // namespace etd
