#include "verify/statistics/compare_films.h"

#include <fmt/format.h>

#include <algorithm>

namespace etd {

namespace {
const char* const kQuantities[] = {"beauty.R", "beauty.G", "beauty.B", "direct", "indirect"};
}  // namespace

uint64_t film_test_count(int width, int height) {
  const auto blocks = [](int n) { return static_cast<uint64_t>((n + kFilmBlock - 1) / kFilmBlock); };
  return std::size(kQuantities) + blocks(width) * blocks(height);
}

std::vector<FilmTest> compare_films(const Film& a, const Film& b, double planted) {
  std::vector<FilmTest> tests;
  const auto add = [&](std::string what, const PixelBounds& region, const Quantity& q) {
    const RunningStats sa = region_mean(a, region, q), sb = region_mean(b, region, q, planted);
    tests.push_back({std::move(what), region, sa, sb, welch_test(sa, sb)});
  };
  const PixelBounds& all = a.settings().crop;
  for (const char* q : kQuantities) add(fmt::format("image, {}", q), all, *parse_quantity(q));
  for (int y = all.y0; y < all.y1; y += kFilmBlock)
    for (int x = all.x0; x < all.x1; x += kFilmBlock)
      add(fmt::format("block {},{}", x, y), {x, y, std::min(x + kFilmBlock, all.x1), std::min(y + kFilmBlock, all.y1)},
          {});
  return tests;
}

}  // namespace etd
