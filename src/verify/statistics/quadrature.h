// Integrals over rectangles with an error under control: the deterministic side of the comparisons with samples.
#pragma once

#include <array>
#include <cmath>

namespace etd {

struct Rect {
  double x0, x1, y0, y1;
};

namespace detail {

template <size_t N>
using Values = std::array<double, N>;

// Tensor product of the Gauss-Legendre rule with three nodes.
template <size_t N, class F>
Values<N> gauss_rect(F& f, const Rect& r) {
  static constexpr double kNode[3] = {-0.7745966692414834, 0.0, 0.7745966692414834};
  static constexpr double kWeight[3] = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
  const double cx = 0.5 * (r.x0 + r.x1), hx = 0.5 * (r.x1 - r.x0), cy = 0.5 * (r.y0 + r.y1), hy = 0.5 * (r.y1 - r.y0);
  Values<N> sum{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Values<N> v = f(cx + hx * kNode[i], cy + hy * kNode[j]);
      for (size_t n = 0; n < N; ++n) sum[n] += kWeight[i] * kWeight[j] * hx * hy * v[n];
    }
  }
  return sum;
}

template <size_t N, class F>
Values<N> refine_rect(F& f, const Rect& r, const Values<N>& coarse, double absolute, double relative, int forced,
                      int depth) {
  const double mx = 0.5 * (r.x0 + r.x1), my = 0.5 * (r.y0 + r.y1);
  const Rect quarters[4] = {{r.x0, mx, r.y0, my}, {mx, r.x1, r.y0, my}, {r.x0, mx, my, r.y1}, {mx, r.x1, my, r.y1}};
  Values<N> parts[4], fine{};
  for (int q = 0; q < 4; ++q) {
    parts[q] = gauss_rect<N>(f, quarters[q]);
    for (size_t n = 0; n < N; ++n) fine[n] += parts[q][n];
  }
  bool converged = true;
  for (size_t n = 0; n < N; ++n) converged &= std::abs(fine[n] - coarse[n]) <= absolute + relative * std::abs(fine[n]);
  if ((converged && forced <= 0) || depth == 0) return fine;
  fine = {};
  for (int q = 0; q < 4; ++q) {
    const Values<N> v = refine_rect<N>(f, quarters[q], parts[q], 0.5 * absolute, relative, forced - 1, depth - 1);
    for (size_t n = 0; n < N; ++n) fine[n] += v[n];
  }
  return fine;
}

}  // namespace detail

// The integrals over r of the N functions f(x, y) -> std::array<double, N>: splits in four until a split changes each
// by less than absolute + relative * value, at most `depth` times. A feature narrower than the first nodes are apart
// can be missed, as can a jump that cuts off a corner: choose r by where the function is, and split `forced` more times
// before trusting the comparison where it has jumps.
template <size_t N, class F>
std::array<double, N> integrate_rect(F&& f, const Rect& r, double absolute, double relative, int forced = 0,
                                     int depth = 10) {
  return detail::refine_rect<N>(f, r, detail::gauss_rect<N>(f, r), absolute, relative, forced, depth);
}

}  // namespace etd
