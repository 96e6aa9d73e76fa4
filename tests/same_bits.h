// Expects that two films hold the same bits.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "film/film.h"

namespace etd {

inline void expect_same_light(const PixelSums& a, const PixelSums& b, const std::string& where) {
  ASSERT_EQ(a.count, b.count) << where;
  ASSERT_EQ(a.emission, b.emission) << where;
  ASSERT_EQ(a.direct, b.direct) << where;
  ASSERT_EQ(a.indirect, b.indirect) << where;
  ASSERT_EQ(a.squares, b.squares) << where;
}

inline void expect_same_features(const PixelSums& a, const PixelSums& b, const std::string& where) {
  ASSERT_EQ(a.albedo, b.albedo) << where;
  ASSERT_EQ(a.normal, b.normal) << where;
  ASSERT_EQ(a.depth, b.depth) << where;
  ASSERT_EQ(a.coverage, b.coverage) << where;
  ASSERT_EQ(a.albedo_squares, b.albedo_squares) << where;
  ASSERT_EQ(a.normal_squares, b.normal_squares) << where;
  ASSERT_EQ(a.depth_squares, b.depth_squares) << where;
  ASSERT_EQ(a.rays, b.rays) << where;
}

// All sums of the pixels that both films have: light of each replicate, features of each half. There must be samples.
inline void expect_same_bits(const Film& a, const Film& b) {
  const PixelBounds &ca = a.settings().crop, &cb = b.settings().crop;
  ASSERT_EQ(a.settings().replicates, b.settings().replicates);
  for (int y = std::max(ca.y0, cb.y0); y < std::min(ca.y1, cb.y1); ++y)
    for (int x = std::max(ca.x0, cb.x0); x < std::min(ca.x1, cb.x1); ++x) {
      for (uint32_t r = 0; r < a.settings().replicates; ++r) {
        const std::string where = fmt::format("pixel {},{} replicate {}", x, y, r);
        ASSERT_GT(a.sums(x, y, r).count, 0) << where;
        expect_same_light(a.sums(x, y, r), b.sums(x, y, r), where);
      }
      for (const uint32_t parity : {0u, 1u})
        expect_same_features(a.half(x, y, parity), b.half(x, y, parity), fmt::format("pixel {},{}", x, y));
      ASSERT_EQ(a.total(x, y).rays, b.total(x, y).rays) << fmt::format("pixel {},{}", x, y);
    }
}

}  // namespace etd
