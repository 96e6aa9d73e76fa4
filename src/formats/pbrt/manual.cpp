#include "formats/pbrt/manual.h"

#include <fmt/format.h>

#include <algorithm>

#include "formats/pbrt/coverage.h"
#include "formats/pbrt/parser.h"
#include "params/describe.h"
#include "render/other_names.h"
#include "render/registry.h"

namespace etd {

namespace {

std::string code(std::string_view text) { return fmt::format("`{}`", text); }
std::string dash_if_empty(std::string text) { return text.empty() ? "-" : text; }

// A cell of a table: the bar would end it.
std::string cell(std::string_view text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

// The text with line breaks so that a line that begins with `column` letters stays within 120.
std::string wrapped(std::string_view text, size_t column = 0) {
  constexpr size_t kWidth = 119;
  std::string out;
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(word.size() + 1, text.size()));
    const bool breaks = column + 1 + word.size() > kWidth;
    if (!out.empty()) out += breaks ? '\n' : ' ';
    column = (breaks ? 0 : column + 1) + word.size();
    out += word;
  }
  return out;
}

// "`a`, `b`", wrapped.
std::string list_of_names(std::span<const std::string_view> names, size_t indent = 0) {
  std::string text;
  for (const std::string_view name : names) text += fmt::format("{}`{}`", text.empty() ? "" : ", ", name);
  return wrapped(text, indent);
}

std::string capitalised(std::string_view text) {
  std::string out(text);
  if (!out.empty() && out[0] >= 'a' && out[0] <= 'z') out[0] = static_cast<char>(out[0] - 'a' + 'A');
  return out;
}

std::string directives_chapter() {
  std::vector<std::string_view> names;
  for (const auto& list : {pbrt::option_directives(), pbrt::transform_directives(), pbrt::world_directives()})
    for (const pbrt::Directive& d : list) names.push_back(d.name);
  std::sort(names.begin(), names.end());
  return fmt::format("## Directives\n\nAll of them are read: {}.\n", list_of_names(names, 22));
}

std::string model_section(const ModelDecl& model) {
  std::string out =
      fmt::format("\n### {} `{}`\n\n{}\n", capitalised(family_name(model.family)), model.name, wrapped(model.doc));
  if (model.params.empty()) return out + "\nIt takes no parameters.\n";
  out += "\n| parameter | type | default | valid | unit | meaning |\n|---|---|---|---|---|---|\n";
  for (const ParamDecl& p : model.params)
    out += fmt::format("| `{}` | {}{} | {} | {} | {} | {} |\n", p.name, type_name(p.type),
                       p.array ? ", any number" : "", cell(default_text(p)), cell(dash_if_empty(range_text(p))),
                       cell(dash_if_empty(p.unit)), cell(p.doc));
  return out;
}

std::string unsupported_models_table() {
  std::string out = "\n| | model | rendered instead |\n|---|---|---|\n";
  for (const pbrt::UnsupportedModel& m : pbrt::unsupported_models())
    if (!find_any_model(m.family, m.name))
      out += fmt::format("| {} | `{}` | {} |\n", family_name(m.family), m.name, m.substitute);
  return out;
}

// Whether every model that a rule speaks of has learnt the parameter.
bool is_declared(const pbrt::UnsupportedParam& rule) {
  const std::span<const ModelDecl* const> list = all_models(rule.family);
  return std::all_of(list.begin(), list.end(), [&](const ModelDecl* model) {
    return (!rule.model.empty() && rule.model != model->name) || model->find(rule.name);
  });
}

std::string unsupported_params_table() {
  std::string out = "\n| of | parameter | changes nothing when | rendered instead |\n|---|---|---|---|\n";
  for (const pbrt::UnsupportedParam& p : pbrt::unsupported_params()) {
    if (is_declared(p)) continue;
    const std::string of = p.model.empty() ? fmt::format("every {}", family_name(p.family))
                                           : fmt::format("{} `{}`", family_name(p.family), p.model);
    const bool never_matters = p.harmless == "*";
    const std::string harmless = never_matters ? "always" : p.harmless.empty() ? "-" : code(p.harmless);
    out += fmt::format("| {} | `{}` | {}{} | {} |\n", of, p.name, harmless,
                       never_matters ? fmt::format(": {}", p.substitute) : "", never_matters ? "-" : p.substitute);
  }
  return out + "| integrator `path` | `regularize` | `false` | surfaces as sharp as they are |\n";
}

std::string options_table() {
  std::string out = "\n| option | what it does here |\n|---|---|\n";
  for (const pbrt::OptionRule& rule : pbrt::known_options()) {
    using Effect = pbrt::OptionRule::Effect;
    const std::string_view prefix = rule.effect == Effect::kSeed                 ? "sets "
                                    : rule.effect == Effect::kNoTextureFiltering ? ""
                                    : rule.effect == Effect::kNone               ? "nothing: "
                                    : rule.effect == Effect::kNote               ? "prints one line: "
                                                                   : "unsupported when true; rendered instead: ";
    out += fmt::format("| `{}` | {}{} |\n", rule.name, prefix, rule.text);
  }
  return out;
}

}  // namespace

std::string pbrt_coverage_markdown() {
  std::string out =
      "# The pbrt-v4 scene language\n\n"
      "This page is generated from the declarations of the models and the reader's table of what is missing; a test "
      "fails\n"
      "when it is out of date, and rewrites it when `ETENDUE_UPDATE_EXPECTED` is set.\n\n"
      "The whole grammar is read. Types must match exactly (`float` is not `integer`); a spectrum is written as "
      "`rgb`,\n"
      "`spectrum`, `blackbody` or one `float`; every number must be finite. Names of materials, objects and media may "
      "be\n"
      "used before they are defined, and an object may contain instances of objects that end before it begins. "
      "Relative\n"
      "file names start in the folder of the main file; those of `Include` and `Import` also in that of the file that\n"
      "names them.\n\n"
      "Lights between `ObjectBegin` and `ObjectEnd` belong to the object, as its shapes do: none shines without an "
      "instance,\n"
      "and one for each instance, wherever that puts it. A `portal` is in the space of the object then.\n\n";
  out += directives_chapter() + "\n## Models\n";
  for (const Family family : kAllFamilies)
    for (const ModelDecl* model : all_models(family)) out += model_section(*model);
  std::vector<std::string_view> as_path;
  for (const std::string_view name : other_names(Family::kIntegrator))
    if (our_name(Family::kIntegrator, name) == "path") as_path.push_back(name);
  out += fmt::format(
      "\n## Other names\n\n"
      "Rendered with the sampler `sobol`, keeping the number of samples and the seed, with one printed line\n"
      "(`paddedsobol` is the same and prints none): {}.\n\n"
      "Rendered with the integrator `path`, keeping what it has of their parameters, with one printed line:\n{}.\n"
      "`lightpath` is the integrator `light`.\n\n"
      "`randomization` of a sampler and `Accelerator` are not used and print one line; so do the light samplers `bvh`\n"
      "and `exhaustive`, for which `power` is taken.\n",
      list_of_names(other_names(Family::kSampler), 45), list_of_names(as_path));
  out += "\n## Options\n" + options_table();
  out +=
      "\n## Not supported yet\n\nEach use is an error with its place. With `--allow-unsupported` it becomes a warning, "
      "and\n"
      "what is named here is rendered instead.\n" +
      unsupported_models_table() + unsupported_params_table();
  out += "\nBesides: media (`MakeNamedMedium`, `MediumInterface` with a name; empty space).\n";
  return out;
}

}  // namespace etd
