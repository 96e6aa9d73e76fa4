// The RGB colour spaces that scenes are written in, and the way from them to linear Rec.709. Only linear values: images
// carry their own encoding.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "core/vec.h"

namespace etd {

enum class ColorSpace : uint8_t { kSrgb, kDciP3, kRec2020, kAces2065 };
// "srgb", "dci-p3" (its display variant with the white of D65), "rec2020", "aces2065-1"; nothing for other names.
std::optional<ColorSpace> find_color_space(std::string_view name);

// Linear Rec.709 of CIE XYZ; the white is that of the tabulated D65.
Vec3d xyz_to_rec709(const Vec3d& xyz);
// The way back.
Vec3d rec709_to_xyz(const Vec3d& rgb);

// Rows of the matrix that takes linear Rec.709 seen under a white (XYZ, its Y kept) to D65, by Bradford's chromatic
// adaptation. The white must have positive responses there, as every mixture of the primaries of Rec.709 has.
std::array<Vec3d, 3> adapt_rec709(const Vec3d& white);

// The same colour of light in linear Rec.709. Lanes are negative where Rec.709 does not reach.
Vec3d emission_to_rec709(ColorSpace space, const Vec3d& rgb);
// The same for a reflectance: white, which reflects everything, stays (1, 1, 1), by Bradford's chromatic adaptation.
Vec3d reflectance_to_rec709(ColorSpace space, const Vec3d& rgb);

}  // namespace etd
