// All metrics of one picture against another as a table: what `etendue diff` prints. The list stands in metrics.cpp.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "metrics/flip.h"

namespace etd {

inline constexpr std::array<const char*, 5> kMetricColumns = {"RGB", "R", "G", "B", "luminance"};

struct MetricRow {
  std::string name;
  std::string doc;
  // Values are in the order of kMetricColumns; nothing where the metric has no value, as FLIP for a channel.
  std::array<std::optional<double>, kMetricColumns.size()> values;
};

struct MetricOptions {
  double exposure = 0;  // in stops, of the screen that PSNR, SSIM and LDR-FLIP look at
  double pixels_per_degree = flip_default_pixels_per_degree();
};

struct MetricTable {
  std::vector<MetricRow> rows;
  Plane ldr_flip, hdr_flip;
  FlipExposures exposures;
  size_t not_finite = 0;  // pixels left out, black in both, because a value of either picture is NaN or infinite

  // A value by row and column; nothing where there is none.
  std::optional<double> find(const std::string& name, const std::string& column = "RGB") const;
};

// Compares linear Rec.709 pictures of one size, not empty.
MetricTable compute_metrics(const Picture& test, const Picture& reference, const MetricOptions& options = {});

}  // namespace etd
