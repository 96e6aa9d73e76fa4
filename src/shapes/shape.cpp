#include "shapes/shape.h"

#include "params/model_list.h"
#include "shapes/shape_list.h"

namespace etd {

std::span<const ModelDecl* const> shape_models() {
  static const std::vector<const ModelDecl*> all = declarations(Shapes{});
  return all;
}

std::optional<ShapeGeometry> make_shape(const ModelUse& use, const std::filesystem::path& folder, MeshFiles& files,
                                        Diagnostics& diagnostics) {
  ShapeGeometry made;
  with_model(Shapes{}, use, diagnostics, [&]<class T>(std::type_identity<T>, const ParamReader& p) {
    made = T::create(p, {folder, files});
  });
  if (!made.mesh && !made.patches && !made.quadric) return {};
  return made;
}

}  // namespace etd
