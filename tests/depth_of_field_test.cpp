// Circles of confusion against the thin-lens formula: the image of a small square light out of focus is the square
// blurred by the lens's opening, scaled. Its flux, centre and second moments follow in closed form.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "render_helper.h"

namespace etd {
namespace {

constexpr int kSide = 48;
constexpr uint32_t kReplicates = 16;
constexpr double kLensRadius = 0.25, kFocus = 2.0;

// Means over the unit opening: of x and y, and of their squares.
struct Opening {
  const char* name;
  const char* params;
  Vec2T<double> mean, square;
};

// A regular polygon has E[r^2] = (2 + cos(2 pi / n)) / 6, a star of n corners at radius a and n at b has
// (a^2 + b^2 + a b cos(pi / n)) / 6; half of it along each axis. The image is 1 0 over 2 1.
const Opening kOpenings[] = {
    {"round", "", {0, 0}, {0.25, 0.25}},
    {"triangle", "\"integer blades\" 3", {0, 0}, {0.125, 0.125}},
    {"seven blades, turned", "\"integer blades\" 7 \"float bladerotation\" 31", {0, 0}, {0.2186241, 0.2186241}},
    {"square", "\"string aperture\" \"square\"", {0, 0}, {1.0 / 12, 1.0 / 12}},
    {"star", "\"string aperture\" \"star\"", {0, 0}, {0.1212542, 0.1212542}},
    {"image", "\"string aperture\" \"parts/corner_aperture.pfm\"", {-0.25, -0.25}, {1.0 / 3, 1.0 / 3}}};

struct Case {
  bool perspective;
  double depth;  // of the light
};

// Half the light's side on the film is 3 pixels, and a point's blur has a radius of 9 (signed: upside down before the
// plane in focus), in units in which the film goes from -1 to 1.
std::string scene(const Case& c, const Opening& opening, double& blur) {
  const double half = 3.0 / (kSide / 2);  // on the film
  const double side = c.perspective ? half * c.depth : half;
  blur = c.perspective ? kLensRadius * (1 / kFocus - 1 / c.depth) : kLensRadius * (c.depth / kFocus - 1);
  // Scaled so that the blur is 9 pixels wide whatever the depth.
  const double radius = kLensRadius * 9.0 / (kSide / 2) / std::abs(blur);
  blur = std::copysign(9.0, blur);
  return fmt::format(
      "Integrator \"path\" \"integer maxdepth\" 0\n"
      "Film \"rgb\" \"integer xresolution\" {0} \"integer yresolution\" {0}\nPixelFilter \"box\"\n"
      "Camera \"{1}\" \"float lensradius\" {2} \"float focaldistance\" {3} {4}\nWorldBegin\n"
      "AreaLightSource \"diffuse\" \"rgb L\" [ 1 1 1 ] \"bool twosided\" true\n"
      "Shape \"trianglemesh\" \"point3 P\" [ -{5} -{5} {6}  {5} -{5} {6}  {5} {5} {6}  -{5} {5} {6} ]\n"
      "\"integer indices\" [ 0 1 2  0 2 3 ]\n",
      kSide, c.perspective ? "perspective" : "orthographic", radius, kFocus, opening.params, side, c.depth);
}

// The sum over pixels of value * weight(x, y), replicate by replicate; x right, y up from the middle.
template <class F>
RunningStats sum_over_pixels(const Film& film, F&& weight) {
  RunningStats stats;
  for (uint32_t r = 0; r < kReplicates; ++r) {
    double sum = 0;
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x)
        sum += film.sums(x, y, r).mean_radiance()[1] * weight(x + 0.5 - kSide / 2, kSide / 2 - (y + 0.5));
    stats.add(sum);
  }
  return stats;
}

// Six openings, four cameras, five t-tests each: false alarms of all together below 1.2e-4. Each would see an error of
// 3 % in the radius. Sums over pixels' middles differ from the integrals by less than 0.1 %.
TEST(StatisticalDepthOfField, CirclesOfConfusion) {
  constexpr double kLevel = 1e-6, kQuadrature = 1e-3;
  for (const Opening& opening : kOpenings)
    for (const Case& c : {Case{true, 1.2}, {true, 5.0}, {false, 1.0}, {false, 4.0}}) {
      RenderOverrides o;
      o.spp = 64 * kReplicates;
      o.replicates = kReplicates;
      o.features = false;
      double blur = 0;
      const std::string text = scene(c, opening, blur);
      const Film film = render_text(text, "tests/scenes/closed", o);
      const double flux = 36.0;
      const auto expect = [&](const char* what, const RunningStats& stats, double value, double scale) {
        const double slack = kQuadrature * scale;
        const TestResult test = t_test(stats, std::clamp(stats.mean(), value - slack, value + slack));
        const double se = std::sqrt(stats.variance_of_mean());
        EXPECT_GT(test.p_value, kLevel) << opening.name << " at depth " << c.depth << ": " << what << ' '
                                        << stats.mean() << " +- " << se << ", expected " << value << '\n'
                                        << text;
        EXPECT_LT(8 * se, 0.06 * scale) << opening.name << ": " << what;
      };
      expect("flux", sum_over_pixels(film, [](double, double) { return 1.0; }), flux, flux);
      expect("mean x", sum_over_pixels(film, [](double x, double) { return x; }), flux * blur * opening.mean.x,
             flux * 9);
      expect("mean y", sum_over_pixels(film, [](double, double y) { return y; }), flux * blur * opening.mean.y,
             flux * 9);
      const double pixels = 36.0 / 12 + 1.0 / 12;  // of the square and of the box filter
      const auto second = [&](double m) { return flux * (blur * blur * m + pixels); };
      expect("x^2", sum_over_pixels(film, [](double x, double) { return x * x; }), second(opening.square.x),
             second(opening.square.x));
      expect("y^2", sum_over_pixels(film, [](double, double y) { return y * y; }), second(opening.square.y),
             second(opening.square.y));
    }
}

}  // namespace
}  // namespace etd
