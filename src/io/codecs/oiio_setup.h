// What every use of OpenImageIO in this room needs first.
#pragma once

namespace etd {

// Keeps OpenImageIO and OpenEXR from starting thread pools of their own: the program decides how many threads work.
// Cheap to call again, from any thread.
void prepare_oiio();

}  // namespace etd
