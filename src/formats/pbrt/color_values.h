// Colours as the format writes them, made independent of it: rgb values of another ColorSpace become linear Rec.709,
// and names of files with a measured spectrum become its numbers.
#pragma once

#include <filesystem>

#include "params/diagnostics.h"
#include "params/param.h"
#include "spectrum/color_space.h"

namespace etd::pbrt {

// Whether colours in a directive are of emitted light, or reflectances and the like.
enum class ColorRole : uint8_t { kReflectance, kEmission };

// Lanes that Rec.709 cannot hold are set to the nearest it can (0, and for reflectances 1) with a warning. A file that
// cannot be read or holds no spectrum is an error at the parameter.
void convert_colors(std::vector<Param>& params, ColorRole role, ColorSpace space, const std::filesystem::path& folder,
                    Diagnostics& diagnostics);

}  // namespace etd::pbrt
