// Included by each file that has faults planted (preset `faults`): which of them is switched on.
#pragma once

#include <cstdlib>

namespace etd_faults {

// The number of the active fault, from the environment; none by default.
inline int active() {
  static const int number = [] {
    const char* text = std::getenv("ETENDUE_FAULT");
    return text ? std::atoi(text) : 0;
  }();
  return number;
}

}  // namespace etd_faults
