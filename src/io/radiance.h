// Radiance pictures (.hdr, .pic): colours with a shared exponent. Our own reader, because others know neither the older
// of the two compressions, nor XYZ, nor all eight directions of rows.
// Format: Greg Ward, "Radiance File Formats", and color.c of Radiance (freadcolrs, oldreadcolrs).
#pragma once

#include <string_view>

#include "io/image.h"

namespace etd {

// Whether these bytes begin like a Radiance picture.
inline bool is_radiance(std::string_view bytes) { return bytes.substr(0, 2) == "#?"; }

// The picture with row 0 at its top and column 0 at its left. Values are the file's, XYZ as linear Rec. 709.
ImageResult decode_radiance(std::string_view bytes, const Limits& limits = {});

// Bytes of its texels in memory by what the header says; 0 if that cannot be read.
size_t radiance_bytes(std::string_view bytes);

}  // namespace etd
