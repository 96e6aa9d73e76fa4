// When a camera's shutter is open: rays are spread evenly over that time.
#pragma once

#include <fmt/format.h>

#include "params/declaration.h"

namespace etd {

struct Shutter {
  double open = 0, close = 1;

  static std::vector<ParamDecl> params() {
    return {{.name = "shutteropen", .default_value = 0.0, .unit = "s", .doc = "When the shutter opens."},
            {.name = "shutterclose", .default_value = 1.0, .unit = "s", .doc = "When the shutter closes."}};
  }
  // Relative to a span of time, which becomes 0 to 1.
  Shutter within(double start, double end) const {
    return {(open - start) / (end - start), (close - start) / (end - start)};
  }
};

// Reads the shutter of a checked use.
inline Shutter read_shutter(const ParamReader& p) {
  const Shutter s{p.number("shutteropen"), p.number("shutterclose")};
  if (s.close < s.open)
    p.diagnostics().error(
        p.given("shutterclose") ? p.given("shutterclose")->value_loc : p.given("shutteropen")->value_loc,
        fmt::format("the shutter closes at {:g}, before it opens at {:g}", s.close, s.open));
  return s;
}

}  // namespace etd
