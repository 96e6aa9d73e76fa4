// What is found in the module by name.
#include "io/codecs/codecs.h"

#define ETENDUE_EXPORT __attribute__((visibility("default"), used))

extern "C" ETENDUE_EXPORT const etd::ImageCodecs* etendue_image_codecs() {
  static const etd::OiioCodecs codecs;
  return &codecs;
}

// Libraries that come with OpenImageIO bring a logger, log4cplus, which starts four threads when it is loaded, and lets
// the process abort when the system refuses one. Its initialisation is found here first, and does nothing: nobody logs.
namespace log4cplus {
ETENDUE_EXPORT void initializeLog4cplus() {}
}  // namespace log4cplus
