// The list of shapes. To add one: its declaration, its line in make_shape.
#include "shapes/shape.h"

namespace etd {

std::span<const ModelDecl* const> shape_models() {
  static const ModelDecl* const all[] = {&trianglemesh_decl(), &plymesh_decl(), &offmesh_decl(),  &objmesh_decl(),
                                         &bilinearmesh_decl(), &sphere_decl(),  &cylinder_decl(), &disk_decl()};
  return all;
}

std::optional<ShapeGeometry> make_shape(const ModelUse& use, const std::filesystem::path& folder, MeshFiles& files,
                                        Diagnostics& diagnostics) {
  ShapeGeometry made;
  std::optional<MeshData> mesh;
  if (use.model == "trianglemesh") mesh = make_trianglemesh({trianglemesh_decl(), use, diagnostics});
  if (use.model == "bilinearmesh") {
    made.patches = make_bilinearmesh({bilinearmesh_decl(), use, diagnostics});
    // Parallelograms are two triangles each, and those are met faster.
    if (made.patches && (mesh = as_triangles(*made.patches))) made.patches.reset();
  }
  if (mesh) made.mesh = without_unused_vertices(std::move(*mesh));
  for (const ModelDecl* file : {&plymesh_decl(), &offmesh_decl(), &objmesh_decl()})
    if (use.model == file->name) made.mesh = files.mesh({*file, use, diagnostics}, folder);
  for (const ModelDecl* quadric : {&sphere_decl(), &cylinder_decl(), &disk_decl()})
    if (use.model == quadric->name) made.quadric = make_quadric_shape({*quadric, use, diagnostics});
  if (!made.mesh && !made.patches && !made.quadric) return {};
  if (made.patches) drop_unused_vertices(made.patches->vertices, corners_of(made.patches->patches));
  return made;
}

}  // namespace etd
