// Colours as the format writes them, made independent of it: rgb values of another ColorSpace become linear Rec.709,
// and names of files with a measured spectrum become its numbers.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "formats/pbrt/repeats.h"
#include "params/diagnostics.h"
#include "params/param.h"
#include "spectrum/color_space.h"

namespace etd::pbrt {

// Whether colours in a directive are of emitted light, or reflectances and the like.
enum class ColorRole : uint8_t { kReflectance, kEmission };

// Files of measured spectra; each is read once.
class SpectrumFiles {
 public:
  // Relative names start in `folder`.
  explicit SpectrumFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

  struct Spectrum {
    std::vector<double> numbers;  // pairs of a wavelength in nm and a value
    std::string problem;          // why there are none; empty: there are
  };
  const Spectrum& read(const std::string& name);
  bool knows(const std::string& name) const { return read_.count(name) > 0; }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
  std::map<std::string, Spectrum> read_;
};

// Lanes that Rec.709 cannot hold are set to the nearest it can (0, and for reflectances 1) with a warning. A file that
// cannot be read or holds no spectrum is an error at the parameter.
void convert_colors(std::vector<Param>& params, ColorRole role, ColorSpace space, SpectrumFiles& files,
                    Repeats& repeats, Diagnostics& diagnostics);

}  // namespace etd::pbrt
