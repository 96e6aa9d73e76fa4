#include "verify/battery/parameter_grid.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/hash.h"

namespace etd {

namespace {

Param number_param(const ParamDecl& d, ParamKind kind, std::vector<double> values) {
  Param p;
  p.name = d.name;
  p.kind = kind;
  p.numbers = std::move(values);
  return p;
}

bool is_roughness(std::string_view name) { return name.find("roughness") != std::string_view::npos; }

// Ends and middle of a range; of an open one the default, and values below and above it.
std::vector<double> numbers_of(const ParamDecl& d) {
  // No lobes too sharp for histograms; those are in the lists of examples.
  if (is_roughness(d.name)) return {0.2, 0.0, 0.6};
  // What a range alone does not say: the shutter opens before it closes, and cubic filters are of Mitchell's square.
  if (d.name == "shutteropen" || d.name == "shutterclose") return {std::get<double>(d.default_value)};
  if (d.name == "B" || d.name == "C") return {1.0 / 3.0, 0.0, 1.0};
  const double* given = std::get_if<double>(&d.default_value);
  const double middle = given ? *given : std::clamp(1.0, d.min, d.max);
  const bool bounded = std::isfinite(d.min) && std::isfinite(d.max);
  // At the ends of a symmetric range models often degenerate to a delta.
  if (bounded && d.max == -d.min) return {0.8 * d.min, middle, 0.8 * d.max};
  if (bounded && d.max - d.min <= 1000.0) {
    const double span = d.max - d.min;
    return {d.min + (d.above_min ? 0.05 * span : 0.0), middle, 0.5 * (d.min + d.max), d.max};
  }
  if (middle > 1000.0) return {middle, 3.0};  // a default that stands for infinity
  const double step = middle != 0.0 ? 0.5 * std::abs(middle) : 0.5;
  std::vector<double> values{middle};
  for (const double v : {middle - step, middle + 2.0 * step})
    if (v > d.min && v < d.max) values.push_back(v);
  return values;
}

// Values to try, none when the parameter's meaning is not known.
std::vector<Param> candidates(const ParamDecl& d, const std::string& image) {
  std::vector<Param> list;
  switch (d.type) {
    case ParamType::kBool:
      for (const int value : {0, 1}) {
        Param p = number_param(d, ParamKind::kBool, {});
        p.integers = {value};
        list.push_back(p);
      }
      break;
    case ParamType::kInteger:
      for (const double value : {0.0, 3.0, 5.0}) {
        Param p = number_param(d, ParamKind::kInteger, {});
        p.integers = {static_cast<int32_t>(std::clamp(value, d.min, d.max))};
        list.push_back(p);
      }
      break;
    case ParamType::kFloat:
    case ParamType::kFloatTexture:
      if (d.array) break;
      for (const double v : numbers_of(d)) list.push_back(number_param(d, ParamKind::kFloat, {v}));
      break;
    case ParamType::kSpectrum:
    case ParamType::kSpectrumTexture:
      if (d.array) break;
      if (d.max == 1.0) {
        for (const auto& v : {std::vector<double>{1, 1, 1}, {0.8, 0.4, 0.1}, {0, 0, 0}})
          list.push_back(number_param(d, ParamKind::kRgb, v));
      } else {
        for (const double v : {1.3, 2.0}) list.push_back(number_param(d, ParamKind::kFloat, {v}));
      }
      break;
    case ParamType::kString: {
      std::vector<std::string> values = d.choices;
      if (values.empty() && d.name == "filename" && !image.empty()) values = {image};
      for (const std::string& v : values) {
        Param p = number_param(d, ParamKind::kString, {});
        p.strings = {v};
        list.push_back(p);
      }
      break;
    }
    default:
      break;
  }
  return list;
}

}  // namespace

std::vector<ModelUse> parameter_grid(const ModelDecl& decl, const std::string& image) {
  ModelUse base{decl.name, {}, {}};
  // Parameters with a default change together, and so do those without, which often stand for one another.
  std::vector<std::vector<Param>> with_default, without;
  for (const ParamDecl& d : decl.params) {
    std::vector<Param> values = candidates(d, image);
    if (values.empty()) continue;
    const bool open = std::holds_alternative<std::monostate>(d.default_value);
    if (d.required)
      base.params.push_back(values[0]);
    else
      (open ? without : with_default).push_back(std::move(values));
  }
  std::vector<ModelUse> grid{base};
  for (const auto* group : {&with_default, &without}) {
    size_t settings = 0;
    for (const auto& values : *group) settings = std::max(settings, values.size());
    for (size_t i = 0; i < settings; ++i) {
      ModelUse use = base;
      for (size_t k = 0; k < group->size(); ++k) {
        const std::vector<Param>& values = (*group)[k];
        // A rough direction and a smooth one make a lobe too sharp for histograms.
        const size_t usable = group == &without && is_roughness(values[0].name) ? 1 : values.size();
        use.params.push_back(values[(i + hash_combine(7, k)) % usable]);
      }
      grid.push_back(std::move(use));
    }
  }
  return grid;
}

std::string setting_name(const ModelUse& use) {
  std::string text;
  for (const Param& p : use.params) {
    text += (text.empty() ? "" : ", ") + p.name + " ";
    if (!p.numbers.empty()) text += fmt::format("{:g}", fmt::join(p.numbers, " "));
    if (p.kind == ParamKind::kBool)
      text += p.integers[0] ? "true" : "false";
    else if (!p.integers.empty())
      text += fmt::format("{}", fmt::join(p.integers, " "));
    if (!p.strings.empty()) text += p.strings[0].substr(p.strings[0].find_last_of('/') + 1);
  }
  return text.empty() ? use.model : use.model + "(" + text + ")";
}

}  // namespace etd
