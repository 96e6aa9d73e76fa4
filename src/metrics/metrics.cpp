#include "metrics/metrics.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>

#include "metrics/mae.h"
#include "metrics/psnr.h"
#include "metrics/rel_mse.h"
#include "metrics/rmse.h"
#include "metrics/ssim.h"
#include "spectrum/srgb.h"

namespace etd {
namespace {

using Values = std::span<const float>;

// A metric that looks at each pixel alone, at `channels` interleaved values of it.
struct Pointwise {
  const char* name;
  const char* doc;
  bool of_screen;  // looks at encoded values in [0, 1] instead of linear ones
  double (*value)(Values x, Values r, int channels);
};
constexpr Pointwise kPointwise[] = {
    {"MSE", "mean of (x - r)^2", false, [](Values x, Values r, int) { return mse(x, r); }},
    {"RMSE", "its root", false, [](Values x, Values r, int) { return rmse(x, r); }},
    {"MAE", "mean of |x - r|", false, [](Values x, Values r, int) { return mae(x, r); }},
    {"relMSE", "mean of (x - r)^2 / (r^2 + 0.01)", false,
     [](Values x, Values r, int channels) { return rel_mse(x, r, channels).plain; }},
    {"relMSE trimmed", "without the largest 0.1 % of the pixels", false,
     [](Values x, Values r, int channels) { return rel_mse(x, r, channels).trimmed; }},
    {"PSNR", "dB, of sRGB values", true, [](Values x, Values r, int) { return psnr(x, r); }},
};

// A picture as interleaved values, and as its planes R, G, B and luminance.
struct Views {
  explicit Views(const Picture& picture)
      : all(picture.rgb),
        planes{channel_plane(picture, 0), channel_plane(picture, 1), channel_plane(picture, 2),
               luminance_plane(picture)} {}

  std::vector<float> all;
  std::array<Plane, 4> planes;
};

Views encoded(Views views) {
  const auto encode = [](std::vector<float>& values) {
    std::transform(values.begin(), values.end(), values.begin(), [](float v) { return linear_to_srgb(v); });
  };
  encode(views.all);
  for (Plane& plane : views.planes) encode(plane.values);
  return views;
}

Picture shown(const Picture& picture, double exposure) {
  Picture result = picture;
  const float scale = static_cast<float>(std::exp2(exposure));
  for (float& v : result.rgb) v = std::clamp(v * scale, 0.0f, 1.0f);
  return result;
}

MetricRow pointwise_row(const Pointwise& metric, const Views& x, const Views& r) {
  MetricRow row{metric.name, metric.doc, {}};
  row.values[0] = metric.value(x.all, r.all, 3);
  for (size_t c = 0; c < x.planes.size(); ++c)
    row.values[c + 1] = metric.value(x.planes[c].values, r.planes[c].values, 1);
  return row;
}

MetricRow ssim_row(const Views& x, const Views& r) {
  MetricRow row{"SSIM", "of sRGB values; 1 for equal pictures", {}};
  for (size_t c = 0; c < x.planes.size(); ++c) row.values[c + 1] = ssim(x.planes[c], r.planes[c]);
  if (row.values[1]) row.values[0] = (*row.values[1] + *row.values[2] + *row.values[3]) / 3;
  return row;
}

bool is_finite(const float* rgb) { return std::isfinite(rgb[0]) && std::isfinite(rgb[1]) && std::isfinite(rgb[2]); }

// Makes pixels black in both pictures where a value of either is not finite; returns how many.
size_t remove_not_finite(Picture& a, Picture& b) {
  size_t count = 0;
  for (size_t i = 0; i < a.rgb.size(); i += 3) {
    if (is_finite(&a.rgb[i]) && is_finite(&b.rgb[i])) continue;
    for (size_t c = 0; c < 3; ++c) a.rgb[i + c] = b.rgb[i + c] = 0;
    ++count;
  }
  return count;
}

}  // namespace

std::optional<double> MetricTable::find(const std::string& name, const std::string& column) const {
  const auto c = std::find(kMetricColumns.begin(), kMetricColumns.end(), column);
  for (const MetricRow& row : rows)
    if (row.name == name && c != kMetricColumns.end())
      return row.values[static_cast<size_t>(c - kMetricColumns.begin())];
  return {};
}

MetricTable compute_metrics(const Picture& test, const Picture& reference, const MetricOptions& options) {
  assert(test.width == reference.width && test.height == reference.height && test.pixels() > 0);
  MetricTable table;
  Picture x = test, r = reference;
  table.not_finite = remove_not_finite(x, r);
  const Picture shown_x = shown(x, options.exposure), shown_r = shown(r, options.exposure);
  {
    const Views linear_x(x), linear_r(r), screen_x = encoded(Views(shown_x)), screen_r = encoded(Views(shown_r));
    for (const Pointwise& metric : kPointwise)
      table.rows.push_back(metric.of_screen ? pointwise_row(metric, screen_x, screen_r)
                                            : pointwise_row(metric, linear_x, linear_r));
    table.rows.push_back(ssim_row(screen_x, screen_r));
  }
  table.ldr_flip = ldr_flip(shown_x, shown_r, options.pixels_per_degree);
  table.exposures = flip_exposures(r);
  table.hdr_flip = hdr_flip(x, r, table.exposures, options.pixels_per_degree);
  table.rows.push_back({"LDR-FLIP", "visible difference on a screen, 0 to 1", {mean(table.ldr_flip)}});
  table.rows.push_back({"HDR-FLIP", "the same over all exposures that show something", {mean(table.hdr_flip)}});
  return table;
}

}  // namespace etd
