// Who decides how many samples each pixel gets: a schedule is asked before each pass, and sees the film so far.
#pragma once

#include <cmath>
#include <optional>

#include "film/film.h"
#include "integrators/pass.h"

namespace etd {

// What ended a render: the last sample, the caller's `stop`, the clock, the error that was asked for, or no memory.
enum class StoppedBy { kSamples, kInterrupt, kTime, kError, kMemory };

// More samples than anybody waits for; a render without a limit of its own runs until something else stops it.
inline constexpr uint32_t kMaxSpp = 1u << 30;

// Samples per pixel before which the error is not tested: fewer do not know their error well enough.
inline constexpr uint32_t kFirstErrorTest = 32;

class Schedule {
 public:
  struct SoFar {
    const Film& film;
    double error = HUGE_VAL;  // estimated_error() of it
  };

  virtual ~Schedule() = default;
  // The samples of the next pass, in each replicate; nothing when no more are wanted.
  virtual std::optional<Pass> next(const SoFar& so_far) = 0;
  // Why next() had nothing.
  virtual StoppedBy reason() const { return StoppedBy::kSamples; }
  // How many samples of each replicate a pixel will have in the end, as far as can be told.
  virtual double expected(const SoFar& so_far) const = 0;
  // How often the film so far could have ended it: that selects films, and so is a bias.
  virtual uint32_t error_tests() const { return 0; }
};

// All pixels alike, up to this many samples of each replicate.
class UniformSchedule : public Schedule {
 public:
  explicit UniformSchedule(uint32_t samples) : samples_(samples) {}
  std::optional<Pass> next(const SoFar&) override;
  double expected(const SoFar&) const override { return samples_; }

 private:
  uint32_t samples_;
  std::optional<Pass> last_;
};

// This one does as another schedule does, until the error is no larger than a goal where tests_error() has it tested.
class UntilError : public Schedule {
 public:
  UntilError(Schedule& schedule, double goal, uint32_t replicates)
      : schedule_(schedule), goal_(goal), replicates_(replicates) {}
  std::optional<Pass> next(const SoFar& so_far) override;
  StoppedBy reason() const override { return reached_ ? StoppedBy::kError : schedule_.reason(); }
  double expected(const SoFar& so_far) const override;
  uint32_t error_tests() const override { return tests_; }

 private:
  Schedule& schedule_;
  double goal_;
  uint32_t replicates_, done_ = 0, tests_ = 0;  // done_: samples of each replicate that were planned so far
  bool reached_ = false;
};

// The passes for n samples per replicate: [0,1), [1,2), [2,4), [4,8), [8,16), then steps of 16, the last one cut to n.
Pass first_pass(uint32_t samples_per_replicate);
// The one after `last`; it begins at n when there is none.
Pass next_pass(const Pass& last, uint32_t samples_per_replicate);

// Whether stopping by error is considered after this many samples per replicate: at the powers of two, which end
// passes, from 32 samples per pixel on. These are 32 2^k samples per pixel when the replicates are a power of two.
bool tests_error(uint32_t samples_per_replicate, uint32_t replicates);

}  // namespace etd
