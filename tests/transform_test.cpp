#include "core/transform.h"

#include <gtest/gtest.h>

namespace etd {
namespace {

TEST(Transform, InverseUndoesAChainOfTransforms) {
  const Transform t =
      Transform::translate({1, 2, 3}) * Transform::rotate(37, {1, 2, -1}) * Transform::scale({2, -3, 0.5});
  const Point3d p = t.inverse().point(t.point({0.3, -0.7, 5.0}));
  EXPECT_NEAR(p.x, 0.3, 1e-13);
  EXPECT_NEAR(p.y, -0.7, 1e-13);
  EXPECT_NEAR(p.z, 5.0, 1e-13);
  EXPECT_LT(t.determinant3(), 0.0);
}

TEST(Transform, LookAtPutsTheTargetOnPositiveZ) {
  const Transform t = Transform::look_at({1, 1, 1}, {4, 1, 1}, {0, 1, 0});
  const Point3d p = t.point({4, 1, 1});
  EXPECT_NEAR(p.z, 3.0, 1e-14);
  EXPECT_NEAR(t.vector({0, 1, 0}).y, 1.0, 1e-14);
}

TEST(Transform, SingularOnesSayso) {
  EXPECT_TRUE(Transform::scale({1, 0, 1}).is_singular());
  EXPECT_TRUE(Transform::look_at({0, 0, 0}, {0, 1, 0}, {0, 1, 0}).is_singular());
  EXPECT_TRUE((Transform::translate({1, 0, 0}) * Transform::scale({0, 1, 1})).is_singular());
  EXPECT_FALSE(Transform::rotate(10, {0, 1, 0}).is_singular());
}

}  // namespace
}  // namespace etd
