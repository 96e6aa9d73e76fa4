// The list of shapes. To add one: its declaration, its line in make_shape.
#include "shapes/shape.h"

#include "shapes/mesh_shapes.h"

namespace etd {

namespace {

const ModelDecl& sphere_decl() {
  static const ModelDecl d{
      Family::kShape,
      "sphere",
      "A full sphere around the origin.",
      {{.name = "radius", .default_value = 1.0, .min = 0, .above_min = true, .unit = "m", .doc = "Radius."}}};
  return d;
}

}  // namespace

std::span<const ModelDecl* const> shape_models() {
  static const ModelDecl* const all[] = {&trianglemesh_decl(), &plymesh_decl(), &offmesh_decl(), &objmesh_decl(),
                                         &sphere_decl()};
  return all;
}

std::optional<ShapeGeometry> make_shape(const ModelUse& use, const std::filesystem::path& folder,
                                        Diagnostics& diagnostics) {
  const auto of_mesh = [](std::optional<MeshData> mesh) -> std::optional<ShapeGeometry> {
    if (!mesh) return {};
    return ShapeGeometry{std::move(mesh), 0.0};
  };
  if (use.model == "trianglemesh") return of_mesh(make_trianglemesh({trianglemesh_decl(), use, diagnostics}));
  for (const ModelDecl* file : {&plymesh_decl(), &offmesh_decl(), &objmesh_decl()})
    if (use.model == file->name) return of_mesh(make_mesh_from_file({*file, use, diagnostics}, folder));
  if (use.model == "sphere") {
    const ParamReader p(sphere_decl(), use, diagnostics);
    return ShapeGeometry{{}, p.number("radius")};
  }
  return {};
}

}  // namespace etd
