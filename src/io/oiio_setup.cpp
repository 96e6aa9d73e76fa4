#include "io/oiio_setup.h"

#include <OpenImageIO/imageio.h>

namespace etd {

void prepare_oiio() {
  static const bool done = [] {
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);
    return true;
  }();
  static_cast<void>(done);
}

}  // namespace etd
