// The list of films. To add one: its header, and its name in the list. A type T of it has T::decl() and T::create().
#pragma once

#include "core/tagged.h"
#include "film/gbuffer.h"
#include "film/rgb.h"

namespace etd {

using Films = TypeList<RgbFilm, GBufferFilm>;

}  // namespace etd
