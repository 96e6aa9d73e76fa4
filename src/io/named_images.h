// Images by the names that a scene gives them: in files, or in memory already, for those who make a scene in code.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "io/image.h"
#include "params/declaration.h"

namespace etd {

// A scene names them where it could name a file. Only files have an encoding or layers, and only those of textures lose
// an opaque alpha (without_opaque_alpha()) or are mended (mend_texels()); images of lights and apertures are mended
// too.
using NamedImages = std::map<std::string, std::shared_ptr<const Image>>;

// It says where the images are that a scene names: in memory or, those that are not, in files.
struct ImageSource {
  std::filesystem::path folder = {};       // where relative file names start
  const NamedImages* in_memory = nullptr;  // outlives its use; null: none

  // Null if the image is not in memory.
  std::shared_ptr<const Image> find(const std::string& name) const {
    if (!in_memory) return nullptr;
    const auto it = in_memory->find(name);
    return it == in_memory->end() ? nullptr : it->second;
  }
};

// The image that `name` (a parameter of `params`, whose "layer" is that of the image) names, with finite values: what
// lights and cameras take. Null where there is none, which is reported; `hint` goes with the message.
std::shared_ptr<const Image> read_named_image(const ParamReader& params, const Param& name, const ImageSource& source,
                                              const std::string& hint = {});

}  // namespace etd
