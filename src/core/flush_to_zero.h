// Denormal numbers would make the same sum fast on one thread and slow on another, and their treatment is a mode of the
// thread: every work item sets it itself, so that the bits of an image never depend on who ran it.
#pragma once

#include <xmmintrin.h>

namespace etd {

// Within its scope results and operands too small for normal floats are zero.
class FlushToZero {
 public:
  FlushToZero() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | kFlushToZero | kDenormalsAreZero); }
  ~FlushToZero() { _mm_setcsr(saved_); }
  FlushToZero(const FlushToZero&) = delete;
  FlushToZero& operator=(const FlushToZero&) = delete;

 private:
  static constexpr unsigned kFlushToZero = 0x8000, kDenormalsAreZero = 0x0040;
  unsigned saved_;
};

}  // namespace etd
