// A scene as its own test: rendered by every estimator that applies, which must agree. compare() holds each against the
// path tracer's usual way (mis, Sobol).
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/settings.h"
#include "verify/battery/check.h"
#include "verify/statistics/compare.h"

namespace etd {

struct SceneVerifyOptions {
  std::optional<std::pair<int, int>> size;  // otherwise the scene's, made smaller until no side is over 64 pixels
  uint32_t spp = 256;                       // of each estimator
  std::optional<double> seconds;            // for all of them together; then no number of samples is set
  uint64_t seed = 1;
  int threads = 0;             // 0: all cores
  double family_level = 1e-4;  // probability of any false alarm among all tests
  double visible = 0.05;       // an error of this share of the image's mean must be visible to call it agreement
  std::vector<std::pair<std::string, std::string>> set;  // as RenderOverrides::set, for all estimators
};

enum class Agreement : uint8_t {
  kReference,      // what the others are compared with
  kAgrees,         // no test fails, and an error of `visible` would have been seen
  kDisagrees,      // fails, and again in a second run with four times the samples and another seed
  kCannotTell,     // too noisy, or rests on rare bright samples that it may not have met
  kNotApplicable,  // estimates another image in this scene
};
std::string_view agreement_name(Agreement a);

// "G in 8,16 to 16,24: 0.31 against 0.3 (+3.33 %)".
std::string describe_test(const RegionTest& t);

struct EstimatorReport {
  std::string name;
  Agreement verdict = Agreement::kNotApplicable;
  std::string reason;  // of a verdict that needs one; where it disagrees, by how much and how surely
  uint32_t spp = 0;
  double seconds = 0;
  double mean = 0, difference = 0, error = 0;  // of G; the two others relative to the reference's mean
  double smallest_p = 1;                       // of all its tests, corrected for their number
  size_t tests = 0, left_out = 0;              // blocks where too few samples carry the light are left out
  std::vector<RegionTest> failed;              // in the second run, worst first
  std::shared_ptr<const CheckMap> map;         // where it disagrees: its image, the reference's, and their difference
};

struct SceneVerification {
  int width = 0, height = 0;
  std::vector<EstimatorReport> estimators;
  bool complete = true;  // false: interrupted
  bool disagrees() const { return any(Agreement::kDisagrees); }
  bool cannot_tell() const { return any(Agreement::kCannotTell); }

 private:
  bool any(Agreement verdict) const;
};

using SceneProgress = std::function<void(double share, const std::string& what)>;

// Nothing when the scene has errors, which are reported.
std::optional<SceneVerification> verify_scene(const SceneDescription& description, const SceneVerifyOptions& options,
                                              Diagnostics& diagnostics, const SceneProgress& progress,
                                              const std::atomic<bool>& stop);

std::string scene_table(const SceneVerification& v);
std::string scene_json(const SceneVerification& v);

}  // namespace etd
