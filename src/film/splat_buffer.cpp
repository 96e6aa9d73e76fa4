#include "film/splat_buffer.h"

#include <atomic>

namespace etd {

void SplatBuffer::add(size_t slot, double value) {
  Fixed fixed = static_cast<Fixed>(value);  // towards 0, so that what is left has the same sign and is below 1
  fixed = fixed * (Fixed{1} << 64) + static_cast<Fixed>((value - static_cast<double>(fixed)) * 0x1p64);
  const auto low = static_cast<uint64_t>(fixed), high = static_cast<uint64_t>(fixed >> 64);
  const uint64_t before = std::atomic_ref(slots_[slot].low).fetch_add(low, std::memory_order_relaxed);
  const uint64_t carry = before + low < before ? 1 : 0;
  if (high + carry != 0) std::atomic_ref(slots_[slot].high).fetch_add(high + carry, std::memory_order_relaxed);
}

}  // namespace etd
