// Pixel filters in rendered pictures: an edge must come out as the filter's integral over the bright side, also where
// the filter is negative, and the errors that the film tells must be the true ones.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "filters/filter.h"
#include "model_uses.h"
#include "render_helper.h"

namespace etd {
namespace {

constexpr int kWidth = 24;
constexpr double kEdge = 12.3;  // bright from here to the right, in pixels
constexpr uint32_t kReplicates = 32;

const char* const kFilters[] = {"\"box\"",      "\"box\" \"float xradius\" 1.3",
                                "\"triangle\"", "\"gaussian\"",
                                "\"mitchell\"", "\"mitchell\" \"float B\" 0 \"float C\" 0.5",
                                "\"sinc\"",     "\"sinc\" \"float xradius\" 6 \"float tau\" 6"};

Film render_edge(const std::string& filter, const std::string& sampler, uint32_t spp) {
  RenderOverrides o;
  o.spp = spp;
  o.replicates = kReplicates;
  o.sampler = sampler;
  return render_text(fmt::format("Integrator \"path\" \"integer maxdepth\" 0\n"
                                 "Film \"rgb\" \"integer xresolution\" {0} \"integer yresolution\" 2\nPixelFilter {1}\n"
                                 "Camera \"orthographic\" \"float screenwindow\" [ 0 {0} 2 0 ]\nWorldBegin\n"
                                 "AreaLightSource \"diffuse\" \"rgb L\" [ 1 1 1 ] \"bool twosided\" true\n"
                                 "Shape \"trianglemesh\" \"point3 P\" [ {2} -99 1  99 -99 1  99 99 1  {2} 99 1 ]\n"
                                 "\"integer indices\" [ 0 1 2  0 2 3 ]\n",
                                 kWidth, filter, kEdge),
                     "tests/scenes/closed", o);
}

// The filter as the text above describes it.
Filter filter_of(const std::string& text) {
  const auto value = [&](const char* name) -> std::optional<double> {
    const size_t at = text.find(std::string(" ") + name + "\"");
    if (at == std::string::npos) return {};
    return std::stod(text.substr(text.find('"', at) + 1));
  };
  ModelUse use = use_of(text.substr(1, text.find('"', 1) - 1));
  for (const char* name : {"xradius", "tau", "B", "C"})
    if (const auto v = value(name)) use.params.push_back(number(name, *v));
  Diagnostics diagnostics;
  return make_filter(use, diagnostics);
}

// Integral of the filter (or its absolute value) over x > from, divided by that of the filter over all x.
double share_beyond(const Filter& f, double from, bool absolute = false) {
  constexpr int kSteps = 20000;
  const double r = f.radius().x;
  double all = 0, beyond = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double x = (2 * (i + 0.5) / kSteps - 1) * r, v = f.eval({static_cast<float>(x), 0});
    all += v;
    if (x > from) beyond += absolute ? std::abs(v) : v;
  }
  return beyond / all;
}

// 24 columns, 8 filters: false alarms of all t-tests together are below 2e-6.
TEST(StatisticalReconstruction, EdgesAreConvolvedWithTheFilter) {
  constexpr double kLevel = 1e-8;
  for (const std::string filter : kFilters) {
    const Film film = render_edge(filter, "sobol", 1024 * kReplicates);
    const Filter f = filter_of(filter);
    double largest_error = 0;
    for (int x = 0; x < kWidth; ++x) {
      const double expected = share_beyond(f, kEdge - (x + 0.5));
      RunningStats radiance;
      for (uint32_t r = 0; r < kReplicates; ++r) radiance.add(film.sums(x, 0, r).mean_radiance()[1]);
      const double slack = 1e-3;  // of the quadrature, and of tails that no sample has met
      const TestResult test = t_test(radiance, std::clamp(radiance.mean(), expected - slack, expected + slack));
      EXPECT_GT(test.p_value, kLevel) << filter << " column " << x << ": " << radiance.mean() << " +- "
                                      << std::sqrt(radiance.variance_of_mean()) << ", expected " << expected;
      // What covers a pixel shines with radiance 1, and is filtered in the same way.
      const PixelSums all = film.total(x, 0);
      EXPECT_NEAR(all.coverage / all.count, all.mean_radiance()[1], 1e-6) << filter << " column " << x;
      largest_error = std::max(largest_error, std::sqrt(radiance.variance_of_mean()));
    }
    EXPECT_LT(largest_error, 0.01) << filter;  // an error of a tenth of the edge would be seen
  }
}

// With independent samples the error of the mean is known: samples weigh +-s on the bright side and 0 on the other,
// where s = integral |f| / integral f, so Var = s integral_bright |f| - mean^2. What the film says, from the spread of
// 32 replicates, has a relative standard deviation of sqrt(2/31) in a pixel; the pixels' sum must agree within five of
// its own, a false alarm in 1e-6.
TEST(StatisticalReconstruction, ErrorsCountNegativeLobes) {
  constexpr uint32_t kSpp = 32 * kReplicates;
  for (const std::string filter : kFilters) {
    const Film film = render_edge(filter, "independent", kSpp);
    const Filter f = filter_of(filter);
    const double size_y = [&] {  // the filter's y axis is its x axis with the default radius
      double all = 0, absolute = 0;
      for (int i = 0; i < 4000; ++i) {
        const double v = f.eval({0, static_cast<float>((2 * (i + 0.5) / 4000 - 1) * f.radius().y)});
        all += v;
        absolute += std::abs(v);
      }
      return absolute / all;
    }();
    const double size = share_beyond(f, -1e9, true) * size_y;
    double measured = 0, expected = 0, squares = 0;
    for (int x = 0; x < kWidth; ++x) {
      const double from = kEdge - (x + 0.5);
      const double mean = share_beyond(f, from);
      const double variance = (size * share_beyond(f, from, true) * size_y - sqr(mean)) / kSpp;
      expected += variance;
      squares += sqr(variance);
      for (int y = 0; y < 2; ++y) measured += sqr(film.standard_error(x, y)[1]) / 2;
    }
    EXPECT_NEAR(measured, expected, 5 * std::sqrt(2.0 / (kReplicates - 1) * squares / 2)) << filter;
  }
}

}  // namespace
}  // namespace etd
