#include "verify/statistics/estimate.h"

#include <fmt/format.h>

#include <charconv>
#include <limits>

#include "core/math.h"

namespace etd {
namespace {

std::vector<Rgb> to_pixels(std::span<const float> rgb) {
  std::vector<Rgb> pixels;
  pixels.reserve(rgb.size() / 3);
  for (size_t i = 0; i < rgb.size(); i += 3) pixels.push_back({rgb[i], rgb[i + 1], rgb[i + 2]});
  return pixels;
}

// Squares standard errors. False when there are pixels whose error is unknown though their value is a number.
bool set_variance(Estimate& estimate, std::span<const float> errors) {
  estimate.variance = to_pixels(errors);
  for (size_t i = 0; i < estimate.variance.size(); ++i)
    for (size_t c = 0; c < 3; ++c) {
      double& v = estimate.variance[i][c];
      v = sqr(v);
      if (!std::isfinite(v) && std::isfinite(estimate.mean[i][c])) return false;
    }
  return true;
}

// A whole number from the metadata that the program writes.
std::optional<int> metadata_number(const LayeredImage& image, const char* name) {
  const MetadataValue* value = image.find_metadata(name);
  if (value == nullptr || !std::holds_alternative<int>(*value)) return {};
  return std::get<int>(*value);
}

bool is_correlated(const LayeredImage& image) {
  const MetadataValue* value = image.find_metadata("etendue:pixels");
  return value != nullptr && std::holds_alternative<std::string>(*value) &&
         std::get<std::string>(*value) == "correlated";
}

std::vector<Rgb> cropped(const std::vector<Rgb>& pixels, int width, const PixelBounds& b) {
  std::vector<Rgb> part;
  for (int y = b.y0; y < b.y1; ++y) {
    const auto row = pixels.begin() + static_cast<std::ptrdiff_t>(y) * width;
    part.insert(part.end(), row + b.x0, row + b.x1);
  }
  return part;
}

}  // namespace

Estimate make_estimate(const Film& film) {
  const FilmSettings& s = film.settings();
  Estimate e;
  e.width = s.crop.width(), e.height = s.crop.height();
  e.replicates.resize(s.replicates);
  e.correlated = s.correlated;
  e.samples = std::numeric_limits<double>::infinity();
  for (int y = s.crop.y0; y < s.crop.y1; ++y)
    for (int x = s.crop.x0; x < s.crop.x1; ++x) {
      const PixelSums total = film.total(x, y);
      const std::array<double, 4> mean = total.mean_radiance(), error = film.standard_error(x, y);
      e.samples = std::min(e.samples, total.count);
      e.mean.push_back({mean[0], mean[1], mean[2]});
      e.variance.push_back({sqr(error[0]), sqr(error[1]), sqr(error[2])});
      for (uint32_t r = 0; r < s.replicates; ++r) {
        const std::array<double, 4> m = film.sums(x, y, r).mean_radiance();
        e.replicates[r].push_back({m[0], m[1], m[2]});
      }
    }
  e.dof = s.replicates >= kReplicatesForSpread ? s.replicates - 1.0 : e.samples - 1;
  return e;
}

EstimateResult make_estimate(const LayeredImage& image, const std::string& layer) {
  const LayerResult picture = layer_rgb(image, layer), error = layer_rgb(image, "stderr");
  if (!picture.error.empty()) return {{}, picture.error};
  if (!error.error.empty()) return {{}, "it has no layer \"stderr\" that tells its error"};
  const std::optional<int> spp = metadata_number(image, "etendue:spp"),
                           replicates = metadata_number(image, "etendue:replicates");
  if (!spp || !replicates) return {{}, "its metadata do not say from how many samples its error comes"};

  Estimate e;
  e.width = image.width, e.height = image.height;
  e.mean = to_pixels(picture.rgb);
  e.samples = *spp;
  e.dof = *replicates >= static_cast<int>(kReplicatesForSpread) ? *replicates - 1.0 : *spp - 1.0;
  e.correlated = is_correlated(image);
  if (*spp < 2 || !set_variance(e, error.rgb))
    return {{}, "it has pixels with a single sample, whose error is unknown"};
  for (int r = 0; r < *replicates; ++r) {
    const LayerResult replicate = layer_rgb(image, fmt::format("replicate{}", r));
    if (!replicate.error.empty()) break;
    e.replicates.push_back(to_pixels(replicate.rgb));
  }
  return {std::move(e), {}};
}

EstimateResult make_estimate(const Picture& picture, const Picture& standard_error, int runs) {
  if (picture.width != standard_error.width || picture.height != standard_error.height)
    return {{},
            fmt::format("the standard error has {} x {} pixels, the picture {} x {}", standard_error.width,
                        standard_error.height, picture.width, picture.height)};
  Estimate e;
  e.width = picture.width, e.height = picture.height;
  e.mean = to_pixels(picture.rgb);
  e.dof = runs - 1;
  if (!set_variance(e, standard_error.rgb)) return {{}, "the standard error is not finite in some pixels"};
  return {std::move(e), {}};
}

Estimate exact_estimate(int width, int height, const Rgb& value) {
  Estimate e;
  e.width = width, e.height = height;
  const size_t pixels = static_cast<size_t>(width) * static_cast<size_t>(height);
  e.mean.assign(pixels, value);
  e.variance.assign(pixels, Rgb{});
  e.dof = std::numeric_limits<double>::infinity();
  return e;
}

Estimate crop(const Estimate& estimate, const PixelBounds& b) {
  Estimate e = estimate;
  e.width = b.width(), e.height = b.height();
  e.mean = cropped(estimate.mean, estimate.width, b);
  e.variance = cropped(estimate.variance, estimate.width, b);
  for (std::vector<Rgb>& r : e.replicates) r = cropped(r, estimate.width, b);
  return e;
}

}  // namespace etd
