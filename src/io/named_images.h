// Images that are in memory already, for those who make a scene in code.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "io/image.h"

namespace etd {

// By what a texture's "filename" says instead of a file's name. They are looked up as they are: only files are mended
// (mend_texels()), lose an opaque alpha (without_opaque_alpha()) and have an encoding or layers.
using NamedImages = std::map<std::string, std::shared_ptr<const Image>>;

}  // namespace etd
