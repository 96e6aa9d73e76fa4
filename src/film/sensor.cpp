#include "film/sensor.h"

#include <fmt/format.h>

#include "spectrum/color_space.h"
#include "spectrum/white_balance.h"

namespace etd {

std::vector<ParamDecl> Sensor::params() {
  return {
      {.name = "sensor",
       .type = ParamType::kString,
       .default_value = std::string("cie1931"),
       .doc = "Whose eyes: cie1931 is the standard observer. The measured cameras of pbrt need spectra, which there "
              "are none of: they are unsupported."},
      {.name = "iso", .default_value = 100.0, .min = 0, .doc = "Sensitivity: radiance is multiplied by iso / 100."},
      {.name = "exposuretime",
       .min = 0,
       .unit = "s",
       .doc = "Exposure time, by which radiance is multiplied; by default the time that the camera's shutter is open, "
              "1 if it is an instant. (Of Etendue: pbrt knows the shutter alone.)"},
      {.name = "imagingratio",
       .min = 0,
       .doc = "What radiance is multiplied by, instead of exposuretime times iso / 100."},
      {.name = "whitebalance",
       .default_value = 0.0,
       .min = 0,
       .max = kHottestWhite,
       .unit = "K",
       .doc = "Colour temperature, from 1500 on, of the light that shall look white; 0: no white balance."},
      {.name = "maxcomponentvalue",
       .min = 0,
       .above_min = true,
       .doc = "Samples whose largest component is above are scaled down to it: less noise, but a biased image, which "
              "is labelled so."}};
}

Sensor Sensor::create(const ParamReader& p, double shutter) {
  if (const Param* named = p.given("sensor"); named && named->strings[0] != "cie1931")
    p.diagnostics().unsupported(named->value_loc, fmt::format("sensor \"{}\"", named->strings[0]),
                                "the CIE 1931 observer, \"cie1931\"");
  Sensor s;
  const Param* time = p.given("exposuretime");
  s.imaging_ratio = (time ? time->numbers[0] : shutter) * p.number("iso") / 100.0;
  if (const Param* ratio = p.given("imagingratio")) {
    if (time || p.given("iso"))
      p.diagnostics().error(ratio->loc, "\"imagingratio\" is given beside what it stands for",
                            "give either it, or \"iso\" and \"exposuretime\"");
    s.imaging_ratio = ratio->numbers[0];
  }
  if (const Param* limit = p.given("maxcomponentvalue")) s.max_component = limit->numbers[0];
  s.white_balance = p.number("whitebalance");
  if (s.white_balance > 0 && s.white_balance < kCoolestWhite) {
    p.diagnostics().error(
        p.given("whitebalance")->value_loc,
        fmt::format("\"whitebalance\" is {} K, which no light has that can look white", s.white_balance),
        fmt::format("valid: 0, or {} to {}", kCoolestWhite, kHottestWhite));
    s.white_balance = 0;
  }
  s.changes_colours_ = s.white_balance > 0;
  if (s.changes_colours_) {
    const std::array<Vec3d, 3> rows = adapt_rec709(white_of_temperature(s.white_balance));
    for (size_t i = 0; i < 3; ++i) s.rows_[i] = to_float(rows[i] * s.imaging_ratio);
  }
  return s;
}

void Sensor::expose(PixelSample& sample) const {
  const std::array<Spectrum*, 3> parts = {&sample.emission, &sample.direct, &sample.indirect};
  if (changes_colours_) {
    for (Spectrum* part : parts) {
      const Vec3 v{(*part)[0], (*part)[1], (*part)[2]};
      *part = Spectrum::rgb(dot(rows_[0], v), dot(rows_[1], v), dot(rows_[2], v));
    }
  } else if (imaging_ratio != 1.0) {
    for (Spectrum* part : parts) *part *= static_cast<float>(imaging_ratio);
  }
  if (max_component == HUGE_VAL) return;
  const float largest = max_value(sample.emission + sample.direct + sample.indirect);
  if (!(largest > max_component)) return;
  for (Spectrum* part : parts) *part *= static_cast<float>(max_component / largest);
}

std::string Sensor::bias() const {
  return max_component == HUGE_VAL ? std::string()
                                   : fmt::format("samples brighter than {} are scaled down to it", max_component);
}

}  // namespace etd
