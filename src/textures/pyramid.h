// The coarser levels of an image, for lookups over large footprints.
#pragma once

#include <vector>

#include "io/image.h"
#include "textures/wrap.h"

namespace etd {

// The next coarser level: half the size along each side (rounded down, at least 1), filtered in linear light with the
// cubic of Mitchell and Netravali (1988, "Reconstruction Filters in Computer Graphics", B = C = 1/3), whose integrals
// over the finer texels are the weights: a constant image stays what it is, and the mean of one that repeats too.
// Halves if the level is of bytes or halves, otherwise floats.
Image coarser_level(const Image& level, ImageWrap wrap);

// All coarser levels, down to a single texel.
std::vector<Image> coarser_levels(const Image& finest, ImageWrap wrap);

}  // namespace etd
