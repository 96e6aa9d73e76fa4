#include "spectrum/named.h"

namespace etd {

std::optional<Spectrum> named_spectrum(std::string_view name) {
  // Copper, measured by Johnson and Christy (1972), averaged with the sRGB matching functions.
  if (name == "metal-Cu-eta") return Spectrum::rgb(0.200438f, 0.924033f, 1.102212f);
  if (name == "metal-Cu-k") return Spectrum::rgb(3.912949f, 2.452848f, 2.142188f);
  return {};
}

std::optional<float> named_glass(std::string_view name) {
  // n_d from the makers' data sheets.
  struct Glass {
    std::string_view name;
    float eta;
  };
  static constexpr Glass kGlasses[] = {
      {"glass-BK7", 1.5168f},   {"glass-BAF10", 1.67003f}, {"glass-FK51A", 1.48656f}, {"glass-LASF9", 1.85025f},
      {"glass-SF5", 1.67271f},  {"glass-F5", 1.67271f},    {"glass-SF10", 1.72828f},  {"glass-F10", 1.72828f},
      {"glass-SF11", 1.78472f}, {"glass-F11", 1.78472f},
  };
  for (const Glass& g : kGlasses)
    if (g.name == name) return g.eta;
  return {};
}

std::string_view named_glasses() {
  return "glass-BK7, glass-BAF10, glass-FK51A, glass-LASF9, glass-SF5, glass-SF10, glass-SF11";
}

}  // namespace etd
