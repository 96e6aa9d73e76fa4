#include "spectrum/color_space.h"

#include <array>

#include "spectrum/colorimetry.h"

namespace etd {

namespace {

struct Matrix {
  Vec3d rows[3];

  Vec3d operator*(const Vec3d& v) const { return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)}; }
  Matrix transposed() const {
    return {{{rows[0].x, rows[1].x, rows[2].x}, {rows[0].y, rows[1].y, rows[2].y}, {rows[0].z, rows[1].z, rows[2].z}}};
  }
  Matrix operator*(const Matrix& b) const {
    const Matrix t = b.transposed();
    return Matrix{{t * rows[0], t * rows[1], t * rows[2]}};
  }
  // Inverts a regular matrix by cross products.
  Matrix inverse() const {
    const Vec3d a = cross(rows[1], rows[2]), b = cross(rows[2], rows[0]), c = cross(rows[0], rows[1]);
    const double s = 1.0 / dot(rows[0], a);
    return Matrix{{a * s, b * s, c * s}}.transposed();
  }
};

Matrix diagonal(const Vec3d& d) { return {{{d.x, 0, 0}, {0, d.y, 0}, {0, 0, d.z}}}; }

Vec3d xyz_of(Chromaticity c) { return {c.x / c.y, 1.0, (1.0 - c.x - c.y) / c.y}; }

struct Definition {
  std::string_view name;
  Chromaticity red, green, blue;
};
// ITU-R BT.709, SMPTE RP 431-2 (primaries), ITU-R BT.2020, SMPTE ST 2065-1.
constexpr Definition kDefinitions[] = {
    {"srgb", {0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}},
    {"dci-p3", {0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}},
    {"rec2020", {0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}},
    {"aces2065-1", {0.7347, 0.2653}, {0.0, 1.0}, {0.0001, -0.0770}},
};

// XYZ of linear RGB: columns are the primaries, scaled so that (1, 1, 1) is the white at Y = 1 (Lindbloom 2017).
Matrix rgb_to_xyz(const Definition& d, const Vec3d& white) {
  const Matrix primaries = Matrix{{xyz_of(d.red), xyz_of(d.green), xyz_of(d.blue)}}.transposed();
  return primaries * diagonal(primaries.inverse() * white);
}

// Takes XYZ seen under one white to the other (Lam 1985, the Bradford transform).
Matrix adaptation(const Vec3d& from, const Vec3d& to) {
  constexpr Matrix kBradford{{{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};
  const Vec3d f = kBradford * from, t = kBradford * to;
  return kBradford.inverse() * diagonal({t.x / f.x, t.y / f.y, t.z / f.z}) * kBradford;
}

struct Tables {
  Vec3d white;              // D65
  Matrix to_xyz, from_xyz;  // of Rec.709
  std::array<Matrix, std::size(kDefinitions)> emission, reflectance;

  Tables() {
    white = xyz_of(chromaticity(d65));
    to_xyz = rgb_to_xyz(kDefinitions[0], white);
    from_xyz = to_xyz.inverse();
    for (size_t i = 0; i < emission.size(); ++i) {
      // The white of ACES (SMPTE ST 2065-1, table 1); the others have D65.
      const bool aces = static_cast<ColorSpace>(i) == ColorSpace::kAces2065;
      const Vec3d own = aces ? xyz_of({0.32168, 0.33767}) : white;
      const Matrix own_to_xyz = rgb_to_xyz(kDefinitions[i], own);
      emission[i] = from_xyz * own_to_xyz;
      reflectance[i] = from_xyz * adaptation(own, white) * own_to_xyz;
    }
  }
};

const Tables& tables() {
  static const Tables t;
  return t;
}

}  // namespace

std::optional<ColorSpace> find_color_space(std::string_view name) {
  for (size_t i = 0; i < std::size(kDefinitions); ++i)
    if (kDefinitions[i].name == name) return static_cast<ColorSpace>(i);
  return {};
}

Vec3d xyz_to_rec709(const Vec3d& xyz) { return tables().from_xyz * xyz; }

Vec3d rec709_to_xyz(const Vec3d& rgb) { return tables().to_xyz * rgb; }

std::array<Vec3d, 3> adapt_rec709(const Vec3d& white) {
  const Tables& t = tables();
  const Matrix m = t.from_xyz * adaptation(white, t.white * white.y) * t.to_xyz;
  return {m.rows[0], m.rows[1], m.rows[2]};
}

Vec3d emission_to_rec709(ColorSpace space, const Vec3d& rgb) {
  return tables().emission[static_cast<size_t>(space)] * rgb;
}

Vec3d reflectance_to_rec709(ColorSpace space, const Vec3d& rgb) {
  return tables().reflectance[static_cast<size_t>(space)] * rgb;
}

}  // namespace etd
