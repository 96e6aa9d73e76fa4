#include "render/estimated_error.h"

#include <vector>

#include "render/items.h"

namespace etd {
namespace {

struct RowSums {
  double luminance = 0, error = 0;
};

}  // namespace

double estimated_error(const Film& film, Workers& workers) {
  const PixelBounds& crop = film.settings().crop;
  if (crop.empty()) return 0;
  const double pixels = static_cast<double>(crop.width()) * crop.height();
  // Sums by row, added in the order of rows: the same for any number of threads.
  std::vector<RowSums> rows(static_cast<size_t>(crop.height()));
  for_each_item(workers, rows.size(), [&](size_t row) {
    const int y = crop.y0 + static_cast<int>(row);
    for (int x = crop.x0; x < crop.x1; ++x) rows[row].luminance += film.light(x, y).mean_radiance()[3];
  });
  double mean = 0;
  for (const RowSums& row : rows) mean += row.luminance / pixels;
  const double floor = 0.01 * sqr(mean);
  for_each_item(workers, rows.size(), [&](size_t row) {
    const int y = crop.y0 + static_cast<int>(row);
    for (int x = crop.x0; x < crop.x1; ++x) {
      const double variance = sqr(film.standard_error(x, y)[3]);
      if (variance != 0) rows[row].error += variance / (sqr(film.light(x, y).mean_radiance()[3]) + floor);
    }
  });
  double sum = 0;
  for (const RowSums& row : rows) sum += row.error;
  return std::sqrt(sum / pixels);
}

double estimated_error(const Film& film, int threads) {
  Workers workers(threads);
  return estimated_error(film, workers);
}

}  // namespace etd
