#include "core/windowed_distribution.h"

#include <algorithm>

namespace etd {

namespace {

// Which of n cells x in [0, 1] is in.
int cell_of(double x, int n) { return std::clamp(static_cast<int>(x * n), 0, n - 1); }

// Returns where f, which grows from 0 at lo to f(hi) at hi and is linear between multiples of 1 / n, reaches `target`.
template <class F>
double invert(const F& f, double lo, double hi, int n, double target) {
  double a = lo, b = hi, fa = 0, fb = f(hi);
  // Halve the range of edges between a and b until none is left.
  for (int first = cell_of(lo, n) + 1, last = cell_of(hi, n); first <= last;) {
    const int middle = (first + last) / 2;
    const double x = static_cast<double>(middle) / n;
    if (x <= a || x >= b) break;
    const double fx = f(x);
    if (fx <= target)
      a = x, fa = fx, first = middle + 1;
    else
      b = x, fb = fx, last = middle - 1;
  }
  const double t = fb > fa ? (target - fa) / (fb - fa) : 0.5;
  return std::clamp(a + (b - a) * t, lo, hi);
}

}  // namespace

WindowedDistribution::WindowedDistribution(int width, int height, std::span<const double> densities)
    : width_(width), height_(height), sums_(static_cast<size_t>(width + 1) * static_cast<size_t>(height + 1), 0.0) {
  const double area = 1.0 / (static_cast<double>(width) * height);
  const auto stride = static_cast<size_t>(width + 1);
  for (size_t y = 0; y < static_cast<size_t>(height); ++y) {
    double row = 0;
    for (size_t x = 0; x < static_cast<size_t>(width); ++x) {
      row += densities[y * static_cast<size_t>(width) + x] * area;
      sums_[(y + 1) * stride + x + 1] = sums_[y * stride + x + 1] + row;
    }
  }
}

double WindowedDistribution::sum(double x, double y) const {
  const int i = cell_of(x, width_), j = cell_of(y, height_);
  const double dx = x * width_ - i, dy = y * height_ - j;
  const double above = corner(i, j) + (corner(i + 1, j) - corner(i, j)) * dx;
  const double below = corner(i, j + 1) + (corner(i + 1, j + 1) - corner(i, j + 1)) * dx;
  return above + (below - above) * dy;
}

WindowedDistribution::Point WindowedDistribution::sample(Vec2 u, const Window& w) const {
  const auto columns = [&](double x) { return integral({w.lo, {x, w.hi.y}}); };
  const double x = invert(columns, w.lo.x, w.hi.x, width_, static_cast<double>(u.x) * columns(w.hi.x));
  // Within the column of cells that x is in, the density depends on y alone.
  const int i = cell_of(x, width_);
  const double left = static_cast<double>(i) / width_, right = static_cast<double>(i + 1) / width_;
  const auto rows = [&](double y) { return integral({{left, w.lo.y}, {right, y}}); };
  return {x, invert(rows, w.lo.y, w.hi.y, height_, static_cast<double>(u.y) * rows(w.hi.y))};
}

double WindowedDistribution::pdf(Point p, const Window& w) const {
  const double whole = integral(w);
  if (!(whole > 0.0) || !w.contains(p)) return 0.0;
  const int i = cell_of(p.x, width_), j = cell_of(p.y, height_);
  const double cell = corner(i + 1, j + 1) - corner(i, j + 1) - corner(i + 1, j) + corner(i, j);
  return std::max(0.0, cell) * width_ * height_ / whole;
}

}  // namespace etd
