// Materials without a closed form: naive, next_event and mis estimate the same integral, so they must agree.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "render_helper.h"

namespace etd {
namespace {

struct Case {
  const char* name;
  const char* material;
  uint32_t spp;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class MaterialsAgree : public testing::TestWithParam<Case> {};

// A sphere of the material between a lamp and a diffuse floor.
TEST_P(MaterialsAgree, InAllModes) {
  const std::string scene = fmt::format(R"(
LookAt 0 -5 2  0 0 0.8  0 0 1
Camera "perspective" "float fov" 30
Film "rgb" "integer xresolution" 8 "integer yresolution" 8
Integrator "path" "integer maxdepth" 4
WorldBegin
LightSource "infinite" "rgb L" [ 0.3 0.4 0.5 ]
AttributeBegin
AreaLightSource "diffuse" "rgb L" [ 4 3 2 ]
Shape "trianglemesh" "point3 P" [ -2 -2 4  2 -2 4  2 2 4  -2 2 4 ] "integer indices" [ 0 2 1 0 3 2 ]
AttributeEnd
Material "diffuse" "rgb reflectance" [ 0.5 0.5 0.5 ]
Shape "trianglemesh" "point3 P" [ -9 -9 0  9 -9 0  9 9 0  -9 9 0 ] "integer indices" [ 0 1 2 0 2 3 ]
{}
Translate 0 0 1
Shape "sphere"
)",
                                        GetParam().material);
  std::vector<RunningStats> means;
  for (const char* mode : {"naive", "next_event", "mis"}) {
    RenderOverrides o;
    o.spp = GetParam().spp;
    o.replicates = 32;
    o.seed = means.size() + 1;
    o.features = false;
    o.set = {{"integrator.mode", mode}};
    means.push_back(image_mean(render_text(scene, "tests/scenes", o)));
  }
  for (size_t i = 0; i < 2; ++i) {
    const TestResult t = welch_test(means[i], means[2]);
    EXPECT_GT(t.p_value, 1e-5) << means[i].mean() << " and " << means[2].mean();
    EXPECT_LT(std::sqrt(means[i].variance_of_mean()), 0.01 * means[i].mean()) << "the test could not see 3 %";
  }
}

INSTANTIATE_TEST_SUITE_P(
    Spheres, MaterialsAgree,
    testing::Values(
        Case{"frosted", R"(Material "dielectric" "float roughness" 0.2)", 6144},
        Case{"frosted_anisotropic", R"(Material "dielectric" "float uroughness" 0.05 "float vroughness" 0.3)", 6144},
        Case{"plastic", R"(Material "coateddiffuse" "rgb reflectance" [ 0.6 0.3 0.2 ])", 2048},
        Case{"satin_milky", R"(Material "coateddiffuse" "rgb reflectance" [ 0.6 0.3 0.2 ] "float roughness" 0.1
                                           "rgb albedo" [ 0.8 0.6 0.4 ] "float thickness" 0.5 "float g" 0.3)",
             2048},
        Case{"lacquer", R"(Material "coatedconductor" "float interface.roughness" 0.05
                                       "float conductor.roughness" 0.1)",
             4096},
        Case{"paper", R"(Material "diffusetransmission" "rgb transmittance" [ 0.5 0.4 0.3 ])", 2048},
        Case{"gold", R"(Material "conductor" "spectrum eta" "metal-Au-eta" "spectrum k" "metal-Au-k"
                                    "float roughness" 0.1)",
             2048}),
    [](const testing::TestParamInfo<Case>& i) { return std::string(i.param.name); });

}  // namespace
}  // namespace etd
