// Textures made one after the other as a scene would, without a scene.
#pragma once

#include "model_uses.h"
#include "temp_folder.h"
#include "textures/resolve.h"

namespace etd {

class Textures {
 public:
  // Builds one, which later ones can refer to by name.
  SpectrumSource add(const std::string& name, const ModelUse& use, bool is_float = false,
                     const Transform& to_world = Transform()) {
    for (const ModelDecl* decl : texture_models())
      if (decl->name == use.model) check_params(*decl, use, diagnostics);
    builder_.add(name, is_float, use, to_world, diagnostics);
    builder_.load_images(memory, diagnostics);
    return {{}, static_cast<int32_t>(table.textures.size()) - 1};
  }
  void recentre(Vec3d origin) { builder_.recentre(origin); }
  Spectrum at(const SpectrumSource& source, float u, float v) const { return table.eval(source, {{u, v}}, {}); }
  Spectrum at(const SpectrumSource& source, Point3 p) const { return table.eval(source, {{}, p}, {}); }

  TempFolder folder;
  TextureMemory memory;
  Diagnostics diagnostics;
  TextureTable table;

 private:
  TextureBuilder builder_{table, folder.path()};
};

}  // namespace etd
