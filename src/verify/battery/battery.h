// The whole battery as a list: every registered model in all the settings in which it is tested. A new model appears
// here by itself, through the registry or the example list of its family.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "verify/battery/check.h"

namespace etd {

struct BatteryOptions {
  double samples = 1;          // factor on the usual numbers of samples
  uint64_t seed = 1;           // of the random numbers; every seed must pass
  double family_level = 1e-5;  // probability of any false alarm among the checks of one subject
};

// One model with one set of parameters.
struct BatterySubject {
  std::string family, model;  // "material", "conductor": as `etendue verify` takes them
  std::string name;           // with the parameters
  std::function<std::vector<CheckResult>(const BatteryOptions&)> check;  // judged
};

// One function for each family, in the file or the folder of its name.
std::vector<BatterySubject> warp_subjects();
std::vector<BatterySubject> sampler_subjects();
std::vector<BatterySubject> filter_subjects();
std::vector<BatterySubject> camera_subjects();
std::vector<BatterySubject> texture_subjects();
std::vector<BatterySubject> phase_subjects();
std::vector<BatterySubject> bsdf_subjects();
std::vector<BatterySubject> material_subjects();
std::vector<BatterySubject> light_subjects();
std::vector<BatterySubject> light_sampler_subjects();

// All of them.
std::vector<BatterySubject> battery_subjects();

// Checks a subject. If only statistics speak against it, once more with four times the samples and another seed: that
// run decides, and shows both results. Each run has the level repeated_level(family_level), which both together keep.
std::vector<CheckResult> run_subject(const BatterySubject& subject, BatteryOptions options);

}  // namespace etd
