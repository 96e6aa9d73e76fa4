// The materials: from parameters and textures to closures; and closures placed on surfaces whose shading normal is not
// the geometric one.
#include "materials/material.h"

#include <gtest/gtest.h>

#include "bsdfs/bsdf_list.h"
#include "bsdfs/examples.h"
#include "core/warp.h"
#include "materials/bent_normal.h"
#include "materials/material_data.h"
#include "materials/surface_scatter.h"
#include "model_uses.h"
#include "temp_folder.h"

namespace etd {
namespace {

// Outlives all closures.
MaterialData data;

// The closure of a checked material without textures.
Bsdf closure(const ModelUse& use) {
  Diagnostics diagnostics;
  for (const ModelDecl* decl : material_models())
    if (decl->name == use.model) check_params(*decl, use, diagnostics);
  TextureTable table;
  TextureBuilder builder(table, {});
  const auto material = make_material(use, builder, data, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors()) << diagnostics.format_all();
  return material->closure({}, table, {});
}

int errors_of(const ModelUse& use) {
  Diagnostics diagnostics;
  TextureTable table;
  TextureBuilder builder(table, {});
  make_material(use, builder, data, diagnostics);
  return diagnostics.error_count();
}

const Vec3 kUp{0, 0, 1};

TEST(ConductorMaterial, ReflectanceAtNormalIncidence) {
  for (const double r : {0.0, 1e-4, 0.1, 0.5, 0.9, 0.99, 1.0}) {
    const Bsdf b = closure(use_of("conductor", {rgb("reflectance", r, r / 2, 0)}));
    EXPECT_FALSE(b.has_smooth_lobe());
    EXPECT_NEAR(b.albedo(kUp)[0], std::min(r, 0.9999), 1e-6);
    EXPECT_NEAR(b.albedo(kUp)[1], r / 2, 1e-6);
    EXPECT_NEAR(b.albedo(kUp)[2], 0, 1e-6);
    if (r >= 0.1) {
      EXPECT_GT(b.albedo(normalize(Vec3{1, 0, 0.001f}))[1], 0.98f);  // towards 1 at grazing angles
    }
  }
}

TEST(ConductorMaterial, CopperByDefault) {
  const Bsdf b = closure(use_of("conductor"));
  const Bsdf copper = closure(use_of(
      "conductor", {text("eta", "metal-Cu-eta", ParamKind::kSpectrum), text("k", "metal-Cu-k", ParamKind::kSpectrum)}));
  for (int i = 0; i < 3; ++i) EXPECT_EQ(b.albedo(kUp)[i], copper.albedo(kUp)[i]);
  EXPECT_GT(b.albedo(kUp)[0], b.albedo(kUp)[2] + 0.2f);  // reddish
}

TEST(ConductorMaterial, RoughnessAndItsRemapping) {
  const auto same = [](const Bsdf& a, const Bsdf& b) {
    HashStream rng(0);
    const Vec3 wo = normalize(Vec3{0.3f, 0.1f, 0.8f}), wi = normalize(Vec3{-0.2f, 0.1f, 0.7f});
    return a.eval_cos(wo, wi, TransportMode::kRadiance, rng)[0] == b.eval_cos(wo, wi, TransportMode::kRadiance, rng)[0];
  };
  const Bsdf remapped = closure(use_of("conductor", {number("roughness", 0.25)}));
  EXPECT_TRUE(remapped.has_smooth_lobe());
  EXPECT_TRUE(
      same(remapped, closure(use_of("conductor", {number("roughness", 0.5), boolean("remaproughness", false)}))));
  const Bsdf along_u = closure(use_of("conductor", {number("roughness", 0.25), number("uroughness", 0.04)}));
  EXPECT_TRUE(same(along_u, closure(use_of("conductor", {number("uroughness", 0.04), number("vroughness", 0.25)}))));
  EXPECT_FALSE(same(along_u, closure(use_of("conductor", {number("uroughness", 0.25), number("vroughness", 0.04)}))));
  EXPECT_FALSE(closure(use_of("conductor", {number("roughness", 9e-7)})).has_smooth_lobe());  // alpha 9.5e-4
  EXPECT_TRUE(closure(use_of("conductor", {number("roughness", 1.1e-6)})).has_smooth_lobe());
  EXPECT_FALSE(
      closure(use_of("conductor", {number("roughness", 9e-4), boolean("remaproughness", false)})).has_smooth_lobe());
}

TEST(ConductorMaterial, EitherReflectanceOrIndices) {
  EXPECT_EQ(errors_of(use_of("conductor", {number("reflectance", 0.5), number("eta", 1)})), 1);
}

TEST(DielectricMaterial, IndicesByNumberAndName) {
  const auto reflectance = [](const ModelUse& use) {
    HashStream rng(0);
    const auto s = closure(use).sample(kUp, {0.5f, 0.5f, 0}, TransportMode::kRadiance, rng);
    return s->is_transmission() ? 0.0f : s->pdf;
  };
  EXPECT_NEAR(reflectance(use_of("dielectric")), 0.04f, 1e-6f);
  EXPECT_NEAR(reflectance(use_of("dielectric", {number("eta", 2)})), 1 / 9.0f, 1e-6f);
  const std::pair<const char*, double> glasses[] = {{"glass-BK7", 1.5168}, {"glass-SF11", 1.78472}};
  for (const auto& [name, n] : glasses)
    EXPECT_NEAR(reflectance(use_of("dielectric", {text("eta", name, ParamKind::kSpectrum)})),
                (n - 1) * (n - 1) / ((n + 1) * (n + 1)), 1e-6);
  EXPECT_EQ(closure(use_of("dielectric", {number("eta", 1)})).lobes(), kTransmission | kDelta);
  EXPECT_EQ(errors_of(use_of("dielectric", {text("eta", "glass-butter", ParamKind::kSpectrum)})), 1);
  EXPECT_EQ(errors_of(use_of("dielectric", {rgb("eta", 1.5, 1.6, 1.7)})), 1);
}

TEST(DiffuseMaterial, TexturesAreClampedToAlbedos) {
  const TempFolder folder;
  const float values[3] = {4, -1, 0.25f};
  std::string pfm = "PF\n1 1\n-1.0\n";
  pfm.append(reinterpret_cast<const char*>(values), sizeof values);
  folder.write("bright.pfm", pfm);
  Diagnostics diagnostics;
  TextureTable table;
  TextureBuilder builder(table, folder.path());
  builder.add("bright", false, use_of("imagemap", {text("filename", "bright.pfm")}), Transform(), diagnostics);
  builder.load_images({}, diagnostics);
  const auto material =
      make_material(use_of("diffuse", {texture("reflectance", "bright")}), builder, data, diagnostics);
  ASSERT_FALSE(diagnostics.has_errors()) << diagnostics.format_all();
  const Spectrum albedo = material->closure({}, table, {}).albedo(kUp);
  EXPECT_EQ(albedo[0], 1.0f);
  EXPECT_EQ(albedo[1], 0.0f);
  EXPECT_EQ(albedo[2], 0.25f);
  EXPECT_EQ(closure(use_of("diffuse")).albedo(kUp)[0], 0.5f);
}

// Coats have closed forms where they only absorb and are the same everywhere and in all directions.
TEST(CoatedMaterials, ClosedFormOrWalk) {
  const auto walks = [](const std::string& model, const std::vector<Param>& params) {
    return closure(use_of(model, params)).traits().stochastic;
  };
  EXPECT_FALSE(walks("coateddiffuse", {}));
  EXPECT_FALSE(walks("coateddiffuse", {number("roughness", 0.04)}));
  EXPECT_FALSE(walks("coateddiffuse", {number("eta", 0.7), number("thickness", 3)}));
  EXPECT_FALSE(walks("coatedconductor", {}));
  EXPECT_TRUE(walks("coateddiffuse", {number("albedo", 0.5)}));
  EXPECT_TRUE(walks("coateddiffuse", {number("uroughness", 0.04), number("vroughness", 0.09)}));
  EXPECT_TRUE(walks("coateddiffuse", {number("roughness", 0.04), number("eta", 0.7)}));
  EXPECT_TRUE(walks("coateddiffuse", {number("roughness", 4)}));
  EXPECT_TRUE(walks("coateddiffuse", {number("eta", 1e-30)}));
  EXPECT_TRUE(walks("coatedconductor", {number("conductor.roughness", 0.04)}));
  EXPECT_TRUE(walks("coatedconductor", {number("albedo", 0.5)}));

  Diagnostics diagnostics;
  TextureTable table;
  TextureBuilder builder(table, {});
  builder.add("stripes", true, use_of("checkerboard"), Transform(), diagnostics);
  for (const char* name : {"thickness", "roughness"})
    EXPECT_TRUE(make_material(use_of("coateddiffuse", {texture(name, "stripes")}), builder, data, diagnostics)
                    ->closure({}, table, {})
                    .traits()
                    .stochastic);
  EXPECT_FALSE(diagnostics.has_errors()) << diagnostics.format_all();
}

TEST(CoatedMaterials, ShareTables) {
  const size_t before = data.coats.size();
  for (const double paint : {0.2, 0.7})
    closure(use_of("coateddiffuse", {number("roughness", 0.123), number("reflectance", paint)}));
  EXPECT_EQ(data.coats.size(), before + 1);
}

TEST(Materials, InterfaceIsNone) {
  Diagnostics diagnostics;
  TextureTable table;
  TextureBuilder builder(table, {});
  EXPECT_FALSE(make_material(use_of("interface"), builder, data, diagnostics));
  EXPECT_EQ(errors_of(use_of("diffuse", {texture("reflectance", "nowhere")})), 1);
}

// A surface whose shading normal leans 40 degrees away from the geometric one.
struct Leaning {
  Vec3 ng = normalize(Vec3{0.2f, -0.3f, 0.9f});
  Vec3 ns = normalize(ng + Frame::from_z(ng).x * 0.839f);
  Frame frame = Frame::from_z(ns);
};

// The geometric normal decides whether two directions reflect; the light must be on the same side of the shading
// normal, while the viewer may be anywhere.
TEST(SurfaceScatter, TheGeometricNormalDecidesSides) {
  const Leaning l;
  const Bsdf closures[] = {Bsdf(Lambert{Spectrum(0.5f)}),
                           Bsdf(RoughConductor{Spectrum(0.2f), Spectrum(3), {0.5f, 0.3f}})};
  HashStream rng(1);
  int viewers_behind = 0, dark_lights = 0;
  for (const Bsdf& bsdf : closures)
    for (int i = 0; i < 4000; ++i) {
      const SurfaceScatter scatter(bsdf, l.frame, l.ng);
      const Vec3 viewer = sample_sphere_uniform({rng.next_float(), rng.next_float()});
      const Vec3 light = sample_sphere_uniform({rng.next_float(), rng.next_float()});
      const bool reflects = dot(viewer, l.ng) * dot(light, l.ng) > 0, shines = dot(light, l.ng) * dot(light, l.ns) > 0;
      EXPECT_EQ(scatter.eval_cos(viewer, light, TransportMode::kRadiance, rng)[0] > 0, reflects && shines);
      EXPECT_EQ(scatter.eval_cos(light, viewer, TransportMode::kImportance, rng)[0] > 0, reflects && shines);
      EXPECT_EQ(scatter.pdf(viewer, light, TransportMode::kRadiance) > 0, reflects && shines);
      EXPECT_EQ(scatter.pdf(light, viewer, TransportMode::kImportance) > 0, reflects && shines);
      viewers_behind += reflects && shines && dot(viewer, l.ns) * dot(viewer, l.ng) < 0;
      dark_lights += reflects && !shines;
    }
  EXPECT_GT(viewers_behind, 300);
  EXPECT_GT(dark_lights, 300);
}

TEST(SurfaceScatter, RefractionCrossesTheGeometricNormal) {
  const Leaning l;
  const Bsdf bsdf(SmoothDielectric{1.5f});
  const SurfaceScatter scatter(bsdf, l.frame, l.ng);
  HashStream rng(2);
  int failures = 0, made = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3 viewer = sample_sphere_uniform({rng.next_float(), rng.next_float()});
    const auto s = scatter.sample(viewer, {0.5f, 0.5f, rng.next_float()}, TransportMode::kRadiance, rng);
    failures += !s;
    if (!s) continue;
    ++made;
    EXPECT_EQ(dot(viewer, l.ng) * dot(s->wi, l.ng) < 0, s->is_transmission());
    EXPECT_GT(dot(s->wi, l.ns) * dot(s->wi, l.ng), 0);
    EXPECT_NEAR(length(s->wi), 1.0f, 1e-5f);
  }
  EXPECT_GT(failures, 100);
  EXPECT_GT(made, 2000);
}

// A surface of albedo 1 under a sky of 1 loses what comes from behind its shading normal, whoever looks: the lune
// between the two planes. (1 + cos tilt) / 2 is left.
TEST(SurfaceScatter, DiffuseFurnaceAtEveryTiltAndView) {
  const Vec3 ng = normalize(Vec3{0.2f, -0.3f, 0.9f});
  HashStream rng(3);
  for (const float degrees : {0.0f, 10.0f, 21.0f, 45.0f, 70.0f, 89.0f}) {
    const float tilt = degrees * kPi / 180;
    const Vec3 ns = ng * std::cos(tilt) + Frame::from_z(ng).x * std::sin(tilt);
    const Bsdf bsdf(Lambert{Spectrum(1)});
    const SurfaceScatter scatter(bsdf, Frame::from_z(ns), ng);
    for (int view = 0; view < 20; ++view) {
      const Vec3 viewer = sample_sphere_uniform({rng.next_float(), rng.next_float()});
      constexpr int kGrid = 100;
      double sum = 0;
      for (int i = 0; i < kGrid * kGrid; ++i) {
        const Vec3 u{(static_cast<float>(i % kGrid) + 0.5f) / kGrid, (static_cast<float>(i / kGrid) + 0.5f) / kGrid,
                     0.5f};
        if (const auto s = scatter.sample(viewer, u, TransportMode::kRadiance, rng)) sum += s->weight[0];
      }
      EXPECT_NEAR(sum / (kGrid * kGrid), (1 + std::cos(tilt)) / 2, 3e-3) << degrees << " degrees";
    }
  }
}

TEST(SurfaceScatter, SampleEvalAndPdfAgreeInTheWorld) {
  const Leaning l;
  const Bsdf closures[] = {Bsdf(Lambert{Spectrum(0.5f)}),
                           Bsdf(RoughConductor{Spectrum(0.2f), Spectrum(3), {0.5f, 0.3f}})};
  HashStream rng(3);
  for (const TransportMode mode : {TransportMode::kRadiance, TransportMode::kImportance})
    for (const Bsdf& bsdf : closures)
      for (int i = 0; i < 2000; ++i) {
        const SurfaceScatter scatter(bsdf, l.frame, l.ng);
        const Vec3 wo = sample_sphere_uniform({rng.next_float(), rng.next_float()});
        const auto s = scatter.sample(wo, {rng.next_float(), rng.next_float(), 0.5f}, mode, rng);
        if (!s || std::abs(dot(s->wi, l.ns)) < 0.01f || std::abs(dot(wo, l.ns)) < 0.01f) continue;
        EXPECT_NEAR(scatter.pdf(wo, s->wi, mode) / s->pdf, 1.0f, 1e-3f);
        EXPECT_NEAR(scatter.eval_cos(wo, s->wi, mode, rng)[0] / (s->weight[0] * s->pdf), 1.0f, 1e-3f);
      }
}

// What the factor is for: with it, importance scatters as radiance does backwards, both measured against the geometric
// surface (Veach 1997, section 5.3).
TEST(SurfaceScatter, ImportanceIsTheAdjointOfRadiance) {
  const Leaning l;
  const Bsdf bsdf(RoughConductor{Spectrum(0.2f), Spectrum(3), {0.5f, 0.3f}});
  const SurfaceScatter scatter(bsdf, l.frame, l.ng);
  HashStream rng(4);
  int compared = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3 wo = sample_sphere_uniform({rng.next_float(), rng.next_float()});
    const Vec3 wi = sample_sphere_uniform({rng.next_float(), rng.next_float()});
    const float radiance = scatter.eval_cos(wi, wo, TransportMode::kRadiance, rng)[0] / std::abs(dot(wo, l.ng));
    const float importance = scatter.eval_cos(wo, wi, TransportMode::kImportance, rng)[0] / std::abs(dot(wi, l.ng));
    EXPECT_EQ(importance > 0, radiance > 0);
    if (!(radiance > 0)) continue;
    EXPECT_NEAR(importance / radiance, 1.0f, 1e-3f);
    ++compared;
  }
  EXPECT_GT(compared, 1000);
}

// Where the mirror image of the viewer is behind the surface, the normal turns until it is not, and no further: no
// normal nearer to the old one would do.
TEST(BentNormal, TurnsByTheLeastAngle) {
  HashStream rng(6);
  const auto direction = [&rng] { return sample_sphere_uniform({rng.next_float(), rng.next_float()}); };
  const auto height = [](Vec3 n, Vec3 ng, Vec3 wo) {
    return (2 * dot(n, wo) * dot(n, ng) - dot(wo, ng)) * std::copysign(1.0f, dot(wo, ng));
  };
  int bent = 0, behind = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 ng = direction(), wo = i % 50 == 0 ? ng : direction(), ns = face_forward(direction(), ng);
    const Frame frame = Frame::from_z(ns), turned = bend_to_viewer(frame, ng, wo);
    const float clearance = std::min(0.01f, 0.5f * std::abs(dot(wo, ng)));
    EXPECT_GT(height(turned.z, ng, wo), clearance - 1e-5f);
    EXPECT_NEAR(dot(turned.x, turned.z), 0, 1e-5f);
    EXPECT_GT(dot(turned.z, ng), 0);
    if (height(ns, ng, wo) > clearance) {
      EXPECT_EQ(dot(turned.z, ns), dot(ns, ns));
      continue;
    }
    ++bent;
    behind += dot(wo, ns) * dot(wo, ng) < 0;
    const float cosine = dot(turned.z, ns);
    for (int k = 0; k < 200; ++k) {
      const Vec3 other = normalize(turned.z + direction() * std::pow(10.0f, -4 * rng.next_float()));
      if (dot(other, ng) > 0 && height(other, ng, wo) > clearance) {
        EXPECT_LT(dot(other, ns), cosine + 1e-5f);
      }
    }
  }
  EXPECT_GT(bent, 500);
  EXPECT_GT(behind, 300);
}

// A material is plain where no texture and no tangent matters, and its closure is then the one that it makes.
TEST(Material, IsPlainWithoutTexturesAndTangents) {
  TempFolder folder;
  folder.write("n.pfm", "PF\n1 1\n-1\n" + std::string(12, '\0'));
  Diagnostics diagnostics;
  TextureTable table;
  TextureBuilder builder(table, folder.path());
  builder.add("stripes", false, use_of("checkerboard"), Transform(), diagnostics);
  builder.add("bumps", true, use_of("checkerboard"), Transform(), diagnostics);
  const auto is_plain = [&](const ModelUse& use) {
    const auto material = make_material(use, builder, data, diagnostics);
    if (!material || !material->plain()) return false;
    return material->plain()->kind() == material->closure({}, table, {}).kind();
  };
  EXPECT_TRUE(is_plain(use_of("diffuse")));
  EXPECT_TRUE(is_plain(use_of("conductor", {number("roughness", 0.3)})));
  EXPECT_TRUE(is_plain(use_of("dielectric")));
  EXPECT_TRUE(is_plain(use_of("coateddiffuse")));
  EXPECT_FALSE(is_plain(use_of("diffuse", {texture("reflectance", "stripes")})));
  EXPECT_FALSE(is_plain(use_of("diffuse", {texture("displacement", "bumps")})));
  EXPECT_FALSE(is_plain(use_of("diffuse", {text("normalmap", "n.pfm")})));
  EXPECT_FALSE(is_plain(use_of("conductor", {number("uroughness", 0.3), number("vroughness", 0.1)})));
  EXPECT_FALSE(is_plain(use_of("coateddiffuse", {number("uroughness", 0.3), number("vroughness", 0.1)})));
  EXPECT_EQ(diagnostics.error_count(), 0) << diagnostics.format_all();
}

// Turning both directions about the normal changes nothing of a closure that says so, and something of others. Random
// closures are turned with the same numbers.
TEST(Bsdf, IsotropicOnesMayBeTurned) {
  const float c = std::cos(1.1f), s = std::sin(1.1f);
  const auto turned = [&](Vec3 w) { return Vec3{c * w.x - s * w.y, s * w.x + c * w.y, w.z}; };
  int others = 0;
  for (const BsdfExample& e : bsdf_examples()) {
    if (e.bsdf.traits().stochastic || e.bsdf.traits().delta) continue;
    HashStream rng(3);
    float largest = 0;
    for (int i = 0; i < 200; ++i) {
      const Vec3 wo = sample_sphere_uniform({rng.next_float(), rng.next_float()});
      const auto sample =
          e.bsdf.sample(wo, {rng.next_float(), rng.next_float(), rng.next_float()}, TransportMode::kRadiance, rng);
      if (!sample || sample->is_delta()) continue;
      const float f = e.bsdf.eval_cos(wo, sample->wi, TransportMode::kRadiance, rng)[1];
      const float g = e.bsdf.eval_cos(turned(wo), turned(sample->wi), TransportMode::kRadiance, rng)[1];
      // Lobes as sharp as 1e-4 show the rounding of directions.
      if (f > 0.0f && e.bsdf.widest_alpha() > 0.05f) largest = std::max(largest, std::abs(g / f - 1.0f));
    }
    if (e.bsdf.is_isotropic()) {
      EXPECT_LT(largest, 2e-3f) << e.name;
    } else {
      EXPECT_GT(largest, 0.02f) << e.name;
      ++others;
    }
  }
  EXPECT_GT(others, 0);
}

TEST(Frame, StaysOrthonormalForEveryTangent) {
  HashStream rng(5);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 n = sample_sphere_uniform({rng.next_float(), rng.next_float()});
    const Vec3 aside = sample_sphere_uniform({rng.next_float(), rng.next_float()});
    const float off = std::pow(10.0f, -8 * rng.next_float()), size = std::pow(10.0f, 16 * rng.next_float() - 8);
    const Frame f = Frame::from_z_tangent(n, (n + aside * off) * size);
    EXPECT_NEAR(length(f.x), 1, 1e-3f);
    EXPECT_NEAR(length(f.y), 1, 1e-3f);
    EXPECT_NEAR(dot(f.x, f.z), 0, 1e-3f);
    EXPECT_NEAR(dot(f.y, f.z), 0, 1e-3f);
    EXPECT_NEAR(dot(f.x, f.y), 0, 1e-3f);
  }
}

}  // namespace
}  // namespace etd
