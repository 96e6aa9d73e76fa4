#include "verify/difference/difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/math.h"

namespace etd {
namespace {

namespace fs = std::filesystem;

constexpr size_t kWorstPixels = 20;

struct Input {
  std::string name;
  LayeredImage image;
  std::string layer;       // of the image
  bool is_picture = true;  // that layer is the picture
  Picture picture;
  EstimateResult estimate;
  PixelBounds window() const { return {image.x, image.y, image.x + image.width, image.y + image.height}; }
};

std::string bounds_text(const PixelBounds& b) { return fmt::format("{},{},{},{}", b.x0, b.x1, b.y0, b.y1); }

const std::string* metadata_text(const LayeredImage& image, const char* name) {
  const MetadataValue* value = image.find_metadata(name);
  return value == nullptr ? nullptr : std::get_if<std::string>(value);
}

// Returns what went wrong, or an empty string.
std::string read_picture(const fs::path& path, const std::string& layer, Input& input) {
  LayersResult read = read_any_layers(path, layer);
  if (!read.image) return fmt::format("{}: {}", path.string(), read.error);
  LayeredImage& image = input.image = std::move(*read.image);
  input.layer = read.layer;
  input.is_picture = read.is_picture;
  LayerResult rgb = layer_rgb(image, input.layer);
  if (!rgb.error.empty()) return fmt::format("{}: {}", path.string(), rgb.error);
  input.picture = {image.width, image.height, std::move(rgb.rgb)};
  return {};
}

// NAME-stderr.exr beside NAME.exr, when it is there; otherwise empty.
fs::path error_beside(const fs::path& path) {
  fs::path beside = path;
  beside.replace_filename(path.stem().string() + "-stderr" + path.extension().string());
  std::error_code ignored;
  return fs::exists(beside, ignored) ? beside : fs::path();
}

// A part that is a render of its own tells its error too.
bool has_own_error(const Input& input) { return input.layer.empty() && input.image.find("stderr.R") >= 0; }

std::string read_input(const fs::path& path, fs::path error_path, const DifferenceOptions& options, Input& input,
                       std::vector<std::string>& notes) {
  input.name = path.string();
  if (std::string problem = read_picture(path, options.layer, input); !problem.empty()) return problem;
  if (!options.layer.empty() && !input.is_picture && !has_own_error(input)) {
    input.estimate.problem = "only the picture has an error, its layers have none";
    return {};
  }
  if (error_path.empty() && input.image.find("stderr.R") < 0) error_path = error_beside(path);
  if (error_path.empty()) {
    input.estimate = make_estimate(input.image, input.layer);
    return {};
  }
  Input error;
  if (std::string problem = read_picture(error_path, "", error); !problem.empty()) return problem;
  input.estimate = make_estimate(input.picture, error.picture, options.runs);
  if (!input.estimate.estimate) return fmt::format("{}: {}", error_path.string(), input.estimate.problem);
  notes.push_back(fmt::format("the standard error of {} is {}, taken for that of {} runs", path.string(),
                              error_path.string(), options.runs));
  return {};
}

// What two renders that share more than the scene say about each other.
void add_notes(const Input& a, const Input& b, std::vector<std::string>& notes) {
  for (const Input* input : {&a, &b})
    if (const std::string* bias = metadata_text(input->image, "etendue:biased");
        bias != nullptr && *bias != "nothing") {
      const std::string* consistent = metadata_text(input->image, "etendue:consistent");
      const bool vanishes = consistent != nullptr && *consistent == "true";
      notes.push_back(fmt::format("{} is {}: {}", input->name,
                                  vanishes ? "consistent, and biased by what its error does not tell" : "biased",
                                  *bias));
    }
  const std::string* seed_a = metadata_text(a.image, "etendue:seed");
  const std::string* seed_b = metadata_text(b.image, "etendue:seed");
  if (seed_a != nullptr && seed_b != nullptr && *seed_a == *seed_b)
    notes.push_back(fmt::format(
        "both images used the seed {}: common random numbers make them more alike than independent ones are", *seed_a));
}

// The pixels to compare, or nothing and why.
std::optional<PixelBounds> choose_region(const Input& a, const Input& b, const std::optional<PixelBounds>& crop,
                                         std::string& error) {
  const PixelBounds wa = a.window(), wb = b.window();
  const PixelBounds both{std::max(wa.x0, wb.x0), std::max(wa.y0, wb.y0), std::min(wa.x1, wb.x1),
                         std::min(wa.y1, wb.y1)};
  if (!crop && wa == wb) return wa;
  if (crop) {
    if (!crop->empty() && crop->x0 >= both.x0 && crop->y0 >= both.y0 && crop->x1 <= both.x1 && crop->y1 <= both.y1)
      return crop;
    error = fmt::format("the crop {} is not inside the pixels of both images", bounds_text(*crop));
  } else {
    error = "the images do not show the same pixels";
  }
  error += fmt::format("\n  {} has {} x {} pixels, x0,x1,y0,y1 = {}\n  {} has {} x {} pixels, {}", a.name, wa.width(),
                       wa.height(), bounds_text(wa), b.name, wb.width(), wb.height(), bounds_text(wb));
  const bool one_image = a.image.full_width == b.image.full_width && a.image.full_height == b.image.full_height;
  if (!crop && one_image && !both.empty())
    error += fmt::format("\n  --crop {} compares what both have", bounds_text(both));
  return {};
}

PixelBounds relative_to(const PixelBounds& b, const LayeredImage& image) {
  return {b.x0 - image.x, b.y0 - image.y, b.x1 - image.x, b.y1 - image.y};
}

std::vector<WorstPixel> worst_pixels(const Difference& d, const Estimate* a, const Estimate* b) {
  const size_t pixels = d.a.pixels();
  std::vector<double> errors(pixels, 0.0);
  for (size_t i = 0; i < d.a.rgb.size(); ++i) {
    const double r = d.b.rgb[i], e = sqr(d.a.rgb[i] - r) / (sqr(r) + 0.01);
    errors[i / 3] += std::isfinite(e) ? e : 0.0;
  }
  const double sum = std::accumulate(errors.begin(), errors.end(), 0.0);
  std::vector<size_t> order(pixels);
  std::iota(order.begin(), order.end(), size_t{0});
  const auto end = order.begin() + static_cast<std::ptrdiff_t>(std::min(kWorstPixels, pixels));
  std::partial_sort(order.begin(), end, order.end(), [&](size_t i, size_t j) { return errors[i] > errors[j]; });
  std::vector<WorstPixel> worst;
  for (auto it = order.begin(); it != end && errors[*it] > 0; ++it) {
    const size_t i = *it, width = static_cast<size_t>(d.a.width);
    WorstPixel p;
    p.x = d.region.x0 + static_cast<int>(i % width), p.y = d.region.y0 + static_cast<int>(i / width);
    p.share = errors[i] / sum;
    for (size_t c = 0; c < 3; ++c) {
      p.a[c] = d.a.rgb[3 * i + c], p.b[c] = d.b.rgb[3 * i + c];
      const double variance = a && b ? a->variance[i][c] + b->variance[i][c] : 0.0;
      if (variance > 0) p.sigma = std::max(p.sigma.value_or(0), std::abs(p.a[c] - p.b[c]) / std::sqrt(variance));
    }
    worst.push_back(p);
  }
  return worst;
}

// The estimates and what they say, or why they cannot.
void judge(const DifferenceOptions& options, Difference& d, std::optional<Estimate> a, std::optional<Estimate> b) {
  if (a && b) {
    a->correlated |= options.correlated;
    if (options.correlated && !options.expected) b->correlated = true;
    for (const Estimate* e : {&*a, &*b})
      if (e->correlated && e->replicates.size() < 2)
        d.no_verdict = fmt::format(
            "{}: pixels are correlated, and only replicates (render --replicate-layers) tell "
            "the error of a region then",
            e == &*a ? d.name_a : d.name_b);
    if (d.no_verdict.empty()) d.verdict = compare(*a, *b, options.compare);
  }
  d.worst = worst_pixels(d, a ? &*a : nullptr, b ? &*b : nullptr);
}

Input constant_input(const Rgb& value, const Input& like) {
  Input input;
  input.name = fmt::format("the values {:g}, {:g}, {:g}", value[0], value[1], value[2]);
  input.image = like.image;
  input.image.metadata.clear();
  input.picture = like.picture;
  for (size_t i = 0; i < input.picture.rgb.size(); ++i) input.picture.rgb[i] = static_cast<float>(value[i % 3]);
  input.estimate.estimate = exact_estimate(input.picture.width, input.picture.height, value);
  return input;
}

}  // namespace

DifferenceResult find_difference(const DifferenceOptions& options) {
  Difference d;
  Input a, b;
  if (std::string error = read_input(options.a, options.error_a, options, a, d.notes); !error.empty())
    return {{}, error};
  if (options.expected) {
    b = constant_input(*options.expected, a);
  } else if (std::string error = read_input(options.b, options.error_b, options, b, d.notes); !error.empty()) {
    return {{}, error};
  }
  add_notes(a, b, d.notes);
  std::string error;
  const std::optional<PixelBounds> region = choose_region(a, b, options.crop, error);
  if (!region) return {{}, error};

  d.name_a = a.name, d.name_b = b.name;
  d.region = *region;
  d.a = crop(a.picture, relative_to(*region, a.image));
  d.b = crop(b.picture, relative_to(*region, b.image));
  d.identical = d.a.rgb == d.b.rgb;
  d.metrics = compute_metrics(d.a, d.b, options.metrics);
  std::optional<Estimate> estimates[2];
  const Input* inputs[] = {&a, &b};
  for (size_t i = 0; i < 2; ++i) {
    const EstimateResult& e = inputs[i]->estimate;
    if (e.estimate)
      estimates[i] = crop(*e.estimate, relative_to(*region, inputs[i]->image));
    else if (d.no_verdict.empty())
      d.no_verdict = fmt::format("{}: {}", inputs[i]->name, e.problem);
  }
  judge(options, d, std::move(estimates[0]), std::move(estimates[1]));
  return {std::move(d), {}};
}

Answer answer(const Difference& d) {
  if (d.verdict) return d.verdict->same ? Answer::kSame : Answer::kDifferent;
  return d.identical ? Answer::kSame : Answer::kUnknown;
}

double detectable_difference(const RegionTest& image, double level) {
  // Three groups of tests share the level, three channels that of the first; the normal distribution stands for
  // Student's, because a whole image has many degrees of freedom.
  constexpr double kMissedOneIn100 = 2.3263;
  double low = 0, high = 40;
  while (high - low > 1e-6) {
    const double middle = 0.5 * (low + high);
    (normal_two_sided(middle) > level / 9 ? low : high) = middle;
  }
  return image.b == 0 ? HUGE_VAL : (low + kMissedOneIn100) * image.error / std::abs(image.b);
}

}  // namespace etd
