// Sums of light that paths from the lights bring to pixels, from all threads at once. They are kept in fixed point, so
// that the order in which they are added changes no bit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace etd {

// Fixed point of 128 bits in units of 2^-64: sums are exact up to 9e18 in size, and values below 5e-20 are lost.
class SplatBuffer {
 public:
  // What add() takes: values up to this size.
  static constexpr double kLargest = 0x1p61;

  explicit SplatBuffer(size_t slots) : slots_(slots) {}

  // Any thread may add to any slot.
  void add(size_t slot, double value);
  // The sum, which is 0 from then on. Nobody may add meanwhile.
  double take(size_t slot) {
    const Slot taken = std::exchange(slots_[slot], {});
    const auto sum = static_cast<Fixed>(static_cast<Unsigned>(taken.high) << 64 | taken.low);
    return static_cast<double>(sum) * 0x1p-64;
  }

  static constexpr size_t bytes_for(size_t slots) { return slots * sizeof(Slot); }

 private:
  __extension__ typedef __int128 Fixed;
  __extension__ typedef unsigned __int128 Unsigned;
  struct Slot {
    uint64_t low = 0, high = 0;
  };

  std::vector<Slot> slots_;
};

}  // namespace etd
