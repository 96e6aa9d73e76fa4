#include "formats/pbrt/color_values.h"

#include <fmt/format.h>

#include "formats/pbrt/tokenizer.h"
#include "io/missing_file.h"
#include "io/text_file.h"
#include "spectrum/named.h"

namespace etd::pbrt {

namespace {

void convert_rgb(Param& p, ColorRole role, ColorSpace space, Diagnostics& diagnostics) {
  double outside = 0.0;
  for (size_t i = 0; i + 2 < p.numbers.size(); i += 3) {
    const Vec3d rgb{p.numbers[i], p.numbers[i + 1], p.numbers[i + 2]};
    Vec3d v = role == ColorRole::kEmission ? emission_to_rec709(space, rgb) : reflectance_to_rec709(space, rgb);
    // Only where the value itself was in range: otherwise the check of parameters has something to say.
    const bool in_unit = std::max(rgb.x, std::max(rgb.y, rgb.z)) <= 1.0;
    const bool positive = std::min(rgb.x, std::min(rgb.y, rgb.z)) >= 0.0;
    for (int lane = 0; lane < 3; ++lane) {
      const double low = positive ? std::max(v[lane], 0.0) : v[lane];
      const double held = role == ColorRole::kReflectance && in_unit ? std::min(low, 1.0) : low;
      outside = std::max(outside, std::abs(held - v[lane]) / std::max(1.0, max_component(rgb)));
      p.numbers[i + static_cast<size_t>(lane)] = held;
    }
  }
  if (outside > 1e-3)
    diagnostics.warning(p.value_loc, fmt::format("the colour \"rgb {}\" lies outside of Rec. 709", p.name),
                        fmt::format("its lanes are clipped, by up to {:.2g} of its size", outside));
}

// Pairs of a wavelength in nm and a value, as text with # comments.
SpectrumFiles::Spectrum parse_spectrum(const std::string& text) {
  SpectrumFiles::Spectrum spectrum;
  for (size_t i = 0; i < text.size();) {
    const size_t line_end = std::min(text.find('\n', i), text.size());
    if (text[i] == '#') {
      i = line_end;
    } else if (std::isspace(static_cast<unsigned char>(text[i]))) {
      ++i;
    } else {
      const size_t end = std::min(text.find_first_of("# \t\n\v\f\r", i), text.size());
      const std::string_view word = std::string_view(text).substr(i, end - i);
      const std::optional<double> number = parse_number(word);
      if (!number) return {{}, fmt::format("{} is not a number", in_quotes(word))};
      spectrum.numbers.push_back(*number);
      i = end;
    }
  }
  if (spectrum.numbers.empty() || spectrum.numbers.size() % 2 != 0)
    return {{}, "it must hold pairs of a wavelength in nm and a value"};
  return spectrum;
}

void read_spectrum_file(Param& p, SpectrumFiles& files, Repeats& repeats, Diagnostics& diagnostics) {
  const std::string name = p.strings[0];
  const bool again = files.knows(name);
  const SpectrumFiles::Spectrum& spectrum = files.read(name);
  p.malformed = !spectrum.problem.empty();
  if (p.malformed) {
    diagnostics.error(p.value_loc, fmt::format("cannot read spectrum \"{}\": {}", name, spectrum.problem), [&] {
      const std::string missing =
          name.size() > kLongestName ? std::string() : missing_file_hint({files.folder()}, name);
      return fmt::format("{}{}valid: a file of wavelengths and values, or one of {}", missing,
                         missing.empty() ? "" : "\n", named_spectra());
    });
    return;
  }
  if (again) p.malformed = !repeats.take(spectrum.numbers.size() * sizeof(double), p.value_loc, diagnostics);
  p.strings.clear();
  if (!p.malformed) p.numbers = spectrum.numbers;
}

}  // namespace

const SpectrumFiles::Spectrum& SpectrumFiles::read(const std::string& name) {
  const auto [entry, is_new] = read_.try_emplace(name);
  if (!is_new) return entry->second;
  if (name.size() > kLongestName) return entry->second = {{}, "its name is too long"}, entry->second;
  const FileBytes file = read_text_file(folder_ / name);
  entry->second = file.error.empty() ? parse_spectrum(file.bytes) : Spectrum{{}, file.error};
  return entry->second;
}

void convert_colors(std::vector<Param>& params, ColorRole role, ColorSpace space, SpectrumFiles& files,
                    Repeats& repeats, Diagnostics& diagnostics) {
  for (Param& p : params) {
    if (p.malformed) continue;
    if (p.kind == ParamKind::kRgb && space != ColorSpace::kSrgb) convert_rgb(p, role, space, diagnostics);
    if (p.kind == ParamKind::kSpectrum && p.strings.size() == 1 && !named_spectrum(p.strings[0]))
      read_spectrum_file(p, files, repeats, diagnostics);
  }
}

}  // namespace etd::pbrt
