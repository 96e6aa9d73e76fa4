// Directives before WorldBegin: camera, film, filter, sampler, integrator and global options.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "formats/pbrt/coverage.h"
#include "formats/pbrt/parser.h"
#include "render/other_names.h"
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
  p.coordinate_systems.set("camera", p.state.ctm.inverse());
  if (const auto world_to_camera = p.placement(d.loc, "camera")) p.scene.camera_to_world = world_to_camera->inverse();
}

void film(Parser& p, const Token& d) { read_model(p, d, Family::kFilm, p.scene.film); }
void pixel_filter(Parser& p, const Token& d) { read_model(p, d, Family::kFilter, p.scene.filter); }

// A stratified sampler says how many samples it takes as a product.
void multiply_strata(ModelUse& use) {
  if (use.find("pixelsamples") && !use.find("xsamples") && !use.find("ysamples")) return;
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
  use.params.push_back(std::move(samples));
}

void sampler(Parser& p, const Token& d) {
  std::optional<ModelUse> use = p.model_arguments(d, "the name of a sampler");
  if (!use) return;
  if (use->model == "stratified") multiply_strata(*use);
  const auto foreign = [&](const Param& param) {
    if (param.name != "randomization") return false;
    p.diagnostics.note(param.loc, "samples are scrambled by Owen's method, whatever \"randomization\" says");
    return true;
  };
  std::erase_if(use->params, foreign);
  take_other_name(Family::kSampler, *use, p.diagnostics);
  replace(p, p.scene.sampler, *make_supported(Family::kSampler, std::move(*use), p.diagnostics), d);
}

bool contains(std::span<const std::string_view> names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Those of pbrt that are not ours.
constexpr std::string_view kLightSamplers[] = {"exhaustive"};

// What the path integrator of pbrt has beside its depth.
void read_path_params(Parser& p, ModelUse& use) {
  const ModelDecl* decl = find_any_model(Family::kIntegrator, "path");
  const auto foreign = [&](const Param& param) {
    if (param.name == "lightsampler" && param.strings.size() == 1 && contains(kLightSamplers, param.strings[0])) {
      p.diagnostics.note(param.loc, fmt::format("lights are chosen as is usual here, not by \"{}\"", param.strings[0]));
      return true;
    }
    if (decl && decl->find(param.name)) return false;
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
  if (use->model == "path" || contains(other_names(Family::kIntegrator), use->model)) read_path_params(p, *use);
  take_other_name(Family::kIntegrator, *use, p.diagnostics);
  replace(p, p.scene.integrator, *make_supported(Family::kIntegrator, std::move(*use), p.diagnostics), d);
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
  p.coordinate_systems.set("world", p.state.ctm);
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
