// Rendering one component alone gives the bits of that layer in the whole render: leaving the others out changes no
// random number of the paths that remain.
#include <gtest/gtest.h>

#include "render_helper.h"

namespace etd {
namespace {

Film render_components(const std::string& components) {
  RenderOverrides overrides;
  overrides.size = {{24, 24}};
  overrides.spp = 8;
  overrides.set = {{"integrator.components", components}};
  return render_scene(source_path("scenes/cornell-box/cornell-box.pbrt"), overrides);
}

TEST(Components, OneAloneIsTheLayerOfTheWhole) {
  const Film all = render_components("all"), emission = render_components("emission"),
             direct = render_components("direct"), indirect = render_components("indirect");
  double total_indirect = 0;
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 24; ++x) {
      const PixelSums whole = all.total(x, y);
      EXPECT_EQ(emission.total(x, y).emission, whole.emission);
      EXPECT_EQ(direct.total(x, y).direct, whole.direct);
      EXPECT_EQ(indirect.total(x, y).indirect, whole.indirect);
      const std::array<double, 3> none{};
      EXPECT_EQ(emission.total(x, y).direct, none);
      EXPECT_EQ(emission.total(x, y).indirect, none);
      EXPECT_EQ(direct.total(x, y).emission, none);
      EXPECT_EQ(direct.total(x, y).indirect, none);
      EXPECT_EQ(indirect.total(x, y).emission, none);
      EXPECT_EQ(indirect.total(x, y).direct, none);
      total_indirect += whole.indirect[1];
    }
  EXPECT_GT(total_indirect, 0);
}

}  // namespace
}  // namespace etd
