// Images of another renderer: pbrt-v4's means of eight runs, with their standard errors, in the shared folder. Compared
// is the mean over the pixels that see no emitter, nor does a pixel beside them. Grey scenes must agree within four
// combined standard errors and 0.3 %; coloured ones within 10 % per channel, because pbrt transports spectra and
// Etendue RGB, which differ where light is coloured several times over.
//
// Each scene may have a second run (second_run.h). Where nearly all of the error is ours (of the fast test at least
// 80 %), a mean is four standard errors off by chance in 1 of 860 runs (Student's t with 15 degrees of freedom), and
// the four grey scenes raise a false alarm with a probability of about 5e-6. The 10 % are more than five standard
// errors.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <iostream>

#include "io/image_write.h"
#include "render_helper.h"
#include "second_run.h"
#include "shared_path.h"

namespace etd {
namespace {

constexpr uint32_t kReplicates = 16;

struct Estimate {
  double mean = 0, error = 0;  // and its standard error
};

struct Comparison {
  Estimate ours, theirs;
  double ratio() const { return ours.mean / theirs.mean; }
  double sigmas() const { return (ours.mean - theirs.mean) / std::hypot(ours.error, theirs.error); }
};

struct Reference {
  LayeredImage mean, error;
};

Reference read_reference(const std::filesystem::path& folder, const std::string& name) {
  const auto read = [&](const std::string& file) {
    LayersResult result = read_layers(folder / file);
    if (!result.image) throw std::runtime_error(file + ": " + result.error);
    return std::move(*result.image);
  };
  return {read(name + ".exr"), read(name + "-stderr.exr")};
}

// Channels that say the same thing in grey scenes: their errors add up, those of pixels do not.
Estimate reference_mean(const Reference& reference, const std::vector<size_t>& pixels, const std::string& channels) {
  Estimate e;
  double variance = 0;
  std::vector<std::vector<float>> mean, error;
  for (char c : channels) {
    mean.push_back(reference.mean.plane(std::string(1, c)));
    error.push_back(reference.error.plane(std::string(1, c)));
  }
  for (size_t p : pixels) {
    double pixel_error = 0;
    for (size_t c = 0; c < mean.size(); ++c) {
      e.mean += mean[c][p];
      pixel_error += error[c][p];
    }
    variance += sqr(pixel_error);
  }
  const double n = static_cast<double>(pixels.size()) * static_cast<double>(channels.size());
  return {e.mean / n, std::sqrt(variance) / n};
}

Estimate our_mean(const Film& film, const std::vector<size_t>& pixels, const Quantity& quantity) {
  RunningStats stats;
  const size_t width = static_cast<size_t>(film.settings().width);
  for (uint32_t r = 0; r < film.settings().replicates; ++r) {
    double sum = 0;
    for (size_t p : pixels)
      sum += value(film.sums(static_cast<int>(p % width), static_cast<int>(p / width), r), quantity);
    stats.add(sum / static_cast<double>(pixels.size()));
  }
  return {stats.mean(), std::sqrt(stats.variance_of_mean())};
}

// Whether the pixel or one beside it has seen an emitter: at the edge of one, few samples may all have missed what the
// other renderer's samples found.
bool near_emission(const Film& film, int x, int y) {
  for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, film.settings().height - 1); ++ny)
    for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, film.settings().width - 1); ++nx)
      if (film.total(nx, ny).emission != std::array<double, 3>{}) return true;
  return false;
}

std::vector<size_t> pixels_without_emission(const Film& film) {
  std::vector<size_t> pixels;
  for (int y = 0; y < film.settings().height; ++y)
    for (int x = 0; x < film.settings().width; ++x)
      if (!near_emission(film, x, y))
        pixels.push_back(static_cast<size_t>(y) * static_cast<size_t>(film.settings().width) + static_cast<size_t>(x));
  return pixels;
}

std::vector<float> picture(const LayeredImage& image) {
  std::vector<float> rgb;
  const std::vector<float> r = image.plane("R"), g = image.plane("G"), b = image.plane("B");
  for (size_t i = 0; i < r.size(); ++i) rgb.insert(rgb.end(), {r[i], g[i], b[i]});
  return rgb;
}

class SceneAgainstReference {
 public:
  SceneAgainstReference(const std::filesystem::path& folder, std::string scene, std::string name, uint32_t spp,
                        uint64_t seed)
      : scene_(std::move(scene)),
        name_(std::move(name)),
        film_(render(folder, name_, spp, seed)),
        reference_(read_reference(folder, name_)),
        pixels_(pixels_without_emission(film_)) {}

  bool same_size() const {
    return reference_.mean.width == film_.settings().width && reference_.mean.height == film_.settings().height;
  }
  // Compares one channel, or "RGB" together; prints a line of the table.
  Comparison compare(const std::string& channels) const {
    Quantity quantity;
    if (channels.size() == 1) quantity = *parse_quantity("beauty." + channels);
    const Comparison c{our_mean(film_, pixels_, quantity), reference_mean(reference_, pixels_, channels)};
    std::cout << fmt::format(
        "{:12} {:15} {:3}  ours {:.6f} +- {:.6f}  theirs {:.6f} +- {:.6f}  ratio {:.5f}  {:+.2f} sigma\n", scene_,
        name_, channels, c.ours.mean, c.ours.error, c.theirs.mean, c.theirs.error, c.ratio(), c.sigmas());
    return c;
  }
  std::string evidence() const {
    return write_evidence(scene_ + "-" + name_, film_.settings().width, film_.settings().height, etd::picture(film_),
                          picture(reference_.mean));
  }

 private:
  static Film render(const std::filesystem::path& folder, const std::string& name, uint32_t spp, uint64_t seed) {
    RenderOverrides o;
    o.spp = spp;
    o.replicates = kReplicates;
    o.seed = seed;
    o.features = false;
    return render_scene(folder / (name + ".pbrt"), o);
  }

  std::string scene_, name_;
  Film film_;
  Reference reference_;
  std::vector<size_t> pixels_;
};

// `largest_error`: of our mean, relative.
void compare_grey(const std::string& scene, uint32_t spp, double largest_error) {
  const std::filesystem::path folder = shared_path("scenes/pbrt/" + scene);
  if (folder.empty()) GTEST_SKIP() << "the shared folder with the scene " << scene << " is absent";
  expect_in_two_runs(scene, [&](const TestRun& run) {
    const SceneAgainstReference test(folder, scene, "reference-grey", spp * run.more, 6 + run.fresh_seeds);
    if (!test.same_size()) return Objections{"the reference has another size"};
    const Comparison c = test.compare("RGB");
    EXPECT_LT(c.ours.error, largest_error * c.ours.mean) << "too few samples to say anything";
    const double allowed = 4 * std::hypot(c.ours.error, c.theirs.error) + 0.003 * c.theirs.mean;
    if (std::abs(c.ours.mean - c.theirs.mean) <= allowed) return Objections{};
    return Objections{fmt::format("ratio {:.5f}, {:+.2f} sigma; {}", c.ratio(), c.sigmas(), test.evidence())};
  });
}

void compare_coloured(const std::string& scene, uint32_t spp, double largest_error) {
  const std::filesystem::path folder = shared_path("scenes/pbrt/" + scene);
  if (folder.empty()) GTEST_SKIP() << "the shared folder with the scene " << scene << " is absent";
  expect_in_two_runs(scene, [&](const TestRun& run) {
    const SceneAgainstReference test(folder, scene, "reference", spp * run.more, 6 + run.fresh_seeds);
    if (!test.same_size()) return Objections{"the reference has another size"};
    Objections differences;
    for (const char* channel : {"R", "G", "B"}) {
      const Comparison c = test.compare(channel);
      EXPECT_LT(c.ours.error, largest_error * c.ours.mean) << "too few samples to say anything";
      if (!(std::abs(c.ratio() - 1.0) <= 0.1))
        differences.push_back(fmt::format("{}: ratio {:.5f}; {}", channel, c.ratio(), test.evidence()));
    }
    return differences;
  });
}

TEST(StatisticalReference, GreyCornellBox) { compare_grey("cornell-box", 16, 0.002); }
TEST(StatisticalReference, GreyVeachMis) { compare_grey("veach-mis", 64, 0.015); }
TEST(StatisticalReference, GreyVeachAjar) { compare_grey("veach-ajar", 16, 0.015); }
TEST(StatisticalReference, ColouredCornellBox) { compare_coloured("cornell-box", 16, 0.005); }
TEST(StatisticalReference, ColouredVeachMis) { compare_coloured("veach-mis", 32, 0.03); }
TEST(StatisticalReference, GreyTeapot) { compare_grey("teapot", 16, 0.01); }
TEST(StatisticalReference, ColouredTeapot) { compare_coloured("teapot", 16, 0.02); }
TEST(StatisticalReference, ColouredVeachAjar) { compare_coloured("veach-ajar", 16, 0.02); }

TEST(SlowReference, GreyCornellBox) { compare_grey("cornell-box", 512, 0.0005); }
TEST(SlowReference, GreyVeachMis) { compare_grey("veach-mis", 2048, 0.002); }
TEST(SlowReference, GreyVeachAjar) { compare_grey("veach-ajar", 1280, 0.002); }
TEST(SlowReference, GreyTeapot) { compare_grey("teapot", 512, 0.001); }
TEST(SlowReference, GreyClassroom) { compare_grey("classroom", 2048, 0.004); }
TEST(SlowReference, ColouredTeapot) { compare_coloured("teapot", 512, 0.002); }
TEST(SlowReference, ColouredClassroom) { compare_coloured("classroom", 256, 0.01); }
TEST(SlowReference, ColouredCornellBox) { compare_coloured("cornell-box", 512, 0.001); }
TEST(SlowReference, ColouredVeachMis) { compare_coloured("veach-mis", 1024, 0.005); }
TEST(SlowReference, ColouredVeachAjar) { compare_coloured("veach-ajar", 1024, 0.005); }

}  // namespace
}  // namespace etd
