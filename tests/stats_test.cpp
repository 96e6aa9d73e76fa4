#include "render/stats.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "render/interrupt.h"
#include "render/memory.h"

namespace etd {
namespace {

TEST(Stats, CountsPathsAndRaysOfPixels) {
  Film film({.width = 2, .height = 1, .crop = {0, 0, 2, 1}, .replicates = 2});
  PixelSample s;
  s.rays = {1, 2, 3};
  PixelSums sums;
  sums.add(s);
  film.add(0, 0, 0, sums);
  film.add(0, 0, 1, sums);
  film.add(1, 0, 0, sums);
  RenderStats stats;
  count_pixels(film, stats);
  EXPECT_EQ(stats.paths, 3u);
  EXPECT_EQ(stats.rays_per_pixel_mean, 9.0);
  EXPECT_EQ(stats.rays_per_pixel_max, 12.0);
}

TEST(Stats, JsonHasTheDocumentedForm) {
  RenderStats stats;
  stats.load_seconds = 0.5, stats.build_seconds = 1.5, stats.render_seconds = 2.5;
  stats.first_pass_seconds = 0.25;
  stats.rays = {1, 2, 1ull << 40};
  stats.rays_per_pixel_mean = 9.25, stats.rays_per_pixel_max = 12;
  stats.invalid = {3, 2, 1, {}};
  stats.paths = 7, stats.peak_bytes = peak_memory_bytes(), stats.spp = 64;
  stats.load_peak_bytes = 5, stats.geometry_bytes = 2, stats.accelerator_bytes = 1ull << 40;
  EXPECT_GT(stats.peak_bytes, 1u << 20);
  const auto json = nlohmann::json::parse(stats_json(stats));
  EXPECT_EQ(json.size(), 9u);
  EXPECT_EQ(json["seconds"]["load"], 0.5);
  EXPECT_EQ(json["seconds"]["build"], 1.5);
  EXPECT_EQ(json["seconds"]["first_pass"], 0.25);
  EXPECT_EQ(json["seconds"]["render"], 2.5);
  EXPECT_EQ(json["rays"]["camera"], 1);
  EXPECT_EQ(json["rays"]["indirect"], 2);
  EXPECT_EQ(json["rays"]["shadow"], 1ull << 40);
  EXPECT_EQ(json["rays_per_pixel"]["mean"], 9.25);
  EXPECT_EQ(json["rays_per_pixel"]["max"], 12);
  EXPECT_EQ(json["invalid"]["nan"], 3);
  EXPECT_EQ(json["invalid"]["infinite"], 2);
  EXPECT_EQ(json["invalid"]["negative"], 1);
  EXPECT_EQ(json["paths"], 7);
  EXPECT_EQ(json["peak_bytes"], stats.peak_bytes);
  EXPECT_EQ(json["memory"]["load_peak"], 5);
  EXPECT_EQ(json["memory"]["geometry"], 2);
  EXPECT_EQ(json["memory"]["accelerator"], 1ull << 40);
  EXPECT_EQ(json["spp"], 64);
}

}  // namespace
}  // namespace etd
