#include "textures/resolve.h"

#include <fmt/format.h>

#include "spectrum/named.h"

namespace etd {

namespace {

Spectrum from_numbers(const std::vector<double>& v) {
  if (v.size() == 1) return Spectrum(static_cast<float>(v[0]));
  return Spectrum::rgb(static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]));
}

Spectrum from_default(const ParamDefault& d) {
  if (const auto* number = std::get_if<double>(&d)) return Spectrum(static_cast<float>(*number));
  if (const auto* numbers = std::get_if<std::vector<double>>(&d)) return from_numbers(*numbers);
  if (const auto* name = std::get_if<std::string>(&d)) return named_spectrum(*name).value_or(Spectrum(1.0f));
  return Spectrum(0.0f);
}

// What stands in for a spectrum that has no RGB meaning yet.
Spectrum unsupported_spectrum(const Param& p, const std::string& what, float substitute, Diagnostics& diagnostics) {
  diagnostics.unsupported(p.value_loc, what, fmt::format("the constant {:g}", substitute));
  return Spectrum(substitute);
}

Spectrum from_param(const Param& p, const Spectrum& fallback, Diagnostics& diagnostics) {
  switch (p.kind) {
    case ParamKind::kFloat:
    case ParamKind::kRgb:
      return from_numbers(p.numbers);
    case ParamKind::kBlackbody:
      return unsupported_spectrum(p, "a blackbody spectrum", 1.0f, diagnostics);
    case ParamKind::kSpectrum:
      break;
    default:
      return fallback;
  }
  if (!p.strings.empty()) {
    if (const auto named = named_spectrum(p.strings[0])) return *named;
    diagnostics.unsupported(p.value_loc, fmt::format("the named spectrum \"{}\"", p.strings[0]),
                            "the parameter's default");
    return fallback;
  }
  double mean = 0.0;
  bool constant = true;
  for (size_t i = 1; i < p.numbers.size(); i += 2) {
    mean += p.numbers[i] * 2.0 / static_cast<double>(p.numbers.size());
    constant = constant && p.numbers[i] == p.numbers[1];
  }
  if (constant) return Spectrum(static_cast<float>(mean));
  return unsupported_spectrum(p, "a spectrum sampled at wavelengths", static_cast<float>(mean), diagnostics);
}

}  // namespace

Spectrum spectrum_value(const ParamReader& params, std::string_view name) {
  const ParamDecl& d = params.declaration(name);
  const Spectrum fallback = from_default(d.default_value);
  const Param* p = params.given(name);
  const Spectrum value = p ? from_param(*p, fallback, params.diagnostics()) : fallback;
  return d.clamp ? clamp(value, static_cast<float>(d.min), static_cast<float>(d.max)) : value;
}

SpectrumSource TextureBuilder::spectrum(const ParamReader& params, std::string_view name) const {
  const Param* p = params.given(name);
  if (p && p->kind == ParamKind::kTexture) return {{}, find(*p, inside_float_, params.diagnostics())};
  return {spectrum_value(params, name), -1};
}

FloatSource TextureBuilder::number(const ParamReader& params, std::string_view name) const {
  const Param* p = params.given(name);
  if (p && p->kind == ParamKind::kTexture) return {0.0f, find(*p, true, params.diagnostics())};
  return {static_cast<float>(params.number(name)), -1};
}

int32_t TextureBuilder::find(const Param& reference, bool is_float, Diagnostics& diagnostics) const {
  const std::string& name = reference.strings[0];
  if (const auto it = names_.find({name, is_float}); it != names_.end()) return it->second;
  std::vector<std::string_view> candidates;
  for (const auto& [key, index] : names_)
    if (key.second == is_float) candidates.push_back(key.first);
  const std::string_view near = nearest_name(name, candidates);
  std::string hint = near.empty() ? "" : fmt::format("did you mean \"{}\"?", near);
  if (names_.count({name, !is_float}))
    hint = fmt::format("\"{}\" is a {} texture", name, is_float ? "spectrum" : "float");
  diagnostics.error(reference.value_loc,
                    fmt::format("there is no {} texture \"{}\"", is_float ? "float" : "spectrum", name), hint);
  return -1;
}

int32_t TextureBuilder::image(const Param& filename, std::string_view encoding, Diagnostics& diagnostics) {
  const std::string path = (folder_ / filename.strings[0]).string();
  const auto key = std::make_pair(path, std::string(encoding));
  if (const auto it = images_.find(key); it != images_.end()) return it->second;
  const auto parsed = parse_image_encoding(encoding);
  if (!parsed) {
    diagnostics.error(filename.value_loc, fmt::format("unknown image encoding \"{}\"", encoding),
                      "valid: \"sRGB\", \"linear\", \"gamma 2.2\"");
    return -1;
  }
  ImageResult result = read_image(path, *parsed);
  int32_t index = -1;
  if (result.image) {
    index = static_cast<int32_t>(table_.images.size());
    table_.images.push_back(std::move(*result.image));
  } else {
    diagnostics.error(filename.value_loc,
                      fmt::format("cannot read image \"{}\": {}", filename.strings[0], result.error));
  }
  images_[key] = index;
  return index;
}

}  // namespace etd
