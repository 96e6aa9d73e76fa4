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
void read_spectrum_file(Param& p, const std::filesystem::path& folder, Diagnostics& diagnostics) {
  const FileBytes file = read_text_file(folder / p.strings[0]);
  const auto fail = [&](const std::string& why) {
    const std::string missing = missing_file_hint({folder}, p.strings[0]);
    diagnostics.error(p.value_loc, fmt::format("cannot read spectrum \"{}\": {}", p.strings[0], why),
                      fmt::format("{}{}valid: a file of wavelengths and values, or one of {}", missing,
                                  missing.empty() ? "" : "\n", named_spectra()));
    p.malformed = true;
  };
  if (!file.error.empty()) return fail(file.error);
  std::vector<double> numbers;
  const std::string& text = file.bytes;
  for (size_t i = 0; i < text.size();) {
    const size_t line_end = std::min(text.find('\n', i), text.size());
    if (text[i] == '#') {
      i = line_end;
    } else if (std::isspace(static_cast<unsigned char>(text[i]))) {
      ++i;
    } else {
      size_t end = i;
      while (end < line_end && text[end] != '#' && !std::isspace(static_cast<unsigned char>(text[end]))) ++end;
      const std::optional<double> number = parse_number(std::string_view(text).substr(i, end - i));
      if (!number) return fail(fmt::format("{} is not a number", in_quotes(text.substr(i, end - i))));
      numbers.push_back(*number);
      i = end;
    }
  }
  if (numbers.empty() || numbers.size() % 2 != 0) return fail("it must hold pairs of a wavelength in nm and a value");
  p.strings.clear();
  p.numbers = std::move(numbers);
}

}  // namespace

void convert_colors(std::vector<Param>& params, ColorRole role, ColorSpace space, const std::filesystem::path& folder,
                    Diagnostics& diagnostics) {
  for (Param& p : params) {
    if (p.malformed) continue;
    if (p.kind == ParamKind::kRgb && space != ColorSpace::kSrgb) convert_rgb(p, role, space, diagnostics);
    if (p.kind == ParamKind::kSpectrum && p.strings.size() == 1 && !named_spectrum(p.strings[0]))
      read_spectrum_file(p, folder, diagnostics);
  }
}

}  // namespace etd::pbrt
