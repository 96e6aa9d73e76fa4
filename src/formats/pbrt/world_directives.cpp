// Directives of the world: shapes, materials, lights, textures, media, objects, and files that hold them.
#include <fmt/format.h>

#include <array>

#include "formats/mesh/obj_scene.h"
#include "formats/pbrt/coverage.h"
#include "formats/pbrt/old_names.h"
#include "formats/pbrt/parser.h"

namespace etd::pbrt {

namespace {

// "" and "none" are older names of the surface that is not there.
std::string material_name(Parser& p, const std::string& name, const SourceLoc& loc) {
  if (!name.empty() && name != "none") return name;
  p.diagnostics.note(loc, fmt::format("material \"{}\" is called \"interface\" in pbrt-v4", name));
  return "interface";
}

ModelUse supported_material(Parser& p, ModelUse use) {
  use.model = material_name(p, use.model, use.loc);
  p.add_defaults(AttributeTarget::kMaterial, Family::kMaterial, use);
  const SourceLoc loc = use.loc;
  if (const Param* mixed = use.model == "mix" ? use.find("materials") : nullptr; mixed && !mixed->malformed)
    for (const std::string& name : mixed->strings) p.names.use_material(name, mixed->value_loc, p.scene);
  return make_supported(Family::kMaterial, std::move(use), p.diagnostics).value_or(ModelUse{"diffuse", {}, loc});
}

void material(Parser& p, const Token& d) {
  std::optional<ModelUse> use = p.model_arguments(d, "the name of a material", ColorRole::kReflectance);
  if (!use) return;
  p.state.material = static_cast<int>(p.scene.materials.size());
  p.scene.materials.push_back({"", supported_material(p, std::move(*use))});
}

void make_named_material(Parser& p, const Token& d) {
  std::optional<ModelUse> use = p.model_arguments(d, "the name of the new material", ColorRole::kReflectance);
  if (!use) return;
  const std::string name = std::exchange(use->model, std::string());
  const SourceLoc loc = use->loc;
  for (size_t i = 0; i < use->params.size(); ++i) {
    const Param& type = use->params[i];
    if (type.name != "type") continue;
    if (type.kind == ParamKind::kString && type.strings.size() == 1) {
      use->model = material_name(p, type.strings[0], type.value_loc);
      use->loc = type.value_loc;
    }
    use->params.erase(use->params.begin() + static_cast<std::ptrdiff_t>(i));
    break;
  }
  if (use->model.empty()) {
    p.diagnostics.error(loc, fmt::format("material \"{}\" has no type", name),
                        "write for example \"string type\" \"diffuse\"");
    *use = {"diffuse", {}, loc};
  }
  p.names.define_material(name, supported_material(p, std::move(*use)), loc, p.scene, p.diagnostics);
}

void named_material(Parser& p, const Token& d) {
  if (const auto name = p.string_argument(d, "the name of a material"))
    p.state.material = p.names.use_material(name->value(), name->loc, p.scene);
}

void shape(Parser& p, const Token& d) {
  std::optional<ModelUse> use = p.model_arguments(d, "the name of a shape");
  if (!use) return;
  p.add_defaults(AttributeTarget::kShape, Family::kShape, *use);
  std::optional<ModelUse> supported = make_supported(Family::kShape, std::move(*use), p.diagnostics);
  const std::optional<TransformPair> to_world = p.placement(d.loc, "shape");
  if (!supported || !to_world) return;
  std::vector<ShapeDesc>& shapes =
      p.object >= 0 ? p.scene.objects[static_cast<size_t>(p.object)].shapes : p.scene.shapes;
  ShapeDesc shape{std::move(*supported), *to_world, p.state.reverse_orientation, p.state.material, p.state.area_light};
  if (shape.use.model == "objmesh") {
    for (ShapeDesc& part : expand_objmesh(std::move(shape), p.scene, p.obj_files, p.diagnostics))
      shapes.push_back(std::move(part));
  } else {
    shapes.push_back(std::move(shape));
  }
}

void light_source(Parser& p, const Token& d) {
  std::optional<ModelUse> use = p.model_arguments(d, "the name of a light", ColorRole::kEmission);
  if (!use) return;
  p.add_defaults(AttributeTarget::kLight, Family::kLight, *use);
  std::optional<ModelUse> supported = make_supported(Family::kLight, std::move(*use), p.diagnostics);
  const std::optional<TransformPair> to_world = p.placement(d.loc, "light");
  std::vector<LightDesc>& lights =
      p.object >= 0 ? p.scene.objects[static_cast<size_t>(p.object)].lights : p.scene.lights;
  if (supported && to_world) lights.push_back({std::move(*supported), *to_world});
}

void area_light_source(Parser& p, const Token& d) {
  std::optional<ModelUse> use = p.model_arguments(d, "the name of an area light", ColorRole::kEmission);
  if (!use) return;
  p.add_defaults(AttributeTarget::kLight, Family::kAreaLight, *use);
  std::optional<ModelUse> supported = make_supported(Family::kAreaLight, std::move(*use), p.diagnostics);
  p.state.area_light = -1;
  if (!supported) return;
  p.state.area_light = static_cast<int>(p.scene.area_lights.size());
  p.scene.area_lights.push_back(std::move(*supported));
}

void reject_colors(const ModelUse& use, Diagnostics& diagnostics) {
  for (const Param& param : use.params)
    if (param.kind == ParamKind::kRgb || param.kind == ParamKind::kSpectrum || param.kind == ParamKind::kBlackbody)
      diagnostics.error(param.loc, fmt::format("\"{} {}\" in a float texture", kind_name(param.kind), param.name),
                        fmt::format("write \"float {}\", or make the texture a \"spectrum\" one", param.name));
}

void texture(Parser& p, const Token& d) {
  const auto name = p.string_argument(d, "the name of the new texture");
  if (!name) return;
  const auto kind = p.string_argument(d, "\"float\" or \"spectrum\"");
  if (!kind) return;
  std::optional<ModelUse> use = p.model_arguments(d, "the name of a texture model", ColorRole::kReflectance);
  if (!use) return;
  if (kind->text != "float" && kind->text != "spectrum")
    p.diagnostics.error(kind->loc,
                        fmt::format("a texture is of kind \"float\" or \"spectrum\", not \"{}\"", kind->text),
                        old_texture_kind_hint(kind->text, kind->loc, p.diagnostics));
  if (p.state.ctm.is_moving())
    p.diagnostics.warning(name->loc, "textures do not move: this one uses the transform of the start");
  const bool is_float = kind->text == "float";
  p.add_defaults(AttributeTarget::kTexture, Family::kTexture, *use);
  if (is_float) reject_colors(*use, p.diagnostics);
  std::optional<ModelUse> supported = make_supported(Family::kTexture, std::move(*use), p.diagnostics);
  if (!p.names.define_texture(name->value(), is_float, name->loc, p.diagnostics) || !supported) return;
  p.scene.textures.push_back({name->value(), is_float, std::move(*supported), p.state.ctm.start});
}

void reverse_orientation(Parser& p, const Token&) { p.state.reverse_orientation = !p.state.reverse_orientation; }

void attribute(Parser& p, const Token& d) {
  std::optional<ModelUse> use = p.model_arguments(d, "shape, light, material, medium or texture");
  if (!use) return;
  for (size_t i = 0; i < kAttributeTargets.size(); ++i) {
    if (kAttributeTargets[i] != use->model) continue;
    const bool light = i == static_cast<size_t>(AttributeTarget::kLight);
    p.convert_colors(use->params, light ? ColorRole::kEmission : ColorRole::kReflectance);
    // A later default of the same name replaces an earlier one; of one directive, the first counts.
    for (auto param = use->params.rbegin(); param != use->params.rend(); ++param) {
      const std::string name = param->name;
      p.defaults.set({static_cast<AttributeTarget>(i), name}, std::move(*param));
    }
    return;
  }
  p.diagnostics.error(use->loc, fmt::format("Attribute cannot set defaults of \"{}\"", use->model),
                      fmt::format("valid: {}", fmt::join(kAttributeTargets, ", ")));
}

void make_named_medium(Parser& p, const Token& d) {
  const std::optional<ModelUse> use = p.model_arguments(d, "the name of the new medium");
  if (!use) return;
  p.names.define_medium(use->model, use->loc, p.diagnostics);
  p.diagnostics.unsupported(use->loc, fmt::format("medium \"{}\"", use->model), "empty space");
}

void medium_interface(Parser& p, const Token& d) {
  const auto inside = p.string_argument(d, "the name of a medium");
  if (!inside) return;
  std::optional<Token> outside = p.tokens.peek();
  if (outside && outside->kind == Token::Kind::kString)
    p.tokens.next();
  else
    outside.reset();
  bool any = false;
  for (const std::optional<Token>& side : {std::optional<Token>(*inside), outside}) {
    if (!side || side->text.empty()) continue;
    p.names.use_medium(side->value(), side->loc);
    any = true;
  }
  if (any) p.diagnostics.unsupported(d.loc, "a medium at this interface", "empty space");
}

void object_begin(Parser& p, const Token& d) {
  const auto name = p.string_argument(d, "the name of the new object");
  if (!name) return;
  if (p.object >= 0)
    p.diagnostics.error(d.loc, "ObjectBegin inside of an object",
                        "objects may contain ObjectInstance, not ObjectBegin");
  p.open_block(Block::Kind::kObject, d.loc);
  const int index = static_cast<int>(p.scene.objects.size());
  p.names.define_object(name->value(), index, name->loc, p.diagnostics);
  p.scene.objects.push_back({name->value(), {}, {}, {}, name->loc});
  p.object = index;
}

void object_end(Parser& p, const Token& d) {
  if (p.close_block(Block::Kind::kObject, d.loc)) p.object = -1;
}

void object_instance(Parser& p, const Token& d) {
  const auto name = p.string_argument(d, "the name of an object");
  if (!name) return;
  if (const auto to_world = p.placement(d.loc, "instance"))
    p.names.use_object(name->value(), name->loc, *to_world, p.object);
}

void include(Parser& p, const Token& d) {
  if (const auto name = p.string_argument(d, "the name of a file"))
    p.tokens.push_included(name->value(), name->loc, false);
}

void import(Parser& p, const Token& d) {
  const auto name = p.string_argument(d, "the name of a file");
  if (name && p.tokens.push_included(name->value(), name->loc, true)) p.begin_import();
}

}  // namespace

std::span<const Directive> world_directives() {
  using Where = Directive::Where;
  static constexpr std::array<Directive, 16> kDirectives = {{{"Shape", Where::kWorld, shape},
                                                             {"Material", Where::kWorld, material},
                                                             {"NamedMaterial", Where::kWorld, named_material},
                                                             {"MakeNamedMaterial", Where::kWorld, make_named_material},
                                                             {"Texture", Where::kWorld, texture},
                                                             {"LightSource", Where::kWorld, light_source},
                                                             {"AreaLightSource", Where::kWorld, area_light_source},
                                                             {"ReverseOrientation", Where::kWorld, reverse_orientation},
                                                             {"ObjectBegin", Where::kWorld, object_begin},
                                                             {"ObjectEnd", Where::kWorld, object_end},
                                                             {"ObjectInstance", Where::kWorld, object_instance},
                                                             {"Attribute", Where::kAnywhere, attribute},
                                                             {"MediumInterface", Where::kAnywhere, medium_interface},
                                                             {"MakeNamedMedium", Where::kAnywhere, make_named_medium},
                                                             {"Include", Where::kAnywhere, include},
                                                             {"Import", Where::kWorld, import}}};
  return kDirectives;
}

}  // namespace etd::pbrt
