// Tables of the CIE over the visible wavelengths: data only.
#pragma once

#include <array>
#include <span>
#include <string_view>

namespace etd {

// Values at 380, 385, ... 780 nm.
inline constexpr double kVisibleFirst = 380, kVisibleLast = 780, kVisibleStep = 5;
using VisibleTable = std::array<double, 81>;
// Linear between the values of a table; 0 outside of its range.
double visible_value(const VisibleTable& table, double nm);

// Matching functions of the 1931 standard observer. What lies beyond 380 and 780 nm is at most 4e-4 of an integral.
extern const VisibleTable kCieX, kCieY, kCieZ;

struct Illuminant {
  std::string_view name;  // as scene files write it: "stdillum-D65"
  VisibleTable power;     // relative spectral power
};
std::span<const Illuminant> illuminants();

}  // namespace etd
