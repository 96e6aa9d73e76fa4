#include "textures/pyramid.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

namespace etd {
namespace {

// The integral of the cubic from 0 to x; the whole is 1, half of it on each side.
double integral(double x) {
  const double u = std::min(std::abs(x), 2.0);
  const double inner = [](double v) { return v * (16.0 / 3 + v * v * (-4 + v * 7.0 / 4)) / 6; }(std::min(u, 1.0));
  const auto outer = [](double v) { return v * (32.0 / 3 + v * (-10 + v * (4 - v * 7.0 / 12))) / 6; };
  return std::copysign(u <= 1.0 ? inner : inner + outer(u) - outer(1.0), x);
}

// What of the finer texels `first`, `first` + 1, ... makes one coarser texel.
struct Taps {
  int first;
  std::vector<float> weights;
};

std::vector<Taps> taps_of(int fine, int coarse) {
  std::vector<Taps> all;
  const double ratio = static_cast<double>(fine) / coarse;
  for (int i = 0; i < coarse; ++i) {
    if (fine == coarse) {
      all.push_back({i, {1.0f}});
      continue;
    }
    const double center = (i + 0.5) * ratio;
    Taps taps{static_cast<int>(std::floor(center - 2 * ratio)), {}};
    for (int j = taps.first; j < center + 2 * ratio; ++j)
      taps.weights.push_back(static_cast<float>(integral((j + 1 - center) / ratio) - integral((j - center) / ratio)));
    all.push_back(std::move(taps));
  }
  return all;
}

using Row = std::vector<float>;

// Rows of the finer level, filtered along x. Those needed again soon are kept.
class FilteredRows {
 public:
  FilteredRows(const Image& level, ImageWrap wrap, int width)
      : level_(level), wrap_(wrap), width_(width), taps_(taps_of(level.width(), width)) {}

  // Row y, which may be outside; null: black.
  const Row* row(int y) {
    const int height = level_.height();
    const bool backwards = wrap_ == ImageWrap::kOctahedralSphere && (y < 0 || y >= height);
    int x_unused = 0, source = y;
    if (!wrap_texel(x_unused, source, 1, height, wrap_)) return nullptr;
    const int key = backwards ? -1 - source : source;
    for (const auto& [kept, values] : rows_)
      if (kept == key) return &values;
    if (rows_.size() == kKept) rows_.pop_front();
    rows_.emplace_back(key, filtered(source));
    if (backwards) reverse(rows_.back().second);
    return &rows_.back().second;
  }

 private:
  static constexpr size_t kKept = 16;  // more than the taps of one coarser texel

  Row filtered(int y) const {
    const int channels = level_.channels();
    Row out(static_cast<size_t>(width_) * static_cast<size_t>(channels));
    for (int i = 0; i < width_; ++i) {
      const Taps& taps = taps_[static_cast<size_t>(i)];
      float* to = &out[static_cast<size_t>(i) * static_cast<size_t>(channels)];
      for (size_t k = 0; k < taps.weights.size(); ++k) {
        int x = taps.first + static_cast<int>(k), source = y;
        if (!wrap_texel(x, source, level_.width(), level_.height(), wrap_)) continue;
        for (int c = 0; c < channels; ++c) to[c] += taps.weights[k] * level_.texel(x, source, c);
      }
    }
    return out;
  }

  void reverse(Row& row) const {
    const auto channels = static_cast<size_t>(level_.channels());
    for (size_t a = 0, b = static_cast<size_t>(width_) - 1; a < b; ++a, --b)
      std::swap_ranges(&row[a * channels], &row[a * channels] + channels, &row[b * channels]);
  }

  const Image& level_;
  ImageWrap wrap_;
  int width_;
  std::vector<Taps> taps_;
  std::deque<std::pair<int, Row>> rows_;
};

}  // namespace

Image coarser_level(const Image& level, ImageWrap wrap) {
  const int width = std::max(1, level.width() / 2), height = std::max(1, level.height() / 2);
  const size_t row_size = static_cast<size_t>(width) * static_cast<size_t>(level.channels());
  const bool halves = level.format().kind() != TexelFormat::Kind::kFloat;
  std::vector<uint16_t> half_texels;
  std::vector<float> float_texels;
  FilteredRows rows(level, wrap, width);
  Row sum(row_size);
  for (const Taps& taps : taps_of(level.height(), height)) {
    std::fill(sum.begin(), sum.end(), 0.0f);
    for (size_t k = 0; k < taps.weights.size(); ++k)
      if (const Row* row = rows.row(taps.first + static_cast<int>(k)))
        for (size_t i = 0; i < row_size; ++i) sum[i] += taps.weights[k] * (*row)[i];
    for (const float v : sum) {
      if (halves)
        half_texels.push_back(float_to_half(v));
      else
        float_texels.push_back(v);
    }
  }
  return halves ? Image(width, height, level.channels(), half_texels)
                : Image(width, height, level.channels(), float_texels);
}

std::vector<Image> coarser_levels(const Image& finest, ImageWrap wrap) {
  std::vector<Image> levels;
  const Image* last = &finest;
  levels.reserve(32);  // the loop keeps a pointer into it
  while (last->width() > 1 || last->height() > 1) last = &levels.emplace_back(coarser_level(*last, wrap));
  return levels;
}

}  // namespace etd
