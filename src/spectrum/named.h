// Spectra that scene files refer to by name: metals, glasses and standard illuminants.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "spectrum/colorimetry.h"

namespace etd {

// "metal-Cu-eta", "metal-Cu-k", "glass-BK7", "stdillum-D65", ...; nothing for other names. Metals keep their outermost
// values beyond the measured range.
std::optional<SpectralFunction> named_spectrum(std::string_view name);
// All names, for messages.
std::string named_spectra();

// Index of refraction of a named glass at the yellow helium line, 587.6 nm; nothing for an unknown name.
std::optional<float> named_glass(std::string_view name);
// The names that named_glass knows, for messages.
std::string named_glasses();

}  // namespace etd
