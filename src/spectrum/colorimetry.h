// Spectra as functions of wavelength, and what three lanes of linear Rec.709 keep of them. One convention for all: the
// white of Rec.709 is illuminant D65, so a reflectance is seen under D65, a flat one keeps its value in all lanes, and
// light of the spectrum of D65 is (1, 1, 1) at luminance 1. Equations: docs/algorithms.md.
#pragma once

#include <functional>
#include <span>

#include "core/vec.h"
#include "spectrum/spectrum.h"

namespace etd {

// Value at a wavelength in nm.
using SpectralFunction = std::function<double(double)>;

// Linear between samples at increasing wavelengths. Outside of them the first or last value when `extend`, else 0.
double interpolate(std::span<const double> nm, std::span<const double> values, double at, bool extend);

// Relative power of illuminant D65, from 380 to 780 nm.
double d65(double nm);

// Planck's law (CODATA 2018 constants) at `kelvin` > 0, divided by its greatest value over all wavelengths.
double blackbody(double kelvin, double nm);

// Integrals with the matching functions of the CIE 1931 observer over 380 to 780 nm, in nm: a sum over every nm.
Vec3d cie_xyz(const SpectralFunction& f);

// CIE chromaticity x, y of a tabulated or other spectrum.
struct Chromaticity {
  double x, y;
};
Chromaticity chromaticity(const SpectralFunction& f);

// The colour of light with this spectrum, at luminance 1 whatever the size of f, as the pbrt-v4 format defines lights.
// Colours outside of Rec.709 have their negative lanes set to 0 and their luminance restored. Black stays black.
Spectrum emission_rgb(const SpectralFunction& f);

// Mean of f weighted by D65 and the Rec.709 matching functions, lane by lane: reflectances, indices of refraction and
// absorption. The weights have negative parts, so lanes of saturated spectra can leave [0, 1]; negative ones become 0.
Spectrum reflectance_rgb(const SpectralFunction& f);

}  // namespace etd
