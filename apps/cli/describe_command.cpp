// `etendue describe`: the models and their parameters, from their declarations.
#include <fmt/format.h>

#include <cctype>
#include <memory>

#include "commands.h"
#include "formats/pbrt/manual.h"
#include "printing.h"
#include "render/registry.h"

namespace etd::cli {
namespace {

struct Arguments {
  std::string family, name;
  bool markdown = false;
};

// "Area-Light", "area light" and "arealight" are the same to a user.
std::string letters(std::string_view text) {
  std::string out;
  for (const char c : text)
    if (std::isalnum(static_cast<unsigned char>(c)))
      out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

int unknown(std::string_view what, std::string_view word, const std::vector<std::string_view>& valid) {
  tell("etendue: there is no {} \"{}\"\n", what, word);
  if (const std::string_view near = nearest_name(word, valid); !near.empty()) tell("  did you mean \"{}\"?\n", near);
  tell("  valid: {}\n", fmt::join(valid, ", "));
  return kBadInput;
}

void list(Family family, int indent) {
  size_t width = 0;
  for (const ModelDecl* model : all_models(family)) width = std::max(width, model->name.size());
  for (const ModelDecl* model : all_models(family))
    answer("{:{}}{:{}}  {}\n", "", indent, model->name, width, model->doc);
}

int describe_models(const Arguments& args) {
  if (args.markdown) {
    answer("{}", pbrt_coverage_markdown());
    return kOk;
  }
  constexpr std::string_view kLimits = "limits";
  if (letters(args.family) == kLimits && args.name.empty()) {
    answer("{}", describe_limits());
    return kOk;
  }
  if (args.family.empty()) {
    for (Family family : kAllFamilies) {
      answer("{}\n", family_name(family));
      list(family, 2);
      answer("\n");
    }
    answer(
        "`etendue describe FAMILY NAME` shows the parameters of one of them, `etendue describe limits` what a scene "
        "may "
        "ask for.\n");
    return kOk;
  }
  std::vector<std::string_view> names;
  for (Family family : kAllFamilies) {
    names.push_back(family_name(family));
    if (letters(family_name(family)) != letters(args.family)) continue;
    if (args.name.empty()) return list(family, 0), kOk;
    if (const ModelDecl* model = find_any_model(family, args.name)) {
      answer("{}", describe(*model));
      return kOk;
    }
    std::vector<std::string_view> models;
    for (const ModelDecl* model : all_models(family)) models.push_back(model->name);
    return unknown(family_name(family), args.name, models);
  }
  names.push_back(kLimits);
  return unknown("family of models", args.family, names);
}

}  // namespace

void add_describe(CLI::App& app, Run& run) {
  auto args = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("describe", "Show models and their parameters: types, defaults, ranges, units.");
  command->add_option("family", args->family, "material, light, shape, integrator, ...; or limits");
  command->add_option("name", args->name, "a model of this family");
  command->add_flag("--markdown", args->markdown, "write the page on the coverage of the pbrt-v4 language instead");
  command->footer(
      "Examples:\n"
      "  etendue describe                       every model in one line\n"
      "  etendue describe material              the materials\n"
      "  etendue describe material conductor    its parameters\n"
      "  etendue describe limits                what a scene may ask for, and --limit raises");
  command->callback([args, &run] { run = [args] { return describe_models(*args); }; });
}

}  // namespace etd::cli
