// Stateless randomness: a sample is a pure function of who asks for it, so everything random starts from a hash.
#pragma once

#include "core/math.h"

namespace etd {

// Finaliser of splitmix64 (Steele, Lea and Flood 2014, constants by Stafford "Mix13"): a bijection of 64 bits.
ETD_FN uint64_t mix_bits(uint64_t v) {
  v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9ull;
  v = (v ^ (v >> 27)) * 0x94d049bb133111ebull;
  return v ^ (v >> 31);
}

// The hash of a pair. Multiples of the golden ratio keep away from each other modulo 2^64, so pairs of small numbers,
// such as a seed and a replicate, never meet: seeds that differ by less than 2^31 stay at least 2^32 apart.
ETD_FN uint64_t hash_combine(uint64_t seed, uint64_t value) {
  return mix_bits((seed + 1) * 0x9e3779b97f4a7c15ull + value);
}

template <class... Rest>
ETD_FN uint64_t hash_combine(uint64_t seed, uint64_t value, Rest... rest) {
  return hash_combine(hash_combine(seed, value), static_cast<uint64_t>(rest)...);
}

// A counter-based stream of uniform numbers: number i of the stream with key k is mix(k + i * odd). Stochastic closures
// receive one keyed by (path, vertex), so evaluating them does not disturb the sampler's dimensions.
class HashStream {
 public:
  explicit HashStream(uint64_t key) : state_(key) {}
  uint32_t next_u32() { return static_cast<uint32_t>(mix_bits(state_ += 0x9e3779b97f4a7c15ull) >> 32); }
  float next_float() { return unit_float(next_u32()); }

 private:
  uint64_t state_;
};

}  // namespace etd
