// What the battery over samplers (verify/battery/sampler.cpp) cannot know: how Sobol's points are made, and what they
// are good for. Everything is deterministic, so a test that passes once passes always.
#include "samplers/sampler.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "core/hash.h"
#include "samplers/owen_sobol.h"
#include "samplers/sampler_list.h"
#include "verify/statistics/statistics.h"

namespace etd {
namespace {

// Chance that a whole test raises a false alarm.
constexpr double kFamily = 1e-6;
const SamplerKind kKinds[] = {SamplerKind(IndependentSampler()), SamplerKind(SobolSampler())};

Sampler started(SamplerKind kind, uint64_t seed, uint64_t stream, uint32_t replicate, uint32_t index,
                uint32_t dimension) {
  Sampler s(kind, seed);
  s.start(stream, replicate, index);
  s.set_dimension(dimension);
  return s;
}

TEST(OwenSobol, SecondDimensionAgreesWithItsDirectionNumbers) {
  // Primitive polynomial x + 1 (Sobol 1967): v_k = v_(k-1) ^ (v_(k-1) >> 1), v_0 = 1/2.
  uint32_t v[32] = {0x80000000u};
  for (int k = 1; k < 32; ++k) v[k] = v[k - 1] ^ (v[k - 1] >> 1);
  HashStream rng(1);
  for (int i = 0; i < 10000; ++i) {
    const uint32_t n = i < 100 ? static_cast<uint32_t>(i) : rng.next_u32();
    uint32_t expected = 0;
    for (int k = 0; k < 32; ++k)
      if (n >> k & 1) expected ^= v[k];
    ASSERT_EQ(reverse_bits(pascal_product(n)), expected) << n;
  }
}

TEST(OwenSobol, ScrambleIsNestedAndShuffleKeepsAlignedBlocks) {
  HashStream rng(2);
  for (int i = 0; i < 2000; ++i) {
    const uint32_t seed = rng.next_u32(), a = rng.next_u32();
    // Two indices that share the low k digits, and differ in digit k, give values that share just the first k digits.
    const uint32_t k = rng.next_u32() % 32;
    const uint32_t b = (a ^ (1u << k)) ^ (k < 31 ? rng.next_u32() << (k + 1) : 0u);
    const uint32_t x = owen_sobol_x(a, seed) ^ owen_sobol_x(b, seed);
    ASSERT_EQ(__builtin_clz(x), static_cast<int>(k));
  }
  for (uint32_t m = 0; m <= 10; ++m) {
    std::set<uint32_t> low;
    std::set<uint32_t> high;
    const uint32_t seed = rng.next_u32(), base = 5u << m;
    for (uint32_t i = base; i < base + (1u << m); ++i) {
      const uint32_t s = shuffled_index(i, seed);
      low.insert(s & ((1u << m) - 1));
      high.insert(s >> m);
    }
    EXPECT_EQ(low.size(), size_t{1} << m);
    EXPECT_EQ(high.size(), 1u);
  }
}

// The order of a padded dimension and its two scrambles come from one hash: none may tell anything of another.
TEST(SobolSampler, OrderAndScramblesOfADimensionAreIndependent) {
  constexpr size_t kKeys = 1 << 15;
  std::vector<double> counts[3], expected(256, double(kKeys) / 256);
  for (auto& c : counts) c.assign(256, 0.0);
  for (uint64_t key = 0; key < kKeys; ++key) {
    const uint64_t h = hash_combine(hash_combine(0, 0, key), 0);
    const auto low = static_cast<uint32_t>(h), high = static_cast<uint32_t>(h >> 32),
               mixed = static_cast<uint32_t>(mix_bits(h));
    const uint32_t order = shuffled_index(0, low) & 15;
    const uint32_t x = owen_sobol_x(0, high) >> 28, y = owen_sobol_y(0, mixed) >> 28;
    ++counts[0][order * 16 + x];
    ++counts[1][order * 16 + y];
    ++counts[2][x * 16 + y];
  }
  for (const auto& c : counts) EXPECT_GT(chi_square_test(c, expected, 5).p_value, sidak_level(kFamily, 3));
}

// The point of it all: of a smooth function, Sobol's error is a small part of that of independent points.
TEST(SobolSampler, IntegratesSmoothFunctionsBetter) {
  RunningStats estimates[2];
  for (size_t k = 0; k < 2; ++k)
    for (uint64_t stream = 0; stream < 500; ++stream) {
      double sum = 0;
      for (uint32_t i = 0; i < 64; ++i) {
        const Vec2 u = started(kKinds[k], 4, stream, 0, i, 0).get_2d();
        sum += double(u.x) * u.y;
      }
      estimates[k].add(sum / 64);
    }
  EXPECT_LT(estimates[1].variance(), 0.01 * estimates[0].variance());
  for (const RunningStats& e : estimates)
    EXPECT_GT(normal_two_sided((e.mean() - 0.25) / std::sqrt(e.variance_of_mean())), kFamily);
}

TEST(Sampler, KindsByName) {
  for (const ModelDecl* decl : sampler_models()) EXPECT_EQ(sampler_kind(decl->name).name(), decl->name);
  EXPECT_EQ(SamplerKind().name(), "sobol");
  EXPECT_EQ(sampler_kind("sobl"), SamplerKind());
}

}  // namespace
}  // namespace etd
