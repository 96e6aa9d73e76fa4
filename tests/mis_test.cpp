// Weights of multiple importance sampling: whatever the densities, those of the two techniques sum to 1, and one that
// is alone has all of it.
#include "core/mis.h"

#include <gtest/gtest.h>

namespace etd {
namespace {

constexpr MisHeuristic kAll[] = {MisHeuristic::kPower, MisHeuristic::kBalance, MisHeuristic::kMaximum,
                                 MisHeuristic::kUniform};
constexpr float kDensities[] = {0.0f, 1e-38f, 1e-12f, 0.3f, 0.31f, 1.0f, 70.0f, 1e19f, 3e38f, HUGE_VALF};

TEST(Mis, WeightsSumToOne) {
  for (const MisHeuristic h : kAll)
    for (const float a : kDensities)
      for (const float b : kDensities) {
        if (a == 0 && b == 0) continue;
        EXPECT_FLOAT_EQ(mis_weight(h, a, b) + mis_weight(h, b, a), 1.0f)
            << "heuristic " << static_cast<int>(h) << ", densities " << a << " and " << b;
      }
}

TEST(Mis, ATechniqueThatIsAloneHasAllTheWeight) {
  for (const MisHeuristic h : kAll)
    for (const float a : kDensities) EXPECT_EQ(mis_weight(h, a, 0.0f), a > 0 ? 1.0f : 0.0f) << a;
}

TEST(Mis, HeuristicsByHand) {
  EXPECT_FLOAT_EQ(mis_weight(MisHeuristic::kPower, 3, 1), 0.9f);
  EXPECT_FLOAT_EQ(mis_weight(MisHeuristic::kBalance, 3, 1), 0.75f);
  EXPECT_EQ(mis_weight(MisHeuristic::kMaximum, 3, 1), 1.0f);
  EXPECT_EQ(mis_weight(MisHeuristic::kUniform, 3, 1), 0.5f);
}

}  // namespace
}  // namespace etd
