#include "formats/pbrt/old_names.h"

#include <fmt/format.h>

#include <algorithm>

#include "render/registry.h"

namespace etd::pbrt {

namespace {

struct OldModel {
  Family family;
  std::string_view name, hint;
};
constexpr OldModel kModels[] = {
    {Family::kMaterial, "matte", "write \"diffuse\""},
    {Family::kMaterial, "plastic", "write \"coateddiffuse\""},
    {Family::kMaterial, "substrate", "write \"coateddiffuse\""},
    {Family::kMaterial, "uber", "write \"coateddiffuse\""},
    {Family::kMaterial, "metal", "write \"conductor\""},
    {Family::kMaterial, "mirror", "write \"conductor\""},
    {Family::kMaterial, "glass", "write \"dielectric\""},
    {Family::kMaterial, "translucent", "write \"diffusetransmission\""},
    {Family::kMaterial, "kdsubsurface", "write \"subsurface\""},
    {Family::kMaterial, "fourier", "pbrt-v4 has \"measured\" instead"},
    {Family::kMaterial, "disney", "pbrt-v4 has \"coateddiffuse\" and \"coatedconductor\" instead"},
    {Family::kShape, "cone", "pbrt-v4 has none; write a mesh"},
    {Family::kShape, "paraboloid", "pbrt-v4 has none; write a mesh"},
    {Family::kShape, "hyperboloid", "pbrt-v4 has none; write a mesh"},
    {Family::kShape, "heightfield", "pbrt-v4 has none; write a mesh"},
    {Family::kShape, "heightfield2", "pbrt-v4 has none; write a mesh"},
    {Family::kShape, "nurbs", "pbrt-v4 has none; write a mesh"},
    {Family::kFilm, "image", "write \"rgb\""},
    {Family::kCamera, "environment", "write \"spherical\""},
    {Family::kLight, "exinfinite", "write \"infinite\""},
    {Family::kAreaLight, "area", "write \"diffuse\""},
    {Family::kTexture, "uv", "pbrt-v4 has none"},
    {Family::kSampler, "lowdiscrepancy", "write \"sobol\""},
    {Family::kSampler, "02sequence", "write \"sobol\""},
    {Family::kSampler, "maxmindist", "write \"sobol\""},
    {Family::kSampler, "random", "write \"independent\""},
    {Family::kIntegrator, "directlighting", "write \"path\" with \"integer maxdepth\" 1"},
    {Family::kIntegrator, "whitted", "write \"path\""},
    {Family::kIntegrator, "ao", "write \"ambientocclusion\""},
    {Family::kIntegrator, "ppm", "write \"sppm\""},
    {Family::kMaterial, "shinymetal", "write \"conductor\""}};

// An empty model stands for all of the family.
struct OldParam {
  Family family;
  std::string_view model, name, hint;
};
constexpr OldParam kParams[] = {
    {Family::kMaterial, "", "Kd", "write \"reflectance\""},
    {Family::kMaterial, "", "Ks", "pbrt-v4 has none, \"eta\" says how much a coat reflects"},
    {Family::kMaterial, "mirror", "Kr", "write \"reflectance\""},
    {Family::kMaterial, "conductor", "Kr", "write \"reflectance\""},
    {Family::kMaterial, "", "Kr", "pbrt-v4 has none, \"eta\" says how much is reflected"},
    {Family::kMaterial, "", "Kt", "pbrt-v4 has none, \"eta\" says how much passes"},
    {Family::kMaterial, "", "index", "write \"eta\""},
    {Family::kMaterial, "", "sigma", "pbrt-v4 has none, its diffuse surfaces reflect evenly"},
    {Family::kMaterial, "", "opacity", "write \"alpha\" on the shape"},
    {Family::kMaterial, "", "bumpmap", "write \"displacement\""},
    {Family::kMaterial, "", "reflect", "write \"reflectance\""},
    {Family::kMaterial, "", "transmit", "write \"transmittance\""},
    {Family::kMaterial, "", "namedmaterial1", "write \"string materials\" with both names"},
    {Family::kMaterial, "", "namedmaterial2", "write \"string materials\" with both names"},
    {Family::kShape, "", "shadowalpha", "write \"alpha\", which holds for all rays"},
    {Family::kShape, "trianglemesh", "st", "write \"point2 uv\""},
    {Family::kShape, "", "discarddegenerateUVs", "leave it out"},
    {Family::kTexture, "imagemap", "trilinear", "write \"string filter\" \"trilinear\""},
    {Family::kTexture, "imagemap", "gamma", "write \"string encoding\" \"sRGB\" or \"linear\""},
    {Family::kTexture, "checkerboard", "aamode", "leave it out"},
    {Family::kLight, "", "mapname", "write \"filename\""},
    {Family::kLight, "", "samples", "leave it out, the samples of the pixels decide"},
    {Family::kLight, "", "nsamples", "leave it out, the samples of the pixels decide"},
    {Family::kAreaLight, "", "samples", "leave it out, the samples of the pixels decide"},
    {Family::kAreaLight, "", "nsamples", "leave it out, the samples of the pixels decide"},
    {Family::kFilm, "", "scale", "write \"float iso\" with 100 times its value"},
    {Family::kFilm, "", "maxsampleluminance", "write \"maxcomponentvalue\""},
    {Family::kFilter, "", "xwidth", "write \"xradius\""},
    {Family::kFilter, "", "ywidth", "write \"yradius\""},
    {Family::kFilter, "gaussian", "alpha", "write \"sigma\", which is 1 / sqrt(2 alpha)"},
    {Family::kIntegrator, "", "lightsamplestrategy", "write \"lightsampler\""},
    {Family::kIntegrator, "", "rrthreshold", "leave it out"},
    {Family::kIntegrator, "", "pixelbounds", "write it in the Film"}};

struct OldWord {
  std::string_view word, hint;
};
constexpr OldWord kDirectives[] = {{"WorldEnd", "the world of pbrt-v4 ends with the file"},
                                   {"SurfaceIntegrator", "write Integrator"},
                                   {"VolumeIntegrator", "write Integrator \"volpath\", which does both"},
                                   {"Renderer", "write Integrator"},
                                   {"Volume", "write MakeNamedMedium and MediumInterface"},
                                   {"Interior", "write MediumInterface"},
                                   {"Exterior", "write MediumInterface"},
                                   {"SearchPath", "file names start in the folder of the scene"}};

void note_converter(const SourceLoc& loc, Diagnostics& diagnostics) {
  diagnostics.note(loc, "this is of an older pbrt; \"pbrt --upgrade SCENE\" of pbrt-v4 rewrites most of such a scene");
}

const OldParam* find_param(Family family, std::string_view model, std::string_view name) {
  for (const OldParam& p : kParams)
    if (p.family == family && (p.model.empty() || p.model == model) && p.name == name) return &p;
  return nullptr;
}

}  // namespace

std::string old_model_hint(Family family, const ModelUse& use, Diagnostics& diagnostics) {
  const auto old = std::find_if(std::begin(kModels), std::end(kModels),
                                [&](const OldModel& m) { return m.family == family && m.name == use.model; });
  if (old == std::end(kModels)) return {};
  note_converter(use.loc, diagnostics);
  std::string hint = fmt::format("\"{}\" is of pbrt-v3: {}\n", use.model, old->hint);
  for (const Param& p : use.params)
    if (const OldParam* param = find_param(family, use.model, p.name))
      hint += fmt::format("\"{}\": {}\n", p.name, param->hint);
  return hint;
}

bool is_old_directive(std::string_view word) {
  return std::any_of(std::begin(kDirectives), std::end(kDirectives), [&](const OldWord& d) { return d.word == word; });
}

std::string old_directive_hint(std::string_view word, const SourceLoc& loc, Diagnostics& diagnostics) {
  for (const OldWord& d : kDirectives)
    if (d.word == word) {
      note_converter(loc, diagnostics);
      return fmt::format("{} is of an older pbrt: {}", word, d.hint);
    }
  return {};
}

std::string old_type_hint(std::string_view type, std::string_view name, const SourceLoc& loc,
                          Diagnostics& diagnostics) {
  if (type != "color" && type != "xyz") return {};
  note_converter(loc, diagnostics);
  return fmt::format("\"{}\" is of pbrt-v3: write \"rgb {}\"{}", type, name,
                     type == "xyz" ? " and the numbers of the colour in the ColorSpace" : "");
}

std::string old_texture_kind_hint(std::string_view kind, const SourceLoc& loc, Diagnostics& diagnostics) {
  if (kind != "color") return {};
  note_converter(loc, diagnostics);
  return "\"color\" is of pbrt-v3: write \"spectrum\"";
}

void reject_old_blackbody(Param& param, Diagnostics& diagnostics) {
  const std::vector<double>& n = param.numbers;
  if (param.kind != ParamKind::kBlackbody || param.malformed || n.empty() || n.size() % 2 != 0) return;
  note_converter(param.loc, diagnostics);
  const std::string now =
      n.size() > 2 ? fmt::format("pbrt-v4 has no sums, one \"blackbody {}\" is one temperature", param.name)
      : n[1] == 1
          ? fmt::format("write \"blackbody {}\" {:g}", param.name, n[0])
          : fmt::format("write \"blackbody {}\" {:g}, and for a light \"float scale\" {:g}", param.name, n[0], n[1]);
  diagnostics.error(
      param.value_loc,
      fmt::format("\"blackbody {}\" takes one temperature in kelvin, not {} numbers", param.name, n.size()),
      fmt::format("a temperature with a factor is of pbrt-v3: {}", now));
  param.malformed = true;
}

void drop_old_params(Family family, ModelUse& use, Diagnostics& diagnostics) {
  const ModelDecl* model = find_any_model(family, use.model);
  if (!model) return;
  const auto is_old = [&](const Param& param) {
    const OldParam* old = model->find(param.name) ? nullptr : find_param(family, use.model, param.name);
    if (!old) return false;
    note_converter(param.loc, diagnostics);
    diagnostics.error(param.loc,
                      fmt::format("{} \"{}\" has no parameter \"{}\"", family_name(family), use.model, param.name),
                      fmt::format("\"{}\" is of pbrt-v3: {}", param.name, old->hint));
    return true;
  };
  use.params.erase(std::remove_if(use.params.begin(), use.params.end(), is_old), use.params.end());
}

}  // namespace etd::pbrt
