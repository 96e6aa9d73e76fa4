#include "render/overrides.h"

#include <fmt/format.h>

#include <charconv>
#include <optional>

#include "render/registry.h"

namespace etd {
namespace {

template <class T>
std::optional<T> parse(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

// One value of the declared type into `param`; false when the text is none.
bool append_value(ParamType type, std::string_view text, Param& param) {
  switch (type) {
    case ParamType::kBool:
      param.kind = ParamKind::kBool;
      if (text != "true" && text != "false") return false;
      param.integers.push_back(text == "true");
      return true;
    case ParamType::kInteger:
      param.kind = ParamKind::kInteger;
      if (const auto v = parse<int32_t>(text)) return param.integers.push_back(*v), true;
      return false;
    case ParamType::kFloat:
      param.kind = ParamKind::kFloat;
      if (const auto v = parse<double>(text)) return param.numbers.push_back(*v), true;
      return false;
    case ParamType::kString:
      param.kind = ParamKind::kString;
      param.strings.emplace_back(text);
      return true;
    default:
      return false;  // film, sampler and integrator models declare nothing else
  }
}

std::optional<Param> parse_param(const ParamDecl& decl, std::string_view text, SourceLoc loc,
                                 Diagnostics& diagnostics) {
  Param param;
  param.name = decl.name;
  param.loc = param.value_loc = loc;
  for (std::string_view rest = text;;) {
    const size_t comma = decl.array ? rest.find(',') : std::string_view::npos;
    const std::string_view value = rest.substr(0, comma);
    if (!append_value(decl.type, value, param)) {
      diagnostics.error(loc, fmt::format("\"{}\" is not a value of type {}", value, type_name(decl.type)),
                        fmt::format("{}: {}", decl.name, decl.doc));
      return {};
    }
    if (comma == std::string_view::npos) return param;
    rest = rest.substr(comma + 1);
  }
}

// The integrators that declare the parameter, separated by commas.
std::string integrators_with(std::string_view param) {
  std::string names;
  for (const ModelDecl* model : all_models(Family::kIntegrator))
    if (model->find(param)) names += (names.empty() ? "" : ", ") + model->name;
  return names;
}

std::vector<std::string_view> names_of(const ModelDecl& model) {
  std::vector<std::string_view> names;
  for (const ParamDecl& p : model.params) names.push_back(p.name);
  return names;
}

void apply_one(const std::string& key, const std::string& text, const OverridableModels& models,
               Diagnostics& diagnostics) {
  const std::string shown = fmt::format("{}={}", key, text);
  SourceLoc loc{diagnostics.sources().add("command line", shown), 1, 1, static_cast<int32_t>(key.size())};
  const size_t dot = key.find('.');
  const std::string family_text = key.substr(0, dot);
  const bool is_film = family_text == "film", is_sampler = family_text == "sampler";
  const bool is_integrator = family_text == "integrator";
  if (dot == std::string::npos || !(is_film || is_sampler || is_integrator))
    return diagnostics.error(loc, fmt::format("\"{}\" names no setting", key),
                             "settings are film.NAME, sampler.NAME and integrator.NAME, as in integrator.maxdepth=8; "
                             "`etendue describe integrator` lists them");

  const Family family = is_film ? Family::kFilm : is_sampler ? Family::kSampler : Family::kIntegrator;
  ModelUse& use = is_film ? models.film : is_sampler ? models.sampler : models.integrator;
  const ModelDecl* model = find_any_model(family, use.model);
  if (!model) return;  // reported where the model is named
  Param unknown;
  unknown.name = key.substr(dot + 1);
  unknown.loc = loc;
  const ParamDecl* declared = model->find(unknown.name);
  if (!declared) {
    const std::string others = is_integrator ? integrators_with(unknown.name) : std::string();
    if (others.empty()) return check_params(*model, ModelUse{use.model, {unknown}, use.loc}, diagnostics);
    return diagnostics.error(
        loc, fmt::format("integrator \"{}\" has no parameter \"{}\"", use.model, unknown.name),
        fmt::format("those that have it: {}; \"{}\" has {}", others, use.model, fmt::join(names_of(*model), ", ")));
  }

  loc.column = static_cast<int32_t>(key.size()) + 2;
  loc.length = std::max(1, static_cast<int32_t>(text.size()));
  if (std::optional<Param> param = parse_param(*declared, text, loc, diagnostics)) {
    std::erase_if(use.params, [&](const Param& p) { return p.name == param->name; });
    use.params.push_back(std::move(*param));
  }
}

}  // namespace

void apply_overrides(const std::vector<std::pair<std::string, std::string>>& set, const OverridableModels& models,
                     Diagnostics& diagnostics) {
  for (const auto& [key, text] : set) apply_one(key, text, models, diagnostics);
}

std::vector<std::string> sample_options(const RenderOverrides& o) {
  std::vector<std::string> options;
  const auto add = [&options](const char* name, const std::string& value) {
    options.emplace_back(name);
    options.push_back(value);
  };
  if (o.size) add("--size", fmt::format("{}x{}", o.size->first, o.size->second));
  if (o.spp) add("--spp", std::to_string(*o.spp));
  if (o.replicates) add("--replicates", std::to_string(*o.replicates));
  if (o.seed) add("--seed", std::to_string(*o.seed));
  if (o.sampler) add("--sampler", *o.sampler);
  if (o.integrator) add("--integrator", *o.integrator);
  for (const auto& [key, text] : o.set) add("--set", fmt::format("{}={}", key, text));
  return options;
}

}  // namespace etd
