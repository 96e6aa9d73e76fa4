// Sums of light that paths from the lights bring to pixels, from all threads at once. They are kept in fixed point, so
// that the order in which they are added changes no bit.
#pragma once

#include <atomic>
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
  void add(size_t slot, double value) {
    Fixed fixed = static_cast<Fixed>(value);  // towards 0, so that what is left has the same sign and is below 1
    fixed = fixed * (Fixed{1} << 64) + static_cast<Fixed>((value - static_cast<double>(fixed)) * 0x1p64);
    const auto low = static_cast<uint64_t>(fixed), high = static_cast<uint64_t>(fixed >> 64);
    const uint64_t before = std::atomic_ref(slots_[slot].low).fetch_add(low, std::memory_order_relaxed);
    const uint64_t carry = before + low < before ? 1 : 0;
    if (high + carry != 0) std::atomic_ref(slots_[slot].high).fetch_add(high + carry, std::memory_order_relaxed);
  }
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
