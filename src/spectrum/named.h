// Spectra that scene files name: their value per RGB lane, and glasses' index of refraction.
#pragma once

#include <optional>
#include <string_view>

#include "spectrum/spectrum.h"

namespace etd {

// "metal-Cu-eta" and "metal-Cu-k" as RGB; nothing for other names.
std::optional<Spectrum> named_spectrum(std::string_view name);

// Index of refraction of a named glass at the yellow helium line, 587.6 nm; nothing for an unknown name.
std::optional<float> named_glass(std::string_view name);
// The names that named_glass knows, for messages.
std::string_view named_glasses();

}  // namespace etd
