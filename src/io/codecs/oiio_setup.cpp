#include "io/codecs/oiio_setup.h"

#include <OpenImageIO/imageio.h>

#include <cstdlib>
#include <system_error>

namespace etd {

void prepare_oiio() {
  static const bool done = [] {
    OIIO::attribute("exr_threads", -1);
    // It makes a pool of as many threads as there are cores before it looks at the number that it is given. The
    // variable keeps that to one; if not even one can be had, the number has been taken by then, and nothing asks for
    // the pool.
    ::setenv("OPENIMAGEIO_THREADS", "1", 1);
    try {
      OIIO::attribute("threads", 1);
    } catch (const std::system_error&) {
    }
    return true;
  }();
  static_cast<void>(done);
}

}  // namespace etd
