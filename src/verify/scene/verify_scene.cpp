#include "verify/scene/verify_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>

#include "integrators/make_integrator.h"
#include "render/registry.h"
#include "render/session.h"
#include "scene/scene.h"
#include "verify/scene/extrapolate.h"
#include "verify/scene/sample_peaks.h"
#include "verify/statistics/film_mean.h"

namespace etd {

namespace {

constexpr uint32_t kReplicates = 32;
constexpr int kLargestSide = 64;
// Fewer samples than this that carry a region's light are not normally distributed in the mean.
constexpr double kEffectiveSamples = 50;
constexpr size_t kChannels = 3;
constexpr uint64_t kHalfRadiusSeed = 1;
// One of the two renders of an estimator: what fails is rendered again, with other seeds and more samples.
struct Run {
  uint64_t number = 0;  // of the estimator
  bool again = false;
  uint64_t salt = 0;  // for seeds of its own
  uint32_t more() const { return again ? 4 : 1; }
};

// Parameters that the first integrator has and others do not have are for the first alone; those that it does not have
// either are wrong.
bool applies(const std::string& key, const Variant& e) {
  constexpr std::string_view kFamily = "integrator.";
  const ModelDecl* model = find_any_model(Family::kIntegrator, e.integrator);
  const ModelDecl* first = all_models(Family::kIntegrator).front();
  if (!key.starts_with(kFamily) || !model) return true;
  const std::string name = key.substr(kFamily.size());
  return model->find(name) || !first->find(name);
}

RenderOverrides overrides_for(const Variant& e, const SceneVerifyOptions& options, std::pair<int, int> size,
                              const Run& run, size_t estimators) {
  RenderOverrides o;
  o.size = size;
  if (options.seconds)
    o.seconds = *options.seconds * run.more() / static_cast<double>(estimators);
  else
    o.spp = options.spp * run.more();
  o.replicates = kReplicates;
  o.seed = hash_combine(options.seed, run.number, run.again ? 1 : 0, run.salt);
  o.threads = options.threads;
  o.tile_size = 8;
  o.features = false;
  o.sampler = e.sampler;
  o.integrator = e.integrator;
  for (const auto& [key, value] : options.set)
    if (applies(key, e)) o.set.emplace_back(key, value);
  for (const auto& [name, value] : e.set) o.set.emplace_back("integrator." + name, value);
  return o;
}

class ProgressObserver : public RenderObserver {
 public:
  ProgressObserver(const SceneProgress& progress, std::string what, double from, double to)
      : progress_(progress), what_(std::move(what)), from_(from), to_(to) {}
  void on_pass_end(const RenderProgress& p) override { progress_(from_ + (to_ - from_) * p.share, what_); }

 private:
  const SceneProgress& progress_;
  std::string what_;
  double from_, to_;
};

// A region in which two films were compared, and what speaks for chance.
struct Weighed {
  RegionTest test;
  bool usable = true;  // enough samples carry the light of both
  double p = 1;        // corrected; the larger one of Welch's and of what rare bright samples leave possible
};

struct Weighing {
  std::vector<Weighed> regions;  // the whole image in R, G and B first
  std::vector<HistogramTest> histograms;
};

double samples_in(const Film& film, const PixelBounds& r) {
  double n = 0;
  for (int y = r.y0; y < r.y1; ++y)
    for (int x = r.x0; x < r.x1; ++x) n += film.total(x, y).count;
  return n;
}

Weighing weigh(const Film& reference, const Film& other, double peak_reference, double peak_other, double level) {
  Verdict verdict = compare(make_estimate(reference), make_estimate(other), {.level = level});
  std::vector<RegionTest> tests = std::move(verdict.image);
  tests.insert(tests.end(), verdict.blocks.begin(), verdict.blocks.end());
  const PixelBounds& crop = reference.settings().crop;
  Weighing all{{}, std::move(verdict.histograms)};
  for (RegionTest& t : tests) {
    t.region = {t.region.x0 + crop.x0, t.region.y0 + crop.y0, t.region.x1 + crop.x0, t.region.y1 + crop.y0};
    const bool both_dark = t.a == 0.0 && t.b == 0.0;
    const bool usable = both_dark || std::min(effective_samples(reference, t.region),
                                              effective_samples(other, t.region)) >= kEffectiveSamples;
    const auto chance_of = [&](const Film& film, double low, double high, double peak) {
      return film.settings().correlated ? 0.0 : chance_of_low_mean(low, high, samples_in(film, t.region), peak);
    };
    const double chance =
        t.b < t.a ? chance_of(other, t.b, t.a, peak_other) : chance_of(reference, t.a, t.b, peak_reference);
    const double p = std::max(t.corrected, std::min(1.0, chance * static_cast<double>(tests.size())));
    all.regions.push_back({t, usable, p});
  }
  return all;
}

// The smallest relative error of the image's mean that would be seen; infinite when it would have to be over 1.
double smallest_visible(const std::vector<Weighed>& regions, double level) {
  double worst = 0;
  for (size_t i = 0; i < kChannels; ++i) {
    const RegionTest& t = regions[i].test;
    const double mean = std::max(t.a, t.b);
    if (mean == 0.0) continue;
    double visible = HUGE_VAL;
    for (double e = 1.0; e > 1e-4 && would_be_seen(e, mean, t.error, t.result.dof, level); e *= 0.9) visible = e;
    worst = std::max(worst, visible);
  }
  return worst;
}

// The film's luminance and the other's beside the worst test of each block.
CheckMap picture_of(const Film& reference, const Film& other, const std::vector<Weighed>& regions) {
  const PixelBounds& crop = reference.settings().crop;
  CheckMap map;
  map.width = crop.width(), map.height = crop.height();
  map.axes = "the image";
  map.sigmas.assign(static_cast<size_t>(map.width * map.height), 0.0f);
  for (int y = crop.y0; y < crop.y1; ++y)
    for (int x = crop.x0; x < crop.x1; ++x) {
      map.sampled.push_back(static_cast<float>(other.total(x, y).mean_radiance()[3]));
      map.expected.push_back(static_cast<float>(reference.total(x, y).mean_radiance()[3]));
    }
  for (size_t i = kChannels; i < regions.size(); ++i) {
    const PixelBounds& r = regions[i].test.region;
    const auto z = static_cast<float>(regions[i].test.result.statistic);
    for (int y = r.y0; y < r.y1; ++y)
      for (int x = r.x0; x < r.x1; ++x) {
        float& sigmas = map.sigmas[static_cast<size_t>((y - crop.y0) * map.width + x - crop.x0)];
        if (regions[i].usable && std::abs(z) > std::abs(sigmas)) sigmas = z;
      }
  }
  return map;
}

// All that stays the same while a scene is verified.
class SceneVerifier {
 public:
  SceneVerifier(const SceneDescription& description, const SceneVerifyOptions& options, Diagnostics& diagnostics,
                const SceneProgress& progress, const std::atomic<bool>& stop)
      : description_(description), options_(options), diagnostics_(diagnostics), progress_(progress), stop_(stop) {}

  std::optional<SceneVerification> run() {
    if (!compile_scene()) return {};
    SceneVerification v;
    v.width = size_.first, v.height = size_.second;
    const FinishedRender* usual = reference_for(estimators_[0], false);
    if (!usual) return {};
    for (size_t i = 0; i < estimators_.size() && !stop_; ++i) {
      EstimatorReport report;
      report.name = estimators_[i].name;
      if (i == 0) {
        report.verdict = Agreement::kReference;
        describe(*usual, *usual, report);
      } else if (!estimators_[i].not_applicable.empty()) {
        report.reason = estimators_[i].not_applicable;
      } else if (!compare(i, report)) {
        return {};
      }
      if (!stop_) v.estimators.push_back(std::move(report));
    }
    v.complete = !stop_;
    return v;
  }

 private:
  bool compile_scene() {
    const Variant as_in_scene{.name = "", .integrator = std::string(all_models(Family::kIntegrator).front()->name)};
    RenderOverrides o = overrides_for(as_in_scene, options_, options_.size.value_or(std::pair{0, 0}), {}, 1);
    if (!options_.size) o.size.reset();
    const FilmSettings s = make_settings(description_, o, diagnostics_).film;
    size_ = {s.width, s.height};
    if (const int side = std::max(s.width, s.height); !options_.size && side > kLargestSide)
      size_ = {std::max(1, s.width * kLargestSide / side), std::max(1, s.height * kLargestSide / side)};
    o.size = size_;
    const auto prepared = prepare_render(description_, o, diagnostics_);
    if (!prepared) return false;
    compiled_ = prepared->compiled;
    const Param* depth = prepared->settings.integrator.find("maxdepth");
    estimators_ = integrator_variants(*compiled_.scene, depth && depth->integers.size() == 1 ? depth->integers[0] : 5);
    level_ = bonferroni_level(options_.family_level, estimators_.size() - 1);
    peaks_ = find_sample_peaks(*compiled_.scene, size_.first, size_.second);
    return true;
  }

  std::optional<FinishedRender> render(const Variant& e, const Run& run) {
    auto prepared = prepare_render(description_, overrides_for(e, options_, size_, run, estimators_.size()),
                                   diagnostics_, compiled_);
    if (!prepared) return {};
    const double step = 1.0 / static_cast<double>(estimators_.size()), from = static_cast<double>(run.number) * step;
    ProgressObserver observer(progress_, e.name + (run.again ? ", again" : ""), from, from + step);
    return run_render(*prepared, observer, &stop_);
  }

  // Does what render() does, and takes off what the square of a radius adds to the light.
  std::optional<FinishedRender> render_unbiased(const Variant& e, const Run& run) {
    auto film = render(e, run);
    if (!film || e.with_half_radius.empty()) return film;
    Variant half = e;
    half.set.insert(half.set.end(), e.with_half_radius.begin(), e.with_half_radius.end());
    const auto with_half = render(half, {run.number, run.again, kHalfRadiusSeed});
    if (!with_half) return {};
    film->film = extrapolate_to_no_radius(film->film, with_half->film);
    return film;
  }

  // The usual way to estimate the image that `e` estimates. Null when it cannot be rendered, which is reported.
  const FinishedRender* reference_for(const Variant& e, bool again) {
    for (const Reference& r : references_)
      if (r.image_of_path == e.image_of_path && r.again == again) return &r.render;
    Variant usual = estimators_[0];
    usual.set.insert(usual.set.end(), e.image_of_path.begin(), e.image_of_path.end());
    auto rendered = render(usual, {.again = again});
    if (!rendered) return nullptr;
    return &references_.emplace_back(Reference{e.image_of_path, again, std::move(*rendered)}).render;
  }

  double peak_of(const Variant& e) const { return e.samples_lights_alone ? peaks_.light : peaks_.scattering; }

  static void describe(const FinishedRender& reference, const FinishedRender& other, EstimatorReport& report) {
    const Quantity green{Quantity::Component::kBeauty, 1};
    const RunningStats a = image_mean(reference.film, green), b = image_mean(other.film, green);
    report.spp = other.result.spp;
    report.seconds = other.result.seconds;
    report.mean = b.mean();
    if (a.mean() == 0.0) return;
    report.difference = b.mean() / a.mean() - 1.0;
    report.error = std::sqrt((&reference == &other ? 0.0 : a.variance_of_mean()) + b.variance_of_mean()) / a.mean();
  }

  // False when the estimator cannot be rendered, which is reported.
  bool compare(size_t i, EstimatorReport& report) {
    const Variant& e = estimators_[i];
    // Once more where it disagrees, with four times the samples and other seeds: chance does not strike twice.
    for (const bool again : {false, true}) {
      const FinishedRender* reference = reference_for(e, again);
      const auto film = render_unbiased(e, {i, again});
      if (!reference || !film) return false;
      describe(*reference, *film, report);
      const Weighing weighing = weigh(reference->film, film->film, peak_of(estimators_[0]), peak_of(e), level_);
      judge(weighing, report);
      if (report.verdict != Agreement::kDisagrees || stop_) return true;
      if (again)
        report.map = std::make_shared<const CheckMap>(picture_of(reference->film, film->film, weighing.regions));
    }
    return true;
  }

  void judge(const Weighing& weighing, EstimatorReport& report) const {
    report.failed.clear();
    report.left_out = report.tests = 0;
    report.smallest_p = 1;
    const Weighed* excused = nullptr;  // fails, but rare samples may be missing
    std::string reason;                // of failing
    for (const Weighed& w : weighing.regions) {
      ++(w.usable ? report.tests : report.left_out);
      if (w.test.corrected < level_ && (!w.usable || w.p >= level_) && !excused) excused = &w;
      if (!w.usable) continue;
      if (w.p < report.smallest_p) {
        report.smallest_p = w.p;
        if (w.p < level_) reason = "most surely " + describe_test(w.test) + fmt::format(", p = {:.1e}", w.p);
      }
      if (w.p < level_) report.failed.push_back(w.test);
    }
    std::sort(report.failed.begin(), report.failed.end(),
              [](const RegionTest& a, const RegionTest& b) { return a.result.p_value < b.result.p_value; });
    // Rare samples spoil the histogram too.
    for (const HistogramTest& h : weighing.histograms) {
      if (report.left_out > 0 || excused || h.corrected >= report.smallest_p) continue;
      report.smallest_p = h.corrected;
      if (h.corrected < level_ && report.failed.empty())
        reason = fmt::format("by little all over the image: {} of {} p-values of blocks are below {}, p = {:.1e}",
                             h.below, h.blocks, h.threshold, h.corrected);
    }
    const double visible = smallest_visible(weighing.regions, level_ / static_cast<double>(kChannels));
    const RegionTest& image = weighing.regions[1].test;
    report.verdict = Agreement::kCannotTell;
    if (!reason.empty()) {
      report.verdict = Agreement::kDisagrees;
      report.reason = reason;
    } else if (image.a == 0.0 && image.b == 0.0) {
      report.reason = "the image is black";
    } else if (excused) {
      report.reason = describe_test(excused->test) + ", but it rests on rare bright samples of which too few were met";
    } else if (visible > options_.visible) {
      report.reason =
          std::isfinite(visible)
              ? fmt::format("too noisy: errors of the image below {:.0f} % would not be seen", 100 * visible)
              : std::string("too noisy: not even an image twice as bright would be seen");
    } else {
      report.verdict = Agreement::kAgrees;
      report.reason = fmt::format("an error of the image of {:.1f} % would be seen", 100 * visible);
      if (report.left_out > 0)
        report.reason += fmt::format("; {} tests of blocks where light is rare are left out", report.left_out);
    }
  }

  const SceneDescription& description_;
  const SceneVerifyOptions& options_;
  Diagnostics& diagnostics_;
  const SceneProgress& progress_;
  const std::atomic<bool>& stop_;

  std::pair<int, int> size_;
  CompiledScene compiled_;
  std::vector<Variant> estimators_;
  double level_ = 0;
  SamplePeaks peaks_;
  // What has been rendered so far to compare with.
  struct Reference {
    ParameterTexts image_of_path;
    bool again;
    FinishedRender render;
  };
  std::deque<Reference> references_;
};

}  // namespace

bool SceneVerification::any(Agreement verdict) const {
  return std::any_of(estimators.begin(), estimators.end(),
                     [verdict](const EstimatorReport& e) { return e.verdict == verdict; });
}

std::string describe_test(const RegionTest& t) {
  const PixelBounds& r = t.region;
  return fmt::format("{} in {},{} to {},{}: {:.5g} against {:.5g} ({:+.2f} %)", "RGB"[t.channel], r.x0, r.y0, r.x1,
                     r.y1, t.b, t.a, 100 * (t.b / t.a - 1));
}

std::string_view agreement_name(Agreement a) {
  switch (a) {
    case Agreement::kReference:
      return "reference";
    case Agreement::kAgrees:
      return "agrees";
    case Agreement::kDisagrees:
      return "DISAGREES";
    case Agreement::kCannotTell:
      return "cannot tell";
    default:
      return "does not apply";
  }
}

std::optional<SceneVerification> verify_scene(const SceneDescription& description, const SceneVerifyOptions& options,
                                              Diagnostics& diagnostics, const SceneProgress& progress,
                                              const std::atomic<bool>& stop) {
  return SceneVerifier(description, options, diagnostics, progress, stop).run();
}

}  // namespace etd
