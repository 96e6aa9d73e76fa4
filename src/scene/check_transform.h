// What every transform of a description has to be.
#pragma once

#include <fmt/format.h>

#include "core/transform.h"
#include "params/diagnostics.h"

namespace etd {

// Reports transforms that have no inverse at the start, at the end or somewhere in between, and is then false.
inline bool check_transform(const TransformPair& t, SourceLoc loc, std::string_view what, Diagnostics& diagnostics) {
  if (t.start.is_singular() || t.end.is_singular())
    return diagnostics.error(loc, fmt::format("the transform of this {} is singular", what)), false;
  if (t.is_moving() && (t.start.determinant3() < 0) != (t.end.determinant3() < 0))
    diagnostics.error(loc, fmt::format("this {} turns inside out while it moves", what),
                      "one of its two transforms mirrors and the other does not");
  else
    return true;
  return false;
}

}  // namespace etd
