// The report of a difference for a terminal, and as JSON.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "verify/difference/difference.h"

namespace etd {
namespace {

constexpr const char* kChannels[] = {"R", "G", "B"};
constexpr size_t kShownBlocks = 3, kShownPixels = 3;

const char* channel_name(int channel) { return kChannels[channel]; }

std::string cell(const std::optional<double>& value) {
  if (!value) return "-";
  return std::isinf(*value) ? "inf" : fmt::format("{:.4g}", *value);
}

std::string metrics_text(const MetricTable& table) {
  std::string text = fmt::format("{:<16}", "");
  for (const char* column : kMetricColumns) text += fmt::format("{:>11}", column);
  text += "\n";
  for (const MetricRow& row : table.rows) {
    text += fmt::format("{:<16}", row.name);
    for (const auto& value : row.values) text += fmt::format("{:>11}", cell(value));
    text += fmt::format("   {}\n", row.doc);
  }
  if (table.not_finite > 0)
    text += fmt::format("{} pixels with values that are not finite were left out\n", table.not_finite);
  return text;
}

std::string region_text(const std::string& what, const RegionTest& t) {
  return fmt::format("  {:<24}{}  {:.6g} and {:.6g}, {:+.3f} %, t = {:+.2f}, p = {:.2g}, corrected {:.2g}\n", what,
                     channel_name(t.channel), t.a, t.b, t.a == 0 ? HUGE_VAL : 100 * (t.b / t.a - 1), t.result.statistic,
                     t.result.p_value, t.corrected);
}

// Sorts blocks by falling evidence, equal evidence by the size of the statistic.
std::vector<RegionTest> strongest_blocks(const Verdict& v, size_t count) {
  std::vector<RegionTest> blocks = v.blocks;
  std::sort(blocks.begin(), blocks.end(), [](const RegionTest& a, const RegionTest& b) {
    return std::pair(a.result.p_value, -std::abs(a.result.statistic)) <
           std::pair(b.result.p_value, -std::abs(b.result.statistic));
  });
  blocks.resize(std::min(blocks.size(), count));
  return blocks;
}

std::string block_name(const Difference& d, const RegionTest& t) {
  return fmt::format("block at {},{}", d.region.x0 + t.region.x0, d.region.y0 + t.region.y0);
}

std::string verdict_text(const Difference& d, const Verdict& v) {
  std::string text;
  for (const RegionTest& t : v.image) text += region_text("whole image", t);
  for (const RegionTest& t : strongest_blocks(v, kShownBlocks)) text += region_text(block_name(d, t), t);
  text += fmt::format("  {} tests of blocks; {} more are constant and equal in both\n", v.blocks.size(), v.left_out);
  for (const HistogramTest& h : v.histograms)
    text += fmt::format("  {:<24}{}  {} of {} blocks have p < {}, {:.4g} expected, p = {:.2g}, corrected {:.2g}\n",
                        "p-values of the blocks", channel_name(h.channel), h.below, h.blocks, h.threshold,
                        static_cast<double>(h.blocks) * h.threshold, h.p_value, h.corrected);
  if (v.not_finite_in_one) text += "  one image has values that are not finite where the other has none\n";
  double seen = 0;
  for (const RegionTest& t : v.image) seen = std::max(seen, detectable_difference(t, v.level));
  text += fmt::format("{} (smallest corrected p {:.2g}, level {:g})\n",
                      v.same ? "No difference: both can be estimates of one image" : "DIFFERENT: not the same image",
                      v.p_value, v.level);
  if (v.same && std::isfinite(seen))
    text += fmt::format("A difference of the mean of {:.3g} % would have been found in 99 of 100 cases.\n", 100 * seen);
  return text;
}

nlohmann::ordered_json number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

nlohmann::ordered_json region_json(const Difference& d, const RegionTest& t) {
  return {{"x0", d.region.x0 + t.region.x0},
          {"x1", d.region.x0 + t.region.x1},
          {"y0", d.region.y0 + t.region.y0},
          {"y1", d.region.y0 + t.region.y1},
          {"channel", channel_name(t.channel)},
          {"a", t.a},
          {"b", t.b},
          {"standard_error", t.error},
          {"t", number(t.result.statistic)},
          {"dof", number(t.result.dof)},
          {"p", t.result.p_value},
          {"p_corrected", t.corrected}};
}

nlohmann::ordered_json verdict_json(const Difference& d, const Verdict& v) {
  nlohmann::ordered_json json = {{"same", v.same}, {"p_corrected", v.p_value}, {"level", v.level}};
  json["not_finite"] = v.not_finite;
  for (const RegionTest& t : v.image) {
    json["image"].push_back(region_json(d, t));
    json["image"].back()["detectable"] = number(detectable_difference(t, v.level));
  }
  json["blocks_tested"] = v.blocks.size();
  json["blocks_left_out"] = v.left_out;
  json["strongest_blocks"] = nlohmann::ordered_json::array();
  for (const RegionTest& t : strongest_blocks(v, 20)) json["strongest_blocks"].push_back(region_json(d, t));
  json["histograms"] = nlohmann::ordered_json::array();
  for (const HistogramTest& h : v.histograms)
    json["histograms"].push_back({{"channel", channel_name(h.channel)},
                                  {"bins", h.bins},
                                  {"threshold", h.threshold},
                                  {"below", h.below},
                                  {"p", h.p_value},
                                  {"p_corrected", h.corrected}});
  return json;
}

}  // namespace

std::string difference_text(const Difference& d) {
  std::string text = fmt::format("{} against {}, {} x {} pixels{}\n", d.name_a, d.name_b, d.a.width, d.a.height,
                                 d.identical ? ", identical in every bit" : "");
  text += metrics_text(d.metrics);
  for (size_t i = 0; i < std::min(d.worst.size(), kShownPixels); ++i) {
    const WorstPixel& p = d.worst[i];
    text += fmt::format("pixel {},{}: {:.4g} {:.4g} {:.4g} and {:.4g} {:.4g} {:.4g}, {:.2g} % of the relMSE\n", p.x,
                        p.y, p.a[0], p.a[1], p.a[2], p.b[0], p.b[1], p.b[2], 100 * p.share);
  }
  for (const std::string& note : d.notes) text += "note: " + note + "\n";
  if (d.verdict) return text + verdict_text(d, *d.verdict);
  if (d.identical) return text + "No difference: every bit is the same\n";
  return text + fmt::format("No verdict, since an error is unknown: {}\n", d.no_verdict);
}

std::string difference_json(const Difference& d) {
  constexpr const char* kAnswers[] = {"same", "different", "unknown"};
  nlohmann::ordered_json json = {{"a", d.name_a},
                                 {"b", d.name_b},
                                 {"crop", {d.region.x0, d.region.x1, d.region.y0, d.region.y1}},
                                 {"answer", kAnswers[static_cast<size_t>(answer(d))]},
                                 {"identical", d.identical}};
  for (const MetricRow& row : d.metrics.rows)
    for (size_t c = 0; c < kMetricColumns.size(); ++c)
      if (row.values[c]) json["metrics"][row.name][kMetricColumns[c]] = number(*row.values[c]);
  json["not_finite"] = d.metrics.not_finite;
  json["worst_pixels"] = nlohmann::ordered_json::array();
  for (const WorstPixel& p : d.worst)
    json["worst_pixels"].push_back({{"x", p.x}, {"y", p.y}, {"a", p.a}, {"b", p.b}, {"share_of_relmse", p.share}});
  json["notes"] = d.notes;
  if (d.verdict)
    json["verdict"] = verdict_json(d, *d.verdict);
  else
    json["no_verdict"] = d.no_verdict;
  return json.dump(2) + "\n";
}

}  // namespace etd
