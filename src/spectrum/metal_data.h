// The measured index of refraction and absorption of the metals that scene files name: data only.
#pragma once

#include <span>
#include <string_view>

namespace etd {

struct MetalData {
  std::string_view name;           // as in "metal-Cu-eta"
  std::span<const double> nm;      // increasing
  std::span<const double> eta, k;  // at these wavelengths; an empty k is 0
};
std::span<const MetalData> metal_data();

}  // namespace etd
