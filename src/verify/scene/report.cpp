// What verify_scene() found, as text and as JSON.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "verify/scene/verify_scene.h"

namespace etd {

std::string scene_table(const SceneVerification& v) {
  std::string text = fmt::format("{:<18}  {:>6}  {:>7}  {:>10}  {:>22}  {:>10}  {}\n", "estimator", "spp", "seconds",
                                 "mean of G", "difference", "smallest p", "verdict");
  for (const EstimatorReport& e : v.estimators) {
    if (e.verdict == Agreement::kNotApplicable) {
      text += fmt::format("{:<18}  {}: {}\n", e.name, agreement_name(e.verdict), e.reason);
      continue;
    }
    const bool reference = e.verdict == Agreement::kReference;
    text += fmt::format("{:<18}  {:>6}  {:>7.1f}  {:>10.5g}  {:>22}  {:>10}  {}{}\n", e.name, e.spp, e.seconds, e.mean,
                        reference ? fmt::format("± {:.3f} %", 100 * e.error)
                                  : fmt::format("{:+.3f} ± {:.3f} %", 100 * e.difference, 100 * e.error),
                        reference ? "" : fmt::format("{:.2g}", e.smallest_p), agreement_name(e.verdict),
                        e.reason.empty() ? "" : ": " + e.reason);
  }
  for (const EstimatorReport& e : v.estimators) {
    constexpr size_t kShown = 6;
    for (size_t i = 0; i < std::min(e.failed.size(), kShown); ++i) {
      const RegionTest& t = e.failed[i];
      text +=
          fmt::format("  {}, {}, t = {:.1f}, p = {:.1e}\n", e.name, describe_test(t), t.result.statistic, t.corrected);
    }
    if (e.failed.size() > kShown) text += fmt::format("  {}, and {} more\n", e.name, e.failed.size() - kShown);
  }
  return text;
}

std::string scene_json(const SceneVerification& v) {
  nlohmann::ordered_json json{{"passed", !v.disagrees()}, {"complete", v.complete}};
  json["size"] = {v.width, v.height};
  json["estimators"] = nlohmann::ordered_json::array();
  for (const EstimatorReport& e : v.estimators) {
    nlohmann::ordered_json j{{"name", e.name}, {"verdict", agreement_name(e.verdict)}, {"reason", e.reason}};
    j["spp"] = e.spp;
    j["seconds"] = e.seconds;
    j["mean"] = e.mean;
    j["difference"] = e.difference;
    j["error"] = e.error;
    j["p"] = e.smallest_p;
    j["tests"] = e.tests;
    j["left_out"] = e.left_out;
    j["failed"] = nlohmann::ordered_json::array();
    for (const RegionTest& t : e.failed)
      j["failed"].push_back({{"channel", std::string(1, "RGB"[t.channel])},
                             {"region", {t.region.x0, t.region.y0, t.region.x1, t.region.y1}},
                             {"mean", t.b},
                             {"reference", t.a},
                             {"p", t.corrected}});
    json["estimators"].push_back(std::move(j));
  }
  return json.dump(2) + "\n";
}

}  // namespace etd
