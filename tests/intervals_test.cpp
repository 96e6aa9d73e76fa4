// Do the intervals that a render states cover the truth as often as they say? Many renders of one small image, each
// with its own seed; the truth of a pixel is the mean over all of them. Numbers for docs/verification.md are printed.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <numeric>

#include "core/hash.h"
#include "render_helper.h"
#include "shared_path.h"

namespace etd {
namespace {

constexpr double kConfidence = 0.95;
constexpr int kSide = 32;
constexpr size_t kSeeds = 200;

// A square lamp above a plate, which throws a shadow with wide edges on a floor.
constexpr const char* kSoftShadow = R"(
Integrator "path" "integer maxdepth" 1 "string mode" "next_event"
PixelFilter "box"
Film "rgb" "integer xresolution" 32 "integer yresolution" 32
LookAt 0 -3 3  0 0 0  0 0 1
Camera "perspective" "float fov" 40
WorldBegin
Material "diffuse" "rgb reflectance" [ 0.6 0.5 0.4 ]
Shape "bilinearmesh" "point3 P" [ -4 -4 0  4 -4 0  -4 4 0  4 4 0 ]
Shape "bilinearmesh" "point3 P" [ -0.4 -0.4 0.6  0.4 -0.4 0.6  -0.4 0.4 0.6  0.4 0.4 0.6 ]
AreaLightSource "diffuse" "rgb L" [ 8 8 8 ] "bool twosided" true
Shape "bilinearmesh" "point3 P" [ -0.7 -0.7 2  0.7 -0.7 2  -0.7 0.7 2  0.7 0.7 2 ]
)";

// A checkerboard far out of focus, in even light.
constexpr const char* kDefocus = R"(
Integrator "path" "integer maxdepth" 1 "string mode" "next_event"
PixelFilter "box"
Film "rgb" "integer xresolution" 32 "integer yresolution" 32
Camera "perspective" "float fov" 40 "float lensradius" 0.6 "float focaldistance" 1.5
WorldBegin
LightSource "infinite" "rgb L" [ 1 1 1 ]
Texture "board" "spectrum" "checkerboard" "float uscale" 16 "float vscale" 16 "rgb tex1" [ 0.8 0.7 0.6 ] "rgb tex2" [ 0.1 0.1 0.2 ]
Material "diffuse" "texture reflectance" "board"
Shape "bilinearmesh" "point3 P" [ -4 -4 4  4 -4 3  -4 4 4  4 4 3 ]
)";

struct PixelStudy {
  double hits = 0, trials = 0;  // trials: seeds whose replicates do not all coincide
  double skewness = 0;          // of a replicate's mean, over all replicates of all seeds
  double variance = 0;          // of the image's mean, over the seeds
};

double student_quantile(double confidence, double dof) {
  double low = 0, high = 100;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (student_t_two_sided(middle, dof) > 1 - confidence ? low : high) = middle;
  }
  return low;
}

// Studies the luminance of each pixel. `render(seed)` makes a film.
template <class Render>
std::vector<PixelStudy> study(size_t seeds, Render&& render) {
  struct Moments {
    double n = 0, sum = 0, squares = 0, cubes = 0;
    void add(double x) { n += 1, sum += x, squares += x * x, cubes += x * x * x; }
  };
  std::vector<std::vector<double>> means(seeds), errors(seeds);
  std::vector<Moments> replicates;
  double dof = 0;
  for (size_t seed = 0; seed < seeds; ++seed) {
    const Film film = render(seed);
    const PixelBounds& crop = film.settings().crop;
    dof = film.settings().replicates - 1.0;
    replicates.resize(static_cast<size_t>(crop.width()) * static_cast<size_t>(crop.height()));
    size_t i = 0;
    for (int y = crop.y0; y < crop.y1; ++y)
      for (int x = crop.x0; x < crop.x1; ++x, ++i) {
        means[seed].push_back(film.total(x, y).mean_radiance()[3]);
        errors[seed].push_back(film.standard_error(x, y)[3]);
        for (uint32_t r = 0; r < film.settings().replicates; ++r)
          replicates[i].add(film.sums(x, y, r).mean_radiance()[3]);
      }
  }
  // The mean over all seeds takes part in each deviation from it: its variance is 1 - 1/n of that from the truth.
  const double n = static_cast<double>(seeds), width = student_quantile(kConfidence, dof) * std::sqrt(1 - 1 / n);
  std::vector<PixelStudy> pixels(replicates.size());
  for (size_t i = 0; i < pixels.size(); ++i) {
    PixelStudy& p = pixels[i];
    RunningStats stats;
    for (size_t seed = 0; seed < seeds; ++seed) stats.add(means[seed][i]);
    p.variance = stats.variance();
    for (size_t seed = 0; seed < seeds; ++seed) {
      // What rounding leaves of equal numbers is no spread.
      if (errors[seed][i] <= 1e-9 * means[seed][i]) continue;
      p.trials += 1;
      p.hits += std::abs(means[seed][i] - stats.mean()) <= width * errors[seed][i] ? 1 : 0;
    }
    const Moments& m = replicates[i];
    const double mean = m.sum / m.n, variance = m.squares / m.n - mean * mean;
    if (variance > 1e-18 * mean * mean)
      p.skewness = (m.cubes / m.n - 3 * mean * m.squares / m.n + 2 * mean * mean * mean) / std::pow(variance, 1.5);
  }
  return pixels;
}

struct Pooled {
  double hits = 0, trials = 0, all = 0;
  double coverage() const { return hits / trials; }
};
Pooled pool(std::span<const PixelStudy> pixels, size_t seeds) {
  Pooled pooled;
  for (const PixelStudy& p : pixels) pooled.hits += p.hits, pooled.trials += p.trials;
  pooled.all = static_cast<double>(pixels.size() * seeds);
  return pooled;
}

RenderOverrides overrides(const std::string& sampler, uint32_t spp, uint32_t replicates, size_t seed) {
  RenderOverrides o;
  o.size = {kSide, kSide};
  o.spp = spp, o.replicates = replicates, o.sampler = sampler;
  o.seed = seed, o.features = false, o.tile_size = 8;
  return o;
}

struct Scene {
  const char* name;
  const char* text;  // or, when null, the file
  const char* file;
};
constexpr Scene kSoft{"soft shadow", kSoftShadow, nullptr}, kLens{"defocus", kDefocus, nullptr},
    kRoom{"textured room", nullptr, "tests/scenes/agree/textured_room.pbrt"};

Film render(const Scene& scene, RenderOverrides o) {
  if (scene.text) return render_text(scene.text, "tests/scenes/agree", o);
  o.set = {{"integrator.maxdepth", "2"}};
  return render_scene(source_path(scene.file), o);
}

Pooled report(const std::string& name, std::span<const PixelStudy> pixels, size_t seeds) {
  const Pooled pooled = pool(pixels, seeds);
  std::cout << fmt::format("{:32} coverage {:.2f} % of {:.0f} intervals; replicates coincide in {:.2f} %\n", name,
                           100 * pooled.coverage(), pooled.trials, 100 * (1 - pooled.trials / pooled.all));
  return pooled;
}

void print_by_skewness(std::vector<PixelStudy> pixels, size_t seeds) {
  std::sort(pixels.begin(), pixels.end(),
            [](const PixelStudy& a, const PixelStudy& b) { return a.skewness < b.skewness; });
  for (size_t decile = 0; decile < 10; ++decile) {
    const size_t begin = pixels.size() * decile / 10, end = pixels.size() * (decile + 1) / 10;
    const Pooled pooled = pool(std::span(pixels).subspan(begin, end - begin), seeds);
    std::cout << fmt::format("  decile {:2}: skewness {:6.2f} to {:6.2f}, coverage {:.1f} %\n", decile + 1,
                             pixels[begin].skewness, pixels[end - 1].skewness, 100 * pooled.coverage());
  }
}

// Pixels that never degenerate against the binomial distribution of their own pooled coverage: p-value.
double binomial_p(std::span<const PixelStudy> pixels, size_t seeds) {
  std::vector<double> observed(seeds + 1, 0.0), expected(seeds + 1);
  double hits = 0, count = 0;
  for (const PixelStudy& p : pixels) {
    if (p.trials != static_cast<double>(seeds)) continue;
    ++observed[static_cast<size_t>(p.hits)];
    hits += p.hits, count += 1;
  }
  const double n = static_cast<double>(seeds), p = hits / (n * count);
  for (size_t k = 0; k <= seeds; ++k) {
    const double x = static_cast<double>(k);
    expected[k] = count * (binomial_at_least(x, n, p) - binomial_at_least(x + 1, n, p));
  }
  return chi_square_test(observed, expected, 5).p_value;
}

// With 200,000 intervals the pooled coverage is known to 0.05 %.
void expect_honest(const Scene& scene) {
  const auto pixels =
      study(kSeeds, [&](size_t seed) { return render(scene, overrides("independent", 1024, 8, seed)); });
  const double coverage = report(std::string(scene.name) + ", independent", pixels, kSeeds).coverage();
  EXPECT_GT(coverage, 0.94);
  EXPECT_LT(coverage, 0.96);
  const double p = binomial_p(pixels, kSeeds);
  std::cout << fmt::format("{:32} hits of pixels against the binomial distribution: p = {:.3g}\n", scene.name, p);
  EXPECT_GT(p, 1e-4);
  print_by_skewness(pixels, kSeeds);
}

TEST(SlowIntervals, SoftShadow) { expect_honest(kSoft); }
TEST(SlowIntervals, Defocus) { expect_honest(kLens); }
TEST(SlowIntervals, TexturedRoom) { expect_honest(kRoom); }

TEST(SlowIntervals, SobolCoversAtLeastNinetyPercent) {
  for (const Scene& scene : {kSoft, kLens, kRoom})
    for (const uint32_t spp : {64u, 256u}) {
      const auto pixels = study(50, [&](size_t seed) { return render(scene, overrides("sobol", spp, 8, seed)); });
      EXPECT_GE(report(fmt::format("{}, sobol {} spp", scene.name, spp), pixels, 50).coverage(), 0.9);
    }
}

// Sobol's points are better the longer the sequence: eight short ones are not as good as two long ones.
TEST(SlowIntervals, EightReplicatesAgainstTwoUnderSobol) {
  for (const Scene& scene : {kSoft, kLens, kRoom})
    for (const uint32_t spp : {64u, 256u}) {
      const auto variance = [&](uint32_t replicates) {
        double sum = 0;
        for (const PixelStudy& p :
             study(40, [&](size_t seed) { return render(scene, overrides("sobol", spp, replicates, seed)); }))
          sum += p.variance;
        return sum;
      };
      const double ratio = variance(8) / variance(2);
      std::cout << fmt::format("{:32} sobol {} spp: variance with R = 8 is {:.2f} times that with R = 2\n", scene.name,
                               spp, ratio);
      EXPECT_LT(ratio, 4.5);  // what 8 sequences of a quarter of the length can lose at most when error falls as 1/n
    }
}

// Heavy tails: reported, not judged.
void report_by_skewness(const std::string& name) {
  const std::filesystem::path folder = shared_path("scenes/pbrt/" + name);
  if (folder.empty()) GTEST_SKIP() << "the shared folder with the scene " << name << " is absent";
  const auto pixels = study(kSeeds, [&](size_t seed) {
    return render_scene(folder / "reference-grey.pbrt", overrides("independent", 64, 8, seed));
  });
  report(name + ", independent 64 spp", pixels, kSeeds);
  print_by_skewness(pixels, kSeeds);
}

TEST(SlowIntervals, CornellBoxBySkewness) { report_by_skewness("cornell-box"); }
TEST(SlowIntervals, VeachAjarBySkewness) { report_by_skewness("veach-ajar"); }

// The study itself, on numbers whose answer is known: uniform numbers are covered as stated, and a constant has no
// trial.
TEST(Intervals, TheStudyCountsWhatItShould) {
  const auto pixels = study(400, [](size_t seed) {
    Film film({.width = 2, .height = 1, .crop = {0, 0, 2, 1}, .replicates = 8, .features = false});
    for (uint32_t r = 0; r < 8; ++r) {
      HashStream random(hash_combine(seed, r));
      PixelSums varied, constant;
      for (int i = 0; i < 16; ++i) {
        PixelSample s;
        s.direct = Spectrum(random.next_float());
        varied.add(s);
        s.direct = Spectrum(0.3f);
        constant.add(s);
      }
      film.add(0, 0, r, varied);
      film.add(1, 0, r, constant);
    }
    return film;
  });
  EXPECT_EQ(pixels[0].trials, 400);
  EXPECT_NEAR(pixels[0].hits / 400, 0.95, 4.5 * std::sqrt(0.95 * 0.05 / 400));
  EXPECT_NEAR(pixels[0].variance, 1.0 / 12 / 128, 0.0002);
  EXPECT_NEAR(pixels[0].skewness, 0, 0.2);
  EXPECT_EQ(pixels[1].trials, 0);
}

}  // namespace
}  // namespace etd
