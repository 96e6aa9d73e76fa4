// Directives before WorldBegin: camera, film, filter, sampler, integrator and global options.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "formats/pbrt/coverage.h"
#include "formats/pbrt/old_names.h"
#include "formats/pbrt/parser.h"
#include "render/registry.h"

namespace etd::pbrt {

namespace {

// A second directive of a kind replaces the first, which is rarely meant.
void replace(Parser& p, ModelUse& slot, ModelUse use, const Token& d) {
  if (slot.loc.file >= 0)
    p.diagnostics.warning(d.loc, fmt::format("this {} replaces the one at {}:{}", d.text,
                                             p.diagnostics.sources().name(slot.loc.file), slot.loc.line));
  slot = std::move(use);
}

void read_model(Parser& p, const Token& d, Family family, ModelUse& slot) {
  std::optional<ModelUse> use = p.model_arguments(d, fmt::format("the name of a {}", family_name(family)));
  if (!use) return;
  if (auto supported = make_supported(family, std::move(*use), p.diagnostics))
    replace(p, slot, std::move(*supported), d);
}

void camera(Parser& p, const Token& d) {
  read_model(p, d, Family::kCamera, p.scene.camera);
  p.coordinate_systems["camera"] = p.state.ctm.inverse();
  if (const auto world_to_camera = p.placement(d.loc, "camera")) p.scene.camera_to_world = world_to_camera->inverse();
}

void film(Parser& p, const Token& d) { read_model(p, d, Family::kFilm, p.scene.film); }
void pixel_filter(Parser& p, const Token& d) { read_model(p, d, Family::kFilter, p.scene.filter); }

bool is_one_of(std::string_view name, std::initializer_list<std::string_view> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Takes the parameters that are not named out of the list and returns their names, for a note.
std::string drop_all_but(std::initializer_list<std::string_view> kept, std::vector<Param>& params) {
  std::string dropped;
  const auto drop = [&](const Param& param) {
    if (is_one_of(param.name, kept)) return false;
    dropped += (dropped.empty() ? "" : ", ") + param.name;
    return true;
  };
  params.erase(std::remove_if(params.begin(), params.end(), drop), params.end());
  return dropped;
}

// Turns a use of another sampler or integrator into one of `ours` that keeps the named parameters, with a note unless
// it is only another name.
void map_to_ours(Parser& p, ModelUse& use, std::string_view ours, std::initializer_list<std::string_view> kept,
                 bool same, std::string_view what) {
  const std::string dropped = drop_all_but(kept, use.params);
  if (!same || !dropped.empty())
    p.diagnostics.note(use.loc, fmt::format("{} \"{}\" is rendered with \"{}\"{}{}", what, use.model, ours,
                                            dropped.empty() ? "" : ", without its ", dropped));
  use.model = ours;
}

// Reports a name that neither Etendue nor the language has, and puts ours in its place.
void replace_unknown(Parser& p, ModelUse& use, Family family, std::string_view ours,
                     std::span<const std::string_view> mapped) {
  std::vector<std::string_view> names;
  for (const ModelDecl* model : all_models(family)) names.push_back(model->name);
  names.insert(names.end(), mapped.begin(), mapped.end());
  std::string hint = old_model_hint(family, use, p.diagnostics);
  if (const std::string_view near = nearest_name(use.model, names); hint.empty() && !near.empty())
    hint = fmt::format("did you mean \"{}\"? ", near);
  p.diagnostics.error(use.loc, fmt::format("unknown {} \"{}\"", family_name(family), use.model),
                      hint + fmt::format("valid: {}", fmt::join(names, ", ")));
  use.model = ours;
  use.params.clear();
}

bool contains(std::span<const std::string_view> names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// A stratified sampler says how many samples it takes as a product.
void multiply_strata(ModelUse& use) {
  int64_t count = 1;
  Param samples;
  samples.name = "pixelsamples";
  samples.kind = ParamKind::kInteger;
  samples.loc = samples.value_loc = use.loc;
  for (const std::string_view name : {"xsamples", "ysamples"}) {
    const Param* strata = use.find(name);
    count *= strata && strata->integers.size() == 1 ? strata->integers[0] : 4;
    if (strata) samples.loc = strata->loc, samples.value_loc = strata->value_loc;
  }
  constexpr int64_t kMost = std::numeric_limits<int32_t>::max();
  samples.integers = {static_cast<int32_t>(std::clamp(count, -kMost, kMost))};
  drop_all_but({"xsamples", "ysamples", "jitter", "seed"}, use.params);
  use.params.push_back(std::move(samples));
}

void sampler(Parser& p, const Token& d) {
  std::optional<ModelUse> use = p.model_arguments(d, "the name of a sampler");
  if (!use) return;
  if (!find_any_model(Family::kSampler, use->model)) {
    if (!contains(mapped_samplers(), use->model)) {
      replace_unknown(p, *use, Family::kSampler, "sobol", mapped_samplers());
    } else {
      if (use->model == "stratified") multiply_strata(*use);
      map_to_ours(p, *use, "sobol", {"pixelsamples", "seed", "randomization"}, use->model == "paddedsobol", "sampler");
    }
  }
  const auto foreign = [&](const Param& param) {
    const ModelDecl* decl = find_any_model(Family::kSampler, use->model);
    if (param.name != "randomization" || (decl && decl->find(param.name))) return false;
    p.diagnostics.note(param.loc, "samples are scrambled by Owen's method, whatever \"randomization\" says");
    return true;
  };
  use->params.erase(std::remove_if(use->params.begin(), use->params.end(), foreign), use->params.end());
  replace(p, p.scene.sampler, std::move(*use), d);
}

// What the path integrator of pbrt has beside its depth.
void read_path_params(Parser& p, ModelUse& use) {
  const ModelDecl* decl = find_any_model(Family::kIntegrator, "path");
  const auto foreign = [&](const Param& param) {
    if (decl && decl->find(param.name)) return false;
    if (param.name == "lightsampler") {
      p.diagnostics.note(param.loc, "lights are chosen by their power, whatever \"lightsampler\" says");
      return true;
    }
    if (param.name != "regularize") return false;
    if (param.integers.size() != 1 || param.integers[0])
      p.diagnostics.unsupported(param.loc, "parameter \"regularize\" of integrator \"path\"",
                                "surfaces as sharp as they are");
    return true;
  };
  use.params.erase(std::remove_if(use.params.begin(), use.params.end(), foreign), use.params.end());
}

void integrator(Parser& p, const Token& d) {
  std::optional<ModelUse> use = p.model_arguments(d, "the name of an integrator");
  if (!use) return;
  const bool own = find_any_model(Family::kIntegrator, use->model) != nullptr;
  const bool mapped = contains(mapped_integrators(), use->model);
  if (!own && !mapped) replace_unknown(p, *use, Family::kIntegrator, "path", mapped_integrators());
  if (own ? use->model == "path" : mapped) read_path_params(p, *use);
  if (!own && mapped) map_to_ours(p, *use, "path", {"maxdepth"}, false, "integrator");
  drop_old_params(Family::kIntegrator, *use, p.diagnostics);
  replace(p, p.scene.integrator, std::move(*use), d);
}

void accelerator(Parser& p, const Token& d) {
  if (const auto use = p.model_arguments(d, "the name of an accelerator"))
    p.diagnostics.note(d.loc, "Accelerator is not used: rays are always traced by Embree");
}

void color_space(Parser& p, const Token& d) {
  const auto name = p.string_argument(d, "the name of a color space");
  if (!name) return;
  if (const auto space = find_color_space(name->value()))
    p.state.color_space = *space;
  else
    p.diagnostics.error(name->loc, fmt::format("unknown color space \"{}\"", name->text),
                        "valid: srgb, aces2065-1, dci-p3, rec2020");
}

// pbrt reads "mse-reference-image", "mseReferenceImage" and the same with a type before it as one.
std::string normalised_option(std::string name) {
  if (const size_t space = name.find_last_of(" \t"); space != std::string::npos) name.erase(0, space + 1);
  std::string out;
  for (const char c : name)
    if (c != '-' && c != '_') out += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return out;
}

void option(Parser& p, const Token& d) {
  const auto name = p.string_argument(d, "the name of an option");
  if (!name) return;
  std::optional<Token> value = p.tokens.peek();
  const bool bracketed = value && value->kind == Token::Kind::kOpen;
  if (bracketed) {
    p.tokens.next();
    value = p.tokens.peek();
  }
  if (!value || value->kind == Token::Kind::kClose || find_directive(value->text)) {
    p.diagnostics.error(name->loc, fmt::format("option \"{}\" has no value", name->text));
    return p.resynchronise();
  }
  p.tokens.next();
  if (bracketed) {
    const std::optional<Token> close = p.tokens.peek();
    if (close && close->kind == Token::Kind::kClose) p.tokens.next();
  }
  const std::string key = normalised_option(name->value());
  const auto rule =
      std::find_if(known_options().begin(), known_options().end(), [&](const OptionRule& r) { return r.name == key; });
  if (rule == known_options().end()) {
    std::vector<std::string_view> names;
    for (const OptionRule& r : known_options()) names.push_back(r.name);
    const std::string_view near = nearest_name(key, names);
    p.diagnostics.error(
        name->loc, fmt::format("unknown option \"{}\"", name->text),
        near.empty() ? fmt::format("valid: {}", fmt::join(names, ", ")) : fmt::format("did you mean \"{}\"?", near));
    return;
  }
  const auto is_true = [&] {
    if (value->text != "true" && value->text != "false")
      p.diagnostics.error(value->loc, fmt::format("option \"{}\" is true or false", name->text));
    return value->text == "true";
  };
  switch (rule->effect) {
    case OptionRule::Effect::kNone:
      return;
    case OptionRule::Effect::kNote:
      return p.diagnostics.note(name->loc, std::string(rule->text));
    case OptionRule::Effect::kSeed:
      p.seed = parse_integer(value->text);
      if (!p.seed) p.diagnostics.error(value->loc, fmt::format("the seed is an integer, not {}", value->text));
      return;
    case OptionRule::Effect::kNoTextureFiltering:
      p.scene.filter_textures = !is_true();
      return;
    case OptionRule::Effect::kUnsupportedIfTrue:
      if (is_true())
        p.diagnostics.unsupported(name->loc, fmt::format("option \"{}\"", name->text), std::string(rule->text));
      return;
  }
}

void world_begin(Parser& p, const Token&) {
  p.state.ctm = {};
  p.state.start_active = p.state.end_active = true;
  p.coordinate_systems["world"] = p.state.ctm;
  p.world_begun = true;
}

}  // namespace

std::span<const Directive> option_directives() {
  using Where = Directive::Where;
  static constexpr std::array<Directive, 9> kDirectives = {{{"Camera", Where::kOptions, camera},
                                                            {"Film", Where::kOptions, film},
                                                            {"PixelFilter", Where::kOptions, pixel_filter},
                                                            {"Sampler", Where::kOptions, sampler},
                                                            {"Integrator", Where::kOptions, integrator},
                                                            {"Accelerator", Where::kOptions, accelerator},
                                                            {"ColorSpace", Where::kAnywhere, color_space},
                                                            {"Option", Where::kAnywhere, option},
                                                            {"WorldBegin", Where::kOptions, world_begin}}};
  return kDirectives;
}

}  // namespace etd::pbrt
