#include "formats/pbrt/coverage.h"

#include <fmt/format.h>

#include <algorithm>

#include "formats/pbrt/old_names.h"
#include "formats/pbrt/tokenizer.h"
#include "render/other_names.h"
#include "render/registry.h"

namespace etd::pbrt {

namespace {

const UnsupportedModel* find_unsupported(Family family, std::string_view name) {
  for (const UnsupportedModel& m : unsupported_models())
    if (m.family == family && m.name == name) return &m;
  return nullptr;
}

const UnsupportedParam* find_unsupported(Family family, std::string_view model, std::string_view param) {
  for (const UnsupportedParam& p : unsupported_params())
    if (p.family == family && p.name == param && (p.model.empty() || p.model == model)) return &p;
  return nullptr;
}

std::vector<std::string_view> known_names(Family family) {
  std::vector<std::string_view> names;
  for (const ModelDecl* m : all_models(family)) names.push_back(m->name);
  names.insert(names.end(), other_names(family).begin(), other_names(family).end());
  for (const UnsupportedModel& m : unsupported_models())
    if (m.family == family && !find_any_model(family, m.name)) names.push_back(m.name);
  return names;
}

// A model of the family that can stand in for one that nobody knows; empty: nothing can.
std::string_view neutral_model(Family family) {
  switch (family) {
    case Family::kMaterial:
      return "diffuse";
    case Family::kTexture:
      return "constant";
    case Family::kCamera:
      return "perspective";
    case Family::kFilter:
      return "gaussian";
    case Family::kFilm:
      return "rgb";
    case Family::kSampler:
      return "sobol";
    case Family::kIntegrator:
      return "path";
    default:
      return {};
  }
}

std::optional<ModelUse> report_unknown(Family family, const ModelUse& use, Diagnostics& diagnostics) {
  const std::vector<std::string_view> names = known_names(family);
  std::string hint = old_model_hint(family, use, diagnostics);
  if (const std::string_view near = nearest_name(use.model, names); hint.empty() && !near.empty())
    hint = fmt::format("did you mean \"{}\"? ", near);
  diagnostics.error(use.loc, fmt::format("unknown {} \"{}\"", family_name(family), use.model),
                    hint + fmt::format("valid: {}", fmt::join(names, ", ")));
  const std::string_view neutral = neutral_model(family);
  if (neutral.empty()) return {};
  return ModelUse{std::string(neutral), {}, use.loc};
}

// Whether the values of the parameter are exactly the one number, word or string.
bool has_value(const Param& param, std::string_view text) {
  if (param.strings.size() == 1 && param.kind == ParamKind::kString) return param.strings[0] == text;
  const std::optional<double> number = parse_number(text);
  if (!number || param.numbers.size() + param.integers.size() == 0 || !param.strings.empty()) return false;
  return std::all_of(param.numbers.begin(), param.numbers.end(), [&](double x) { return x == *number; }) &&
         std::all_of(param.integers.begin(), param.integers.end(), [&](int32_t x) { return x == *number; });
}

ModelUse substitute(const UnsupportedModel& model, ModelUse use) {
  ModelUse stand_in{std::string(model.stand_in), {}, use.loc};
  for (Param& p : use.params)
    for (const auto& [from, to] : model.kept)
      if (p.name == from) {
        p.name = to;
        stand_in.params.push_back(std::move(p));
        break;
      }
  if (const auto& [name, value] = model.fixed; !name.empty() && !stand_in.find(name)) {
    Param fixed;
    fixed.name = name;
    fixed.kind = ParamKind::kFloat;
    fixed.numbers = {value};
    fixed.loc = fixed.value_loc = use.loc;
    stand_in.params.push_back(std::move(fixed));
  }
  return stand_in;
}

void drop_unsupported_params(Family family, ModelUse& use, Diagnostics& diagnostics) {
  const ModelDecl* decl = find_any_model(family, use.model);
  const auto dropped = [&](const Param& param) {
    if (decl && decl->find(param.name)) return false;
    const UnsupportedParam* rule = find_unsupported(family, use.model, param.name);
    if (!rule) return false;
    if (rule->harmless != "*" && (rule->harmless.empty() || !has_value(param, rule->harmless)))
      diagnostics.unsupported(param.loc,
                              fmt::format("parameter \"{}\" of {} \"{}\"", param.name, family_name(family), use.model),
                              std::string(rule->substitute));
    else if (rule->name == "savefp16")
      diagnostics.note(param.loc, "images are written with 32-bit floats, whatever savefp16 says");
    return true;
  };
  use.params.erase(std::remove_if(use.params.begin(), use.params.end(), dropped), use.params.end());
}

}  // namespace

std::optional<ModelUse> make_supported(Family family, ModelUse use, Diagnostics& diagnostics) {
  if (!find_any_model(family, use.model)) {
    const UnsupportedModel* model = find_unsupported(family, use.model);
    if (model) {
      diagnostics.unsupported(use.loc, fmt::format("{} \"{}\"", family_name(family), use.model),
                              std::string(model->substitute));
      if (model->stand_in.empty()) return {};
      use = substitute(*model, std::move(use));
    } else {
      return report_unknown(family, use, diagnostics);
    }
  }
  drop_unsupported_params(family, use, diagnostics);
  drop_old_params(family, use, diagnostics);
  return use;
}

std::vector<std::string_view> params_of(Family family, std::string_view model) {
  std::vector<std::string_view> names;
  const auto add = [&](std::string_view name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  if (const ModelDecl* decl = find_any_model(family, model))
    for (const ParamDecl& p : decl->params) add(p.name);
  if (const UnsupportedModel* m = find_unsupported(family, model))
    for (const auto& [from, to] : m->kept) add(from);
  for (const UnsupportedParam& p : unsupported_params())
    if (p.family == family && (p.model.empty() || p.model == model)) add(p.name);
  return names;
}

}  // namespace etd::pbrt
