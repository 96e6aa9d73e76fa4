#include "formats/mesh/obj_scene.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <utility>

#include "formats/mesh/params.h"
#include "scene/registry.h"
#include "shapes/mesh_shapes.h"

namespace etd {

namespace {

bool is_black(Vec3 c) { return c == Vec3{}; }

// Models of shading that refract: 4 and 9 are glass, 6 and 7 refraction with and without Fresnel.
bool is_glass(const ObjMaterial& m) { return m.illum == 4 || m.illum == 6 || m.illum == 7 || m.illum == 9; }
bool is_mirror(const ObjMaterial& m) { return m.illum == 3 || m.illum == 5 || m.illum == 8; }

// Microfacet alpha of Phong's exponent: the lobes agree around their peak for alpha^2 = 2 / (n + 2) (Walter et al.
// 2007).
double alpha_of(const ObjMaterial& m) {
  if (m.pr) return *m.pr * *m.pr;
  return is_mirror(m) ? 0.0 : std::sqrt(2.0 / (m.ns + 2.0));
}

// Index of the coat whose reflectance straight on is the mean of Ks. Files that mean Phong's model have a Ks near 1,
// which no coat has: 0.04, that of index 1.5, is the most.
double coat_index(const ObjMaterial& m) {
  const double r = std::sqrt(std::min((double(m.ks.x) + m.ks.y + m.ks.z) / 3, 0.04));
  return (1 + r) / (1 - r);
}

class ObjMaterials {
 public:
  // `like`: the shape that the file is; its transform makes the file's units those of the scene.
  ObjMaterials(const ObjResult& obj, std::filesystem::path file, const ShapeDesc& like, SceneDescription& scene)
      : obj_(obj),
        file_(std::move(file)),
        loc_(like.use.loc),
        unit_(std::cbrt(std::abs(like.to_world.start.determinant3()))),
        scene_(scene) {}

  // Index of the material of that name in the scene, -1 for those that the file does not have.
  int index(const std::string& name) {
    const auto known = index_of_.find(name);
    if (known != index_of_.end()) return known->second;
    const ObjMaterial* m = obj_.find(name);
    int index = -1;
    if (m) {
      index = static_cast<int>(scene_.materials.size());
      scene_.materials.push_back({fmt::format("{}: {}", file_.string(), name), convert(*m)});
    } else if (!name.empty()) {
      missing.push_back(name);
    }
    return index_of_[name] = index;
  }

  // Opacity as the shape's alpha, where there are holes: d, times its image. Glass is clear by itself.
  std::optional<Param> alpha(const std::string& name) {
    const ObjMaterial* m = obj_.find(name);
    if (!m || is_glass(*m) || (m->d >= 1 && m->map_d.file.empty())) return {};
    if (m->d == 0) invisible.push_back(name);
    Param p = m->map_d.file.empty()
                  ? number_param("alpha", {m->d})
                  : string_param("alpha", image(*m, m->map_d, m->d, true, "linear"), ParamKind::kTexture);
    p.loc = p.value_loc = loc_;
    return p;
  }

  // Names of materials that lose something.
  std::vector<std::string> missing, tinted, flat, invisible;

 private:
  ModelUse convert(const ObjMaterial& m) {
    ModelUse made = closure(m);
    if (std::optional<Param> detail = surface_detail(m)) made.params.push_back(std::move(*detail));
    return made;
  }

  ModelUse closure(const ObjMaterial& m) {
    if (is_glass(m)) return use("dielectric", {number_param("eta", {m.ni > 1 ? m.ni : 1.5})});
    const bool has_diffuse = !is_black(m.kd) || !m.map_kd.file.empty();
    if (m.pm >= 0.5 || (!has_diffuse && !is_black(m.ks))) {
      const double alpha = alpha_of(m);
      return use("conductor",
                 {m.pm >= 0.5 ? diffuse(m) : rgb_param("reflectance", m.ks), number_param("roughness", {alpha}),
                  integer_param("remaproughness", {0}, ParamKind::kBool)});
    }
    if (is_black(m.ks)) return use("diffuse", {diffuse(m)});
    return use("coateddiffuse",
               {diffuse(m), number_param("eta", {coat_index(m)}), number_param("roughness", {alpha_of(m)}),
                integer_param("remaproughness", {0}, ParamKind::kBool)});
  }

  ModelUse use(std::string model, std::vector<Param> params) const {
    for (Param& p : params) p.loc = p.value_loc = loc_;
    return {std::move(model), std::move(params), loc_};
  }

  // Kd, times its image where there is one. Black in front of an image is what exporters write who mean the image
  // alone.
  Param diffuse(const ObjMaterial& m) {
    if (m.map_kd.file.empty()) return rgb_param("reflectance", m.kd);
    if (m.kd.x != m.kd.y || m.kd.y != m.kd.z) tinted.push_back(m.name);
    const double mean = (double(m.kd.x) + m.kd.y + m.kd.z) / 3;
    return string_param("reflectance", image(m, m.map_kd, mean > 0 ? mean : 1.0, false, "sRGB"), ParamKind::kTexture);
  }

  // The normal map, or the bump map as a height: the surface can have one of them.
  std::optional<Param> surface_detail(const ObjMaterial& m) {
    std::optional<Param> detail;
    if (!m.normal.file.empty()) {
      if (!m.bump.file.empty()) flat.push_back(m.name);
      detail = string_param("normalmap", image(m, m.normal, 1, false, "linear"), ParamKind::kTexture);
    } else if (!m.bump.file.empty()) {
      const std::string heights = image(m, m.bump, 1, true, "linear"), scaled = heights + " as heights";
      scene_.textures.push_back({scaled, true,
                                 use("scale", {string_param("tex", heights, ParamKind::kTexture),
                                               number_param("scale", {m.bump.height * unit_})}),
                                 Transform()});
      detail = string_param("displacement", scaled, ParamKind::kTexture);
    }
    if (detail) detail->loc = detail->value_loc = loc_;
    return detail;
  }

  // Adds a texture of the image times a factor, and returns its name, which no other texture has.
  std::string image(const ObjMaterial& m, const ObjMap& map, double scale, bool is_float, std::string encoding) {
    const std::string name =
        fmt::format("{}: {}: {} {}", file_.string(), m.name, map.file.string(), scene_.textures.size());
    scene_.textures.push_back(
        {name, is_float,
         use("imagemap",
             {string_param("filename", (file_.parent_path() / map.file).string()), number_param("scale", {scale}),
              number_param("uscale", {map.scale.x}), number_param("vscale", {map.scale.y}),
              number_param("udelta", {map.offset.x}), number_param("vdelta", {map.offset.y}),
              string_param("wrap", map.clamp ? "black" : "repeat"), string_param("encoding", std::move(encoding))}),
         Transform()});
    return name;
  }

  const ObjResult& obj_;
  std::filesystem::path file_;
  SourceLoc loc_;
  double unit_;  // of the file, in those of the scene
  SceneDescription& scene_;
  std::map<std::string, int> index_of_;
};

void note_losses(const ObjMaterials& materials, SourceLoc loc, const std::string& file, Diagnostics& diagnostics) {
  const auto note = [&](const std::vector<std::string>& names, std::string_view what) {
    if (!names.empty()) diagnostics.note(loc, fmt::format("{}: {}: {}", file, what, fmt::join(names, ", ")));
  };
  note(materials.missing, "materials that no MTL file has, the current one is used");
  note(materials.flat, "materials with a bump and a normal map, the normal map is used");
  note(materials.invisible, "materials of opacity 0 (d or Tr), which nobody can see");
  note(materials.tinted, "materials whose image is multiplied by the mean of their coloured Kd");
}

}  // namespace

ObjFile::ObjFile(ObjResult result) : obj(std::move(result)) {
  for (ObjPart& part : obj.parts) meshes.push_back(std::make_shared<const MeshData>(std::exchange(part.mesh, {})));
}

ObjFiles::Found ObjFiles::read(const Param& name, const std::filesystem::path& folder, Diagnostics& diagnostics) {
  const std::filesystem::path path = folder / name.strings[0];
  std::error_code failed;
  std::filesystem::path place = std::filesystem::weakly_canonical(path, failed);
  if (failed) place = path;
  if (const auto known = files_.find(place); known != files_.end()) return {known->second, false};
  const ObjFile& file = files_.emplace(place, read_obj(path, diagnostics.limits())).first->second;
  report_mesh_problems(file.obj.problems, file.obj.notes, name.value_loc, folder, name.strings[0], diagnostics);
  return {file, true};
}

std::vector<ShapeDesc> add_obj(const ObjFile& from, const std::filesystem::path& file, const ShapeDesc& like,
                               bool noted, SceneDescription& scene, Diagnostics& diagnostics) {
  const SourceLoc loc = like.use.loc;
  const ObjResult& obj = from.obj;
  ObjMaterials materials(obj, file, like, scene);
  std::vector<ShapeDesc> shapes;
  for (const ObjPart& part : obj.parts) {
    ShapeDesc shape = like;
    shape.part = static_cast<int>(shapes.size());
    shape.use = {"trianglemesh", {}, loc};
    shape.mesh = from.meshes[shapes.size()];
    if (const int index = materials.index(part.material); index >= 0) shape.material = index;
    // The shape's own alpha is for all of it.
    if (const Param* given = like.use.find("alpha"))
      shape.use.params.push_back(*given);
    else if (std::optional<Param> alpha = materials.alpha(part.material))
      shape.use.params.push_back(std::move(*alpha));
    if (const ObjMaterial* m = obj.find(part.material); m && !is_black(m->ke)) {
      shape.area_light = static_cast<int>(scene.area_lights.size());
      ModelUse light{"diffuse", {rgb_param("L", m->ke)}, loc};
      light.params[0].loc = light.params[0].value_loc = loc;
      scene.area_lights.push_back(std::move(light));
    }
    shapes.push_back(std::move(shape));
  }
  if (noted) note_losses(materials, loc, file.string(), diagnostics);
  return shapes;
}

std::vector<ShapeDesc> expand_objmesh(ShapeDesc shape, SceneDescription& scene, ObjFiles& files,
                                      Diagnostics& diagnostics) {
  const ParamReader p(ObjMeshShape::decl(), shape.use, diagnostics);
  const Param* file = p.given("filename");
  if (!file || !p.boolean("materials")) return {std::move(shape)};
  const ObjFiles::Found found = files.read(*file, scene.folder, diagnostics);
  if (!found.file.obj.problems.empty()) return {};
  return add_obj(found.file, file->strings[0], shape, found.is_new, scene, diagnostics);
}

}  // namespace etd
