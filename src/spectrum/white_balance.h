// The colour of light by its temperature: what a picture's white balance names.
#pragma once

#include "core/vec.h"

namespace etd {

// The range of colour temperatures, in kelvin.
inline constexpr double kCoolestWhite = 1500, kHottestWhite = 25000;

// CIE XYZ at Y = 1 of light of this colour temperature: a black body up to 4000 K, from 5000 K on daylight (CIE
// 15:2004, section 3.1), and between them the one goes over to the other. 6504 K is the white of Rec.709. With
// adapt_rec709() it balances a picture.
Vec3d white_of_temperature(double kelvin);

}  // namespace etd
