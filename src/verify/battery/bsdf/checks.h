// The parts of the battery over closures, one file each: values at single directions, delta lobes, histograms. Only
// bsdf.cpp calls them.
#pragma once

#include <vector>

#include "verify/battery/bsdf/bsdf.h"
#include "verify/battery/worst.h"

namespace etd::bsdf_checks {

// Directions on both sides that a check must cover: perpendicular, oblique at several azimuths, grazing.
const std::vector<Vec3>& test_directions();
std::string describe(Vec3 wo, TransportMode mode, Lobe sides = kBothSides);

using Results = std::vector<CheckResult>;
// Finite and non-negative for the most awkward directions and random numbers.
void check_finite(const ScatterModel& model, Results& out);
// weight pdf = eval_cos, sample().pdf = pdf(), unit wi, the right sides and lobes; reciprocity and adjointness.
void check_pointwise(const ScatterModel& model, uint64_t seed, Results& out);
// Directions (mirror, Snell), probabilities, reciprocity and energy of delta lobes; of tilted surfaces instead that
// importance is adjoint.
void check_delta(const ScatterModel& model, Results& out);
// Samples against the density and the integrals of eval_cos over the sphere; energy.
void check_histograms(const ScatterModel& model, const BsdfBatteryOptions& options, Results& out);

// Checks stochastic models, instead of the three above: weighted samples against averaged values, reciprocity, energy.
void check_stochastic(const ScatterModel& model, const BsdfBatteryOptions& options, Results& out);

// The delta lobes that wo scatters into, each with the share of samples that took it. They are found by walking u.z
// through [0, 1) in `kDeltaSteps` steps, so shares are exact up to that.
struct DeltaLobe {
  BsdfSample sample;
  double share = 0;
};
inline constexpr int kDeltaSteps = 2000;
std::vector<DeltaLobe> find_delta_lobes(const ScatterModel& model, Vec3 wo, TransportMode mode, Lobe sides);

}  // namespace etd::bsdf_checks
