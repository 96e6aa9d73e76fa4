// The samplers: stratification that must hold exactly, and uniformity and independence as tests with stated levels of
// false alarm. Everything is deterministic, so a test that passes once passes always.
#include "samplers/sampler.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "core/hash.h"
#include "samplers/owen_sobol.h"
#include "verify/statistics.h"

namespace etd {
namespace {

// Chance that a whole test raises a false alarm.
constexpr double kFamily = 1e-6;
constexpr SamplerKind kKinds[] = {SamplerKind::kIndependent, SamplerKind::kSobol};

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

// Every box of the form [i/2^a, (i+1)/2^a) x [j/2^b, (j+1)/2^b) with a + b = m holds one of 2^m points.
TEST(SobolSampler, AlignedBlocksArePointSetsOfTheBestQuality) {
  for (uint32_t run = 0; run < 24; ++run) {
    for (uint32_t m = 0; m <= 9; ++m) {
      const uint32_t n = 1u << m, first = run % 3 * n;
      std::vector<Vec2> points;
      for (uint32_t i = first; i < first + n; ++i)
        points.push_back(started(SamplerKind::kSobol, run, 77 * run, run % 2, i, run).get_2d());
      for (uint32_t a = 0; a <= m; ++a) {
        std::vector<int> count(n, 0);
        for (const Vec2 p : points) {
          const auto column = static_cast<uint32_t>(p.x * static_cast<float>(1u << a));
          const auto row = static_cast<uint32_t>(p.y * static_cast<float>(1u << (m - a)));
          ASSERT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
          ++count[column << (m - a) | row];
        }
        for (const int c : count) ASSERT_EQ(c, 1) << "run " << run << ", 2^" << m << " points, a = " << a;
      }
    }
  }
}

TEST(SobolSampler, OneDimensionIsStratified) {
  for (uint32_t run = 0; run < 50; ++run) {
    const uint32_t n = 256, first = run * n;
    std::set<int> strata, choice_strata;
    for (uint32_t i = first; i < first + n; ++i) {
      strata.insert(static_cast<int>(started(SamplerKind::kSobol, 3, run, 0, i, 5).get_1d() * n));
      choice_strata.insert(static_cast<int>(started(SamplerKind::kSobol, 3, run, 0, i, 5).get_choice() * n));
    }
    EXPECT_EQ(strata.size(), n);
    EXPECT_EQ(choice_strata.size(), n);
  }
}

// For a fixed index, the scramble alone makes the value uniform: what unbiasedness rests on.
TEST(Sampler, EveryIndexIsUniformOverStreams) {
  constexpr int kStreams = 1 << 15, kCells = 64;
  const uint32_t indices[] = {0, 1, 2, 7, 1000, 0xffffffffu};
  const double level = sidak_level(kFamily, 2 * 6 * 4);
  for (const SamplerKind kind : kKinds)
    for (const uint32_t index : indices) {
      std::vector<double> counts[4], expected(kCells, double(kStreams) / kCells);
      for (auto& c : counts) c.assign(kCells, 0.0);
      for (uint64_t stream = 0; stream < kStreams; ++stream) {
        const Vec2 xy = started(kind, 0, stream, 0, index, 0).get_2d();
        const double values[4] = {xy.x, xy.y, started(kind, 0, stream, 0, index, 1).get_1d(),
                                  started(kind, 0, stream, 0, index, 2).get_choice()};
        for (size_t v = 0; v < 4; ++v) ++counts[v][static_cast<size_t>(values[v] * kCells)];
      }
      for (const auto& c : counts) EXPECT_GT(chi_square_test(c, expected, 5).p_value, level) << index;
    }
}

// Numbers of different pixels, replicates, indices and dimensions, drawn together many times: every pair of them must
// be independent, as their joint histogram tells. Of one dimension of one stream, Sobol's points for different indices
// are meant to depend on each other, and are left out.
TEST(Sampler, EverythingElseIsIndependent) {
  constexpr size_t kDraws = 8192, kVariables = 48, kCells = 8;
  struct Origin {
    uint32_t pixel, replicate, index, dimension;
  };
  for (const SamplerKind kind : kKinds) {
    std::vector<Origin> origins;
    std::vector<std::vector<uint8_t>> cells(kVariables, std::vector<uint8_t>(kDraws));
    for (uint32_t pixel = 0; pixel < 2; ++pixel)
      for (uint32_t replicate = 0; replicate < 2; ++replicate)
        for (uint32_t index = 0; index < 2; ++index)
          for (uint32_t dimension = 0; dimension < 3; ++dimension) {
            for (size_t draw = 0; draw < kDraws; ++draw) {
              const Vec2 u = started(kind, 0, 2 * draw + pixel, replicate, index, dimension).get_2d();
              cells[origins.size()][draw] = static_cast<uint8_t>(u.x * kCells);
              cells[origins.size() + 1][draw] = static_cast<uint8_t>(u.y * kCells);
            }
            origins.insert(origins.end(), 2, {pixel, replicate, index, dimension});
          }
    ASSERT_EQ(origins.size(), kVariables);
    const double level = bonferroni_level(kFamily, kVariables * kVariables / 2);
    const std::vector<double> expected(kCells * kCells, double(kDraws) / (kCells * kCells));
    for (size_t a = 0; a < kVariables; ++a)
      for (size_t b = a + 1; b < kVariables; ++b) {
        const Origin &o = origins[a], &p = origins[b];
        if (o.pixel == p.pixel && o.replicate == p.replicate && o.dimension == p.dimension && o.index != p.index)
          continue;
        std::vector<double> counts(kCells * kCells, 0.0);
        for (size_t draw = 0; draw < kDraws; ++draw) ++counts[cells[a][draw] * kCells + cells[b][draw]];
        ASSERT_GT(chi_square_test(counts, expected, 5).p_value, level) << a << " and " << b;
      }
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

TEST(Sampler, SeedsAndReplicatesNeverShareNumbers) {
  std::set<uint64_t> keys;
  for (uint64_t seed = 0; seed < 64; ++seed)
    for (uint32_t replicate = 0; replicate < 512; ++replicate)
      keys.insert(started(SamplerKind::kIndependent, seed, 0, replicate, 0, 0).key(0));
  EXPECT_EQ(keys.size(), 64u * 512u);
}

TEST(Sampler, NumbersDependOnNothingButTheirPlace) {
  for (const SamplerKind kind : kKinds) {
    Sampler forwards(kind, 9), again(kind, 9);
    for (uint32_t index = 0; index < 50; ++index) {
      forwards.start(1234, 1, index);
      const float a = forwards.get_1d();
      const Vec2 b = forwards.get_2d();
      const Vec3 c = forwards.get_3d();  // two dimensions
      const double d = forwards.get_choice();
      again.start(99, 0, 3);
      again.get_2d();
      again.start(1234, 1, index);
      again.set_dimension(4);
      EXPECT_EQ(again.get_choice(), d);
      again.set_dimension(2);
      EXPECT_EQ(again.get_3d(), c);
      again.set_dimension(1);
      EXPECT_EQ(again.get_2d(), b);
      again.set_dimension(0);
      EXPECT_EQ(again.get_1d(), a);
    }
  }
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
  EXPECT_EQ(sampler_kind("independent"), SamplerKind::kIndependent);
  EXPECT_EQ(sampler_kind("sobol"), SamplerKind::kSobol);
  EXPECT_EQ(sampler_models().size(), 2u);
}

}  // namespace
}  // namespace etd
