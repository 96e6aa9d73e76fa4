// What a scene uses again where it stands once: text of files that are included twice, numbers of defaults and of
// files of spectra. Includes within includes can double it forty times in a few lines, so there is a limit.
#pragma once

#include "params/diagnostics.h"

namespace etd::pbrt {

class Repeats {
 public:
  // False, and reported the first time, when the limit is reached.
  bool take(uint64_t bytes, const SourceLoc& loc, Diagnostics& diagnostics) {
    used_ += bytes;
    if (used_ <= diagnostics.limits().repeated) return true;
    if (!reported_)
      diagnostics.error(
          loc, "what is used again from here on is too much, and is left out",
          "text and numbers of included files, defaults and spectra that stand once and are used often: " +
              limit_text(diagnostics.limits(), &Limits::repeated));
    reported_ = true;
    return false;
  }

 private:
  uint64_t used_ = 0;
  bool reported_ = false;
};

}  // namespace etd::pbrt
