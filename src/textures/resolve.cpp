#include "textures/resolve.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "spectrum/named.h"

namespace etd {

namespace {

Spectrum from_numbers(const std::vector<double>& v) {
  if (v.size() == 1) return Spectrum(static_cast<float>(v[0]));
  return Spectrum::rgb(static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]));
}

// What a spectrum stands for, which decides what becomes of it in three lanes (spectrum/colorimetry.h).
enum class Role : uint8_t { kReflectance, kEmission };

Spectrum to_rgb(const SpectralFunction& f, Role role) {
  return role == Role::kEmission ? emission_rgb(f) : reflectance_rgb(f);
}

Spectrum from_default(const ParamDefault& d, Role role) {
  if (const auto* number = std::get_if<double>(&d)) return Spectrum(static_cast<float>(*number));
  if (const auto* numbers = std::get_if<std::vector<double>>(&d)) return from_numbers(*numbers);
  if (const auto* name = std::get_if<std::string>(&d))
    if (const auto named = named_spectrum(*name)) return to_rgb(*named, role);
  return Spectrum(0.0f);
}

// Pairs of a wavelength and a value. A reflectance that is the same at all of them is the same at all others, too.
Spectrum from_samples(const std::vector<double>& pairs, Role role) {
  std::vector<double> nm, values;
  for (size_t i = 0; i + 1 < pairs.size(); i += 2) nm.push_back(pairs[i]), values.push_back(pairs[i + 1]);
  const bool flat = std::adjacent_find(values.begin(), values.end(), std::not_equal_to<>()) == values.end();
  if (flat && role == Role::kReflectance) return Spectrum(static_cast<float>(values[0]));
  return to_rgb([&](double at) { return interpolate(nm, values, at, flat); }, role);
}

Spectrum from_param(const Param& p, Role role, const Spectrum& fallback, Diagnostics& diagnostics) {
  switch (p.kind) {
    case ParamKind::kFloat:
    case ParamKind::kRgb:
      return from_numbers(p.numbers);
    case ParamKind::kBlackbody:
      return to_rgb([&](double nm) { return blackbody(p.numbers[0], nm); }, role);
    case ParamKind::kSpectrum:
      break;
    default:
      return fallback;
  }
  if (p.strings.empty()) return from_samples(p.numbers, role);
  if (const auto named = named_spectrum(p.strings[0])) return to_rgb(*named, role);
  const std::string all = named_spectra();
  diagnostics.error(p.value_loc, fmt::format("there is no spectrum \"{}\"", p.strings[0]),
                    fmt::format("valid: a file of wavelengths and values, or one of {}", all));
  return fallback;
}

Spectrum value_of(const ParamReader& params, std::string_view name, Role role) {
  const ParamDecl& d = params.declaration(name);
  const Spectrum fallback = from_default(d.default_value, role);
  const Param* p = params.given(name);
  const Spectrum value = p ? from_param(*p, role, fallback, params.diagnostics()) : fallback;
  return d.clamp ? clamp(value, static_cast<float>(d.min), static_cast<float>(d.max)) : value;
}

}  // namespace

Spectrum spectrum_value(const ParamReader& params, std::string_view name) {
  return value_of(params, name, Role::kReflectance);
}

Spectrum emission_value(const ParamReader& params, std::string_view name) {
  return value_of(params, name, Role::kEmission);
}

SpectrumSource TextureBuilder::spectrum(const ParamReader& params, std::string_view name) const {
  const Param* p = params.given(name);
  if (p && p->kind == ParamKind::kTexture) return {{}, find(*p, is_float_, params.diagnostics())};
  return {spectrum_value(params, name), -1};
}

FloatSource TextureBuilder::number(const ParamReader& params, std::string_view name) const {
  const Param* p = params.given(name);
  if (p && p->kind == ParamKind::kTexture) return {0.0f, find(*p, true, params.diagnostics())};
  return {static_cast<float>(params.number(name)), -1};
}

int32_t TextureBuilder::space(const ParamReader& params) {
  if (to_world_.is_singular())
    params.diagnostics().error(params.use().loc,
                               fmt::format("the transform of this {} texture is singular", params.use().model));
  if (spaces_.empty() || !(spaces_.back() == to_world_)) {
    spaces_.push_back(to_world_);
    table_.spaces.emplace_back(to_world_.inverse_matrix());
  }
  return static_cast<int32_t>(spaces_.size()) - 1;
}

void TextureBuilder::recentre(Vec3d origin) {
  for (size_t i = 0; i < spaces_.size(); ++i)
    table_.spaces[i] = Affine((spaces_[i].inverse() * Transform::translate(origin)).matrix());
}

int32_t TextureBuilder::find(const Param& reference, bool is_float, Diagnostics& diagnostics) const {
  const std::string& name = reference.strings[0];
  if (const auto it = names_.find({name, is_float}); it != names_.end()) return it->second;
  const std::string_view kind = is_float ? "float" : "spectrum", other = is_float ? "spectrum" : "float";
  diagnostics.error(reference.value_loc, fmt::format("there is no {} texture \"{}\"", kind, name), [&] {
    if (names_.count({name, !is_float})) return fmt::format("\"{}\" is a {} texture", name, other);
    std::vector<std::string_view> candidates;
    for (const auto& [key, index] : names_)
      if (key.second == is_float) candidates.push_back(key.first);
    const std::string_view near = nearest_name(name, candidates);
    return near.empty() ? std::string() : fmt::format("did you mean \"{}\"?", near);
  });
  return -1;
}

}  // namespace etd
