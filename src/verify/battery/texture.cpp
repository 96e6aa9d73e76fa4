// The battery over textures: finite wherever they are looked up, the same at the same place, and one value in all lanes
// where they stand for a number.
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>

#include "core/hash.h"
#include "io/image_write.h"
#include "scene/registry.h"
#include "verify/battery/bare_scene.h"
#include "verify/battery/models.h"
#include "verify/battery/parameter_grid.h"
#include "verify/battery/worst.h"

namespace etd {

namespace {

// An image for textures that show one; it is there while the object lives.
class SmallImage {
 public:
  SmallImage()
      : path_(std::filesystem::temp_directory_path() / fmt::format("etendue-verify-{}-{}.pfm", getpid(), count_++)) {
    std::vector<float> rgb;
    HashStream numbers(3);
    for (int i = 0; i < 5 * 3 * 3; ++i) rgb.push_back(numbers.next_float());
    write_rgb(path_, 5, 3, rgb);
  }
  ~SmallImage() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  SmallImage(const SmallImage&) = delete;
  SmallImage& operator=(const SmallImage&) = delete;
  std::string path() const { return path_.string(); }

 private:
  static inline std::atomic<int> count_{0};
  std::filesystem::path path_;
};

// What one kind alone (colours or numbers) can be is made as that.
std::vector<CheckResult> check_use(const std::string& name, const ModelUse& use) {
  std::vector<CheckResult> results;
  std::string problem;
  for (const bool is_number : {false, true}) {
    SceneDescription d = bare_description();
    d.textures.push_back({"t", is_number, use, {}});
    const BareScene bare = compile_bare(d);
    if (!bare.scene) {
      problem = bare.problem;
      continue;
    }
    const auto eval = [scene = bare.scene](Vec2 uv) {
      return scene->textures.textures.back().eval({uv}, scene->textures, {});
    };
    for (CheckResult& r : check_texture({name, is_number, eval})) results.push_back(std::move(r));
  }
  if (results.empty()) results.push_back({name, "is made from its declaration", false, 0.0, {}, problem});
  return results;
}

}  // namespace

std::vector<CheckResult> check_texture(const TextureModel& m) {
  const std::string name = m.name + (m.is_number ? " as numbers" : " as colours");
  Worst finite(name, "finite", 0.0), same(name, "the same at the same place", 0.0);
  Worst lanes(name, "a number in all lanes", 0.0);
  const auto check = [&](Vec2 uv) {
    const auto where = [&] { return fmt::format("uv ({:g}, {:g})", uv.x, uv.y); };
    const Spectrum a = m.eval(uv), b = m.eval(uv);
    finite.add(is_finite(a) ? 0.0 : 1.0, where);
    for (int i = 0; i < Spectrum::kLanes; ++i) {
      same.add(a[i] == b[i] || !is_finite(a) ? 0.0 : 1.0, where);
      if (m.is_number) lanes.add(a[i] == a[0] || !is_finite(a) ? 0.0 : 1.0, where);
    }
  };
  const float places[] = {0.0f, -0.0f, 0.25f, 0.5f, 1.0f, kOneMinusEpsilon, -0.3f, 17.0f, -1e4f, 1e6f, 3e9f, 1e-30f};
  for (const float u : places)
    for (const float v : places) check({u, v});
  HashStream numbers(5);
  for (int i = 0; i < 2000; ++i) {
    const float u = numbers.next_float(), v = numbers.next_float();
    check({20.0f * u - 10.0f, 20.0f * v - 10.0f});
  }
  std::vector<CheckResult> results{finite.result(), same.result()};
  if (m.is_number) results.push_back(lanes.result());
  return results;
}

std::vector<BatterySubject> texture_subjects() {
  std::vector<BatterySubject> subjects;
  const auto image = std::make_shared<const SmallImage>();
  for (const ModelDecl* decl : models(Family::kTexture))
    for (const ModelUse& use : parameter_grid(*decl, image->path())) {
      const std::string name = setting_name(use);
      subjects.push_back(
          {"texture", decl->name, name, [name, use, image](const BatteryOptions&) { return check_use(name, use); }});
    }
  return subjects;
}

}  // namespace etd
