// The battery over materials as scenes name them: every registered one, in settings made from its declaration, becomes
// a closure, which is checked as the closures of the example list are.
#include <fmt/format.h>

#include "scene/registry.h"
#include "verify/battery/bare_scene.h"
#include "verify/battery/bsdf/bsdf.h"
#include "verify/battery/models.h"
#include "verify/battery/parameter_grid.h"
#include "verify/battery/worst.h"

namespace etd {

namespace {

constexpr size_t kSamples = 30000;
// At smaller cosines directions in float do not resolve the sharpest lobes of the settings.
constexpr float kMinCos = 0.01f;

CheckResult not_made(const std::string& name, const std::string& problem) {
  return {name, "is made from its declaration", false, 0.0, {}, problem, nullptr};
}

// A mix of a material that reflects nothing and one that reflects everything, which shows how often each is chosen.
BareScene mixed_scene(double amount) {
  SceneDescription d = bare_description();
  const auto diffuse = [](double value) {
    Param p;
    p.name = "reflectance";
    p.numbers = {value};
    return ModelUse{"diffuse", {p}, {}};
  };
  Param materials, share;
  materials.name = "materials", materials.kind = ParamKind::kString, materials.strings = {"black", "white"};
  share.name = "amount", share.numbers = {amount};
  d.materials = {{"black", diffuse(0.0)}, {"white", diffuse(1.0)}, {"both", {"mix", {materials, share}, {}}}};
  return compile_bare(d);
}

std::vector<CheckResult> check_mixed_scene(const std::string& name, double amount, const BatteryOptions& options) {
  const BareScene bare = mixed_scene(amount);
  if (!bare.scene) return {not_made(name, bare.problem)};
  const Scene& scene = *bare.scene;
  const TexCoord at{{0.3f, 0.6f}};
  const auto choose = [&](HashStream& rng) {
    const Bsdf chosen =
        scene.materials.at(3).resolve(at, scene.textures, {}, scene.materials, rng).closure(at, scene.textures, {});
    return static_cast<double>(chosen.albedo({0, 0, 1})[0]);
  };
  return check_mix(name, amount, choose, options);
}

}  // namespace

std::vector<CheckResult> check_material(const std::string& name, const ModelUse& use, const BatteryOptions& options) {
  SceneDescription d = bare_description();
  d.materials.push_back({"", use});
  const BareScene bare = compile_bare(d);
  if (!bare.scene) return {not_made(name, bare.problem)};
  const Bsdf closure = bare.scene->materials.at(1).closure({{0.3f, 0.6f}}, bare.scene->textures, {});
  return check_bsdf(scatter_model(name, closure, closure.traits(), false, kMinCos),
                    {static_cast<size_t>(options.samples * kSamples), options.seed, options.family_level});
}

std::vector<CheckResult> check_mix(const std::string& name, double amount, const MixChoice& choose,
                                   const BatteryOptions& options) {
  const double n = options.samples * kSamples;
  HashStream rng(options.seed);
  double white = 0;
  for (double i = 0; i < n; ++i) white += choose(rng);
  WorstP chosen(name, "share of the second material");
  const double error = std::sqrt(std::max(amount * (1.0 - amount) / n, 1e-16)), z = (white / n - amount) / error;
  chosen.add(z, normal_two_sided(z), [&] { return fmt::format("{:.5f} of {:.5f}", white / n, amount); });
  std::vector<CheckResult> results{chosen.result()};
  judge(results, options.family_level);
  return results;
}

std::vector<BatterySubject> material_subjects() {
  std::vector<BatterySubject> subjects;
  for (const ModelDecl* decl : models(Family::kMaterial)) {
    if (decl->name == "interface") continue;  // no surface: nothing scatters
    if (decl->name == "mix") {
      for (const double amount : {0.0, 0.3, 1.0}) {
        const std::string name = fmt::format("mix(amount {:g})", amount);
        subjects.push_back({"material", "mix", name, [name, amount](const BatteryOptions& options) {
                              return check_mixed_scene(name, amount, options);
                            }});
      }
      continue;
    }
    for (const ModelUse& use : parameter_grid(*decl)) {
      const std::string name = setting_name(use);
      subjects.push_back({"material", decl->name, name,
                          [name, use](const BatteryOptions& options) { return check_material(name, use, options); }});
    }
  }
  return subjects;
}

}  // namespace etd
