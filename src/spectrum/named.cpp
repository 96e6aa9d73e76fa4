#include "spectrum/named.h"

#include "spectrum/cie_data.h"
#include "spectrum/metal_data.h"

namespace etd {

namespace {

// Sellmeier coefficients of the maker's data sheets (SCHOTT 2017; of the N- variants where there are two): n^2 = 1 +
// sum of b w^2 / (w^2 - c), w in micrometres. They give the tables of pbrt-v4's source to all their digits.
struct Glass {
  std::string_view name;
  double b[3], c[3];
};
constexpr Glass kGlasses[] = {
    {"BK7", {1.03961212, 0.231792344, 1.01046945}, {0.00600069867, 0.0200179144, 103.560653}},
    {"BAF10", {1.5851495, 0.143559385, 1.08521269}, {0.00926681282, 0.0424489805, 105.613573}},
    {"FK51A", {0.971247817, 0.216901417, 0.904651666}, {0.00472301995, 0.0153575612, 168.68133}},
    {"LASF9", {2.00029547, 0.298926886, 1.80691843}, {0.0121426017, 0.0538736236, 156.530829}},
    {"SF5", {1.52481889, 0.187085527, 1.42729015}, {0.011254756, 0.0588995392, 129.141675}},
    {"SF10", {1.62153902, 0.256287842, 1.64447552}, {0.0122241457, 0.0595736775, 147.468793}},
    {"SF11", {1.73759695, 0.313747346, 1.89878101}, {0.013188707, 0.0623068142, 155.23629}},
};

double sellmeier(const Glass& g, double nm) {
  const double w2 = nm * nm * 1e-6;
  double n2 = 1.0;
  for (int i = 0; i < 3; ++i) n2 += g.b[i] * w2 / (w2 - g.c[i]);
  return std::sqrt(n2);
}

bool remove_prefix(std::string_view& text, std::string_view prefix) {
  if (text.substr(0, prefix.size()) != prefix) return false;
  text.remove_prefix(prefix.size());
  return true;
}

// "glass-BK7"; the format writes the flint glasses SF5, SF10 and SF11 also as F5, F10 and F11.
const Glass* find_glass(std::string_view name) {
  if (!remove_prefix(name, "glass-")) return nullptr;
  for (const Glass& g : kGlasses)
    if (g.name == name || (g.name.substr(0, 2) == "SF" && g.name.substr(1) == name)) return &g;
  return nullptr;
}

std::optional<SpectralFunction> find_metal(std::string_view name) {
  if (!remove_prefix(name, "metal-")) return {};
  const size_t dash = name.rfind('-');
  if (dash == std::string_view::npos) return {};
  const std::string_view which = name.substr(dash + 1);
  if (which != "eta" && which != "k") return {};
  for (const MetalData& m : metal_data()) {
    if (m.name != name.substr(0, dash)) continue;
    const std::span<const double> values = which == "eta" ? m.eta : m.k;
    if (values.empty()) return [](double) { return 0.0; };
    const std::span<const double> wavelengths = m.nm;
    return [wavelengths, values](double nm) { return interpolate(wavelengths, values, nm, true); };
  }
  return {};
}

}  // namespace

std::optional<SpectralFunction> named_spectrum(std::string_view name) {
  if (auto metal = find_metal(name)) return metal;
  if (const Glass* glass = find_glass(name)) return [glass](double nm) { return sellmeier(*glass, nm); };
  for (const Illuminant& illuminant : illuminants())
    if (illuminant.name == name) {
      const VisibleTable& power = illuminant.power;
      return [&power](double nm) { return visible_value(power, nm); };
    }
  return {};
}

std::string named_spectra() {
  std::string list = named_glasses();
  for (const MetalData& m : metal_data()) list += ", metal-" + std::string(m.name) + "-eta and -k";
  for (const Illuminant& i : illuminants()) list += ", " + std::string(i.name);
  return list;
}

std::optional<float> named_glass(std::string_view name) {
  const Glass* glass = find_glass(name);
  if (!glass) return {};
  return static_cast<float>(sellmeier(*glass, 587.5618));
}

std::string named_glasses() {
  std::string list;
  for (const Glass& g : kGlasses) list += (list.empty() ? "glass-" : ", glass-") + std::string(g.name);
  return list;
}

}  // namespace etd
