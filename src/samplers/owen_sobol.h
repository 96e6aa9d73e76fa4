// The first two dimensions of Sobol's sequence with hash-based Owen scrambling (Burley 2020, "Practical hash-based Owen
// scrambling"). Pairs of dimensions are padded: each has its own shuffled order and scramble.
#pragma once

#include "core/hash.h"

namespace etd {

ETD_FN uint32_t reverse_bits(uint32_t v) {
  v = __builtin_bswap32(v);
  v = ((v & 0x0f0f0f0fu) << 4) | ((v >> 4) & 0x0f0f0f0fu);
  v = ((v & 0x33333333u) << 2) | ((v >> 2) & 0x33333333u);
  return ((v & 0x55555555u) << 1) | ((v >> 1) & 0x55555555u);
}

// A hash whose every output bit depends only on that bit and lower ones: on reversed digits, a nested uniform (Owen)
// scramble. Construction by Laine and Karras 2011, constants by Vegdahl 2021.
ETD_FN uint32_t laine_karras(uint32_t v, uint32_t seed) {
  v ^= v * 0x3d20adeau;
  v += seed;
  v *= (seed >> 16) | 1u;
  v ^= v * 0x05526c56u;
  return v ^ (v * 0x53a22864u);
}

// The digits of Sobol's second dimension, least significant bit first: the index times the Pascal matrix modulo 2,
// which is a Kronecker power of [1 1; 0 1] and so takes one step per level.
ETD_FN uint32_t pascal_product(uint32_t n) {
  n ^= (n >> 16) & 0x0000ffffu;
  n ^= (n >> 8) & 0x00ff00ffu;
  n ^= (n >> 4) & 0x0f0f0f0fu;
  n ^= (n >> 2) & 0x33333333u;
  return n ^ ((n >> 1) & 0x55555555u);
}

// The order of a padded dimension: an Owen scramble of the index keeps every power-of-two prefix aligned.
ETD_FN uint32_t shuffled_index(uint32_t index, uint32_t seed) {
  return reverse_bits(laine_karras(reverse_bits(index), seed));
}

// 32 binary digits of the scrambled value of `index`, most significant first.
ETD_FN uint32_t owen_sobol_x(uint32_t index, uint32_t seed) { return reverse_bits(laine_karras(index, seed)); }
ETD_FN uint32_t owen_sobol_y(uint32_t index, uint32_t seed) {
  return reverse_bits(laine_karras(pascal_product(index), seed));
}

}  // namespace etd
