// Spectra to colours against published numbers and exact identities.
#include <gtest/gtest.h>

#include "params/diagnostics.h"
#include "spectrum/cie_data.h"
#include "spectrum/color_space.h"
#include "spectrum/named.h"
#include "textures/resolve.h"

namespace etd {
namespace {

void expect_rgb(const Spectrum& s, double r, double g, double b, double tolerance) {
  EXPECT_NEAR(s[0], r, tolerance);
  EXPECT_NEAR(s[1], g, tolerance);
  EXPECT_NEAR(s[2], b, tolerance);
}

TEST(Colorimetry, ObserverIntegratesToTheCieSums) {
  // The 5 nm tables sum to 21.37 with 5 nm between rows (CIE 15:2004): 106.86.
  const Vec3d equal = cie_xyz([](double) { return 1.0; });
  EXPECT_NEAR(equal.x, 106.86, 0.05);
  EXPECT_NEAR(equal.y, 106.86, 0.05);
  EXPECT_NEAR(equal.z, 106.84, 0.10);
}

TEST(Colorimetry, IlluminantsHaveTheirPublishedChromaticities) {
  // CIE 15:2004, tables T.3 and T.8; D60 as ACES has it.
  struct Row {
    const char* name;
    double x, y;
  };
  for (const Row& row :
       {Row{"stdillum-A", 0.44758, 0.40745}, Row{"stdillum-D50", 0.34567, 0.35851},
        Row{"stdillum-D65", 0.31272, 0.32903}, Row{"illum-acesD60", 0.32168, 0.33767},
        Row{"stdillum-F1", 0.3131, 0.3371}, Row{"stdillum-F2", 0.3721, 0.3751}, Row{"stdillum-F4", 0.4402, 0.4031},
        Row{"stdillum-F7", 0.3129, 0.3292}, Row{"stdillum-F11", 0.3805, 0.3769}, Row{"stdillum-F12", 0.4370, 0.4042}}) {
    const Chromaticity c = chromaticity(*named_spectrum(row.name));
    // Lamps with lines: the CIE sums rows of 5 nm, while here lines are the triangles that interpolation makes.
    const double tolerance = std::string_view(row.name).find("-F") == std::string_view::npos ? 1e-4 : 1e-3;
    EXPECT_NEAR(c.x, row.x, tolerance) << row.name;
    EXPECT_NEAR(c.y, row.y, tolerance) << row.name;
  }
  EXPECT_EQ(illuminants().size(), 16u);
}

TEST(Colorimetry, WhiteIsD65) {
  expect_rgb(emission_rgb(d65), 1, 1, 1, 1e-5);
  expect_rgb(emission_rgb([](double nm) { return 7.0 * d65(nm); }), 1, 1, 1, 1e-5);
  expect_rgb(reflectance_rgb([](double) { return 0.3; }), 0.3, 0.3, 0.3, 1e-6);
}

TEST(Colorimetry, EqualEnergyWhiteInRec709) {
  // XYZ = (1, 1, 1) through the inverse sRGB matrix: 1.2048, 0.9484, 0.9089 (pbr-book, section 4.6).
  expect_rgb(emission_rgb([](double) { return 1.0; }), 1.2048, 0.9484, 0.9089, 2e-3);
}

TEST(Colorimetry, BlackbodyFollowsWienAndThePlanckianLocus) {
  EXPECT_NEAR(blackbody(2897.771955e3 / 500.0, 500.0), 1.0, 1e-9);  // Wien's displacement law: the peak
  EXPECT_NEAR(blackbody(5000, 400) / blackbody(5000, 700),
              std::pow(7.0 / 4.0, 5) * std::expm1(1.438776877e7 / 5000 / 700) / std::expm1(1.438776877e7 / 5000 / 400),
              1e-12);
  // Chromaticity of 2855.5 K, the definition of illuminant A, and of 6500 K (Wyszecki and Stiles 1982).
  const auto at = [](double kelvin) { return chromaticity([=](double nm) { return blackbody(kelvin, nm); }); };
  EXPECT_NEAR(at(2855.5).x, 0.4476, 2e-4);
  EXPECT_NEAR(at(2855.5).y, 0.4074, 2e-4);
  EXPECT_NEAR(at(6500).x, 0.3135, 2e-4);
  EXPECT_NEAR(at(6500).y, 0.3237, 2e-4);
  EXPECT_NEAR(luminance(emission_rgb([](double nm) { return blackbody(1200, nm); })), 1.0, 1e-5);
  EXPECT_EQ(emission_rgb([](double nm) { return blackbody(1200, nm); })[2], 0.0f);  // outside of Rec.709
}

TEST(NamedSpectra, GlassesHaveTheMakersIndexAndDispersion) {
  struct Row {
    const char* name;
    double nd, vd;
  };
  for (const Row& g :
       {Row{"glass-BK7", 1.5168, 64.17}, Row{"glass-BAF10", 1.67003, 47.11}, Row{"glass-FK51A", 1.48656, 84.47},
        Row{"glass-LASF9", 1.85025, 32.17}, Row{"glass-SF5", 1.67271, 32.25}, Row{"glass-F10", 1.72828, 28.53},
        Row{"glass-SF11", 1.78472, 25.68}}) {
    EXPECT_NEAR(named_glass(g.name).value_or(0), g.nd, 1e-5) << g.name;
    const auto n = *named_spectrum(g.name);
    EXPECT_NEAR((n(587.5618) - 1) / (n(486.1327) - n(656.2725)), g.vd, 0.01) << g.name;
  }
  EXPECT_FALSE(named_glass("glass-X"));
  EXPECT_FALSE(named_spectrum("metal-Cu"));
  EXPECT_FALSE(named_spectrum("metal-Unobtainium-k"));
}

// Johnson and Christy (1972) measured the noble metals independently of the tables that the format names.
TEST(NamedSpectra, MetalsAgreeWithOtherMeasurements) {
  const auto value = [](const char* name, double nm) { return (*named_spectrum(name))(nm); };
  EXPECT_NEAR(value("metal-Au-k", 616.8), 3.272, 0.25);
  EXPECT_NEAR(value("metal-Ag-k", 548.6), 3.586, 0.30);
  EXPECT_NEAR(value("metal-Cu-k", 616.8), 3.205, 0.30);
  EXPECT_NEAR(value("metal-Cu-eta", 495.9), 1.22, 0.15);
  EXPECT_NEAR(value("metal-Al-k", 563.6), 6.78, 0.15);  // Rakic (1995)
  EXPECT_NEAR(value("metal-MgO-eta", 589.3), 1.7374, 1e-3);
  EXPECT_EQ(value("metal-MgO-k", 589.3), 0.0);
  EXPECT_NEAR(value("metal-TiO2-eta", 589.3), 2.91, 0.02);
  EXPECT_NEAR(value("metal-CuZn-eta", 550), 0.527, 1e-6);
}

TEST(NamedSpectra, EveryNameInTheListIsKnown) {
  for (const Illuminant& i : illuminants()) EXPECT_TRUE(named_spectrum(i.name)) << i.name;
  for (const char* m : {"Ag", "Al", "Au", "Cu", "CuZn", "MgO", "TiO2"})
    for (const char* part : {"-eta", "-k"}) EXPECT_TRUE(named_spectrum(std::string("metal-") + m + part)) << m;
}

TEST(ColorSpaces, WhitesAndPrimaries) {
  for (ColorSpace s : {ColorSpace::kSrgb, ColorSpace::kDciP3, ColorSpace::kRec2020, ColorSpace::kAces2065}) {
    const Vec3d white = reflectance_to_rec709(s, {1, 1, 1});
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(white[i], 1.0, 1e-9);
  }
  // BT.2087-0, table 2: Rec.2020 to Rec.709.
  const Vec3d red = emission_to_rec709(ColorSpace::kRec2020, {1, 0, 0});
  EXPECT_NEAR(red.x, 1.6605, 1e-3);
  EXPECT_NEAR(red.y, -0.1246, 1e-3);
  EXPECT_NEAR(red.z, -0.0182, 1e-3);
  // White light of ACES is D60: warmer than Rec.709's white.
  const Vec3d warm = emission_to_rec709(ColorSpace::kAces2065, {1, 1, 1});
  EXPECT_GT(warm.x, 1.0);
  EXPECT_LT(warm.z, 1.0);
  EXPECT_NEAR(luminance(warm.x, warm.y, warm.z), 1.0, 1e-3);
  EXPECT_EQ(find_color_space("rec2020"), ColorSpace::kRec2020);
  EXPECT_FALSE(find_color_space("prophoto"));
}

// Spectra are read through the declared parameters of a model, as scenes use them.
TEST(SpectrumValue, ReadsEveryWayToWriteASpectrum) {
  const ModelDecl decl{Family::kMaterial,
                       "test",
                       "",
                       {{.name = "s", .type = ParamType::kSpectrum, .default_value = std::string("stdillum-D65")}}};
  Diagnostics diagnostics;
  const auto param = [](ParamKind kind, std::vector<double> numbers, std::vector<std::string> strings) {
    Param p;
    p.name = "s", p.kind = kind, p.numbers = std::move(numbers), p.strings = std::move(strings);
    return ModelUse{"test", {p}, {}};
  };
  const auto emitted = [&](const ModelUse& use) { return emission_value({decl, use, diagnostics}, "s"); };
  const auto reflected = [&](const ModelUse& use) { return spectrum_value({decl, use, diagnostics}, "s"); };
  expect_rgb(emitted({"test", {}, {}}), 1, 1, 1, 1e-5);
  expect_rgb(emitted(param(ParamKind::kRgb, {1, 2, 3}, {})), 1, 2, 3, 0);
  EXPECT_NEAR(luminance(emitted(param(ParamKind::kBlackbody, {3000}, {}))), 1.0, 1e-5);
  expect_rgb(emitted(param(ParamKind::kSpectrum, {400, 5, 700, 5}, {})), 1.2048, 0.9484, 0.9089, 5e-3);
  expect_rgb(reflected(param(ParamKind::kSpectrum, {400, 0.5, 700, 0.5}, {})), 0.5, 0.5, 0.5, 1e-6);
  const Spectrum ramp = reflected(param(ParamKind::kSpectrum, {380, 0, 780, 1}, {}));
  EXPECT_GT(ramp[0], ramp[1]);
  EXPECT_GT(ramp[1], ramp[2]);
  const ModelUse copper = param(ParamKind::kSpectrum, {}, {"metal-Cu-k"});
  expect_rgb(reflected(copper), 3.27, 2.59, 2.37, 0.01);
  EXPECT_EQ(diagnostics.all().size(), 0u);
  reflected(param(ParamKind::kSpectrum, {}, {"metal-Xx-k"}));
  EXPECT_EQ(diagnostics.all().size(), 1u);
}

}  // namespace
}  // namespace etd
