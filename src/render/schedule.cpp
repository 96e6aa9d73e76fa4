#include "render/schedule.h"

#include <algorithm>

#include "core/math.h"

namespace etd {

namespace {

constexpr uint32_t kLongestPass = 16;  // samples per replicate: keeps items short enough to stop soon

Pass cut_pass(uint32_t index, uint32_t begin, uint32_t length, uint32_t samples) {
  return {.index = index, .begin = begin, .end = begin + std::min(length, samples - std::min(begin, samples))};
}

}  // namespace

Pass first_pass(uint32_t samples_per_replicate) { return cut_pass(0, 0, 1, samples_per_replicate); }

Pass next_pass(const Pass& last, uint32_t samples_per_replicate) {
  return cut_pass(last.index + 1, last.end, std::clamp(last.end, 1u, kLongestPass), samples_per_replicate);
}

bool tests_error(uint32_t samples_per_replicate, uint32_t replicates) {
  const bool power_of_two = (samples_per_replicate & (samples_per_replicate - 1)) == 0;
  return power_of_two && uint64_t{samples_per_replicate} * replicates >= kFirstErrorTest;
}

std::optional<Pass> UniformSchedule::next(const SoFar&) {
  const Pass pass = last_ ? next_pass(*last_, samples_) : first_pass(samples_);
  if (pass.begin >= samples_) return {};
  last_ = pass;
  return pass;
}

std::optional<Pass> UntilError::next(const SoFar& so_far) {
  const std::optional<Pass> pass = schedule_.next(so_far);
  if (!pass) return {};
  if (tests_error(done_, replicates_)) {
    ++tests_;
    reached_ = so_far.error <= goal_;
  }
  if (reached_) return {};
  done_ = pass->end;
  return pass;
}

// The samples at which the error will be found small enough, if its square goes on falling like 1/n.
double UntilError::expected(const SoFar& so_far) const {
  const double otherwise = schedule_.expected(so_far);
  if (!std::isfinite(so_far.error)) return otherwise;
  const double needed = std::max(done_ * sqr(so_far.error / goal_), double{kFirstErrorTest} / replicates_);
  return std::min(otherwise, std::exp2(std::ceil(std::log2(std::max(needed, 1.0)))));
}

}  // namespace etd
