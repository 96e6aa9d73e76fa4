// Numbers as text, for readers that meet millions of them. What is read here has the same bits as std::from_chars gives
// it, in 60 to 90 % of the time (docs/performance.md); what is not is left to that function.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace etd {

// Reads the decimal number that begins at `at`, "-12.5e-3", and returns where it ends, or null when it must be read in
// another way: because it is none, or is one that two exact doubles and one operation do not give. Digits that make a
// whole number up to 2^53 are exact, and so are powers of ten up to 10^22: their product or quotient is the number
// rounded once (Clinger 1990, "How to read floating point numbers accurately"). The number is never infinite.
inline const char* read_decimal(const char* at, const char* end, double& number) {
  constexpr std::array<double, 23> kPowers = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                              1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  constexpr std::ptrdiff_t kMostDigits = 18;  // that 64 bits always hold
  uint64_t digits = 0;
  const auto read_digits = [&] {
    const char* const begin = at;
    for (; at != end && static_cast<unsigned char>(*at - '0') < 10; ++at)
      digits = 10 * digits + static_cast<unsigned char>(*at - '0');
    return at - begin;
  };
  const bool negative = at != end && *at == '-';
  if (negative) ++at;
  std::ptrdiff_t count = read_digits(), exponent = 0;
  if (at != end && *at == '.') {
    ++at;
    exponent = -read_digits();
    count -= exponent;
  }
  if (count == 0 || count > kMostDigits || digits > uint64_t{1} << 53) return nullptr;
  if (at != end && (*at == 'e' || *at == 'E')) {
    ++at;
    const bool below = at != end && *at == '-';
    if (at != end && (*at == '-' || *at == '+')) ++at;
    std::ptrdiff_t power = 0;
    const char* const begin = at;
    for (; at != end && at - begin < 3 && static_cast<unsigned char>(*at - '0') < 10; ++at)
      power = 10 * power + (*at - '0');
    if (at == begin) return nullptr;
    exponent += below ? -power : power;
  }
  if (exponent < -22 || exponent > 22) return nullptr;
  number = static_cast<double>(digits);
  number =
      exponent < 0 ? number / kPowers[static_cast<size_t>(-exponent)] : number * kPowers[static_cast<size_t>(exponent)];
  if (negative) number = -number;
  return at;
}

// The same for a whole number of up to nine digits.
inline const char* read_whole(const char* at, const char* end, int32_t& number) {
  constexpr std::ptrdiff_t kMostDigits = 9;  // that 32 bits always hold
  const bool negative = at != end && *at == '-';
  if (negative) ++at;
  const char* const begin = at;
  int32_t digits = 0;
  for (; at != end && at - begin < kMostDigits && static_cast<unsigned char>(*at - '0') < 10; ++at)
    digits = 10 * digits + (*at - '0');
  if (at == begin) return nullptr;
  number = negative ? -digits : digits;
  return at;
}

}  // namespace etd
