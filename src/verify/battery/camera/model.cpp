#include "verify/battery/camera/model.h"

#include <algorithm>

#include "core/animated_transform.h"
#include "core/hash.h"
#include "scene/registry.h"
#include "verify/battery/bare_scene.h"
#include "verify/battery/parameter_grid.h"

namespace etd {

namespace {

Param number(const std::string& name, std::vector<double> values) {
  Param p;
  p.name = name;
  p.kind = ParamKind::kFloat;
  p.numbers = std::move(values);
  return p;
}

Param text(const std::string& name, const std::string& value) {
  Param p;
  p.name = name;
  p.kind = ParamKind::kString;
  p.strings = {value};
  return p;
}

// Returns the number of the use, or the model's default.
double number_of(const ModelUse& use, const std::string& name) {
  if (const Param* p = use.find(name)) return p->numbers[0];
  for (const ParamDecl& d : find_model(Family::kCamera, use.model)->params)
    if (d.name == name) return std::get<double>(d.default_value);
  return 0.0;
}

FilmSpread spread_of(const CameraSetting& setting) {
  const ModelUse& use = setting.use;
  if (use.model == "perspective") return FilmSpread::kFlat;
  if (use.model == "orthographic") return FilmSpread::kParallel;
  if (setting.stretched) return FilmSpread::kOther;
  const Param* mapping = use.find("mapping");
  return mapping && mapping->strings[0] == "equirectangular" ? FilmSpread::kLatLong : FilmSpread::kEqualArea;
}

// Returns where all rays start, in camera space: a little more than what many of them need.
Window window_of_origins(const Camera& camera, const TransformPath& to_world, Vec3d world_origin) {
  Vec3d low{1e9, 1e9, 0}, high{-1e9, -1e9, 0};
  HashStream numbers(9);
  for (int i = 0; i < 4000; ++i) {
    float u[5];
    for (float& v : u) v = numbers.next_float();
    const Ray ray =
        camera.generate_ray({{u[0] * CameraModel::kFilmWidth, u[1] * CameraModel::kFilmHeight}, {u[2], u[3]}, u[4]});
    const Point3d o = to_world.at(double{ray.time}).inverse().point(to_double(ray.o) + world_origin);
    for (int k = 0; k < 2; ++k) low[k] = std::min(low[k], o[k]), high[k] = std::max(high[k], o[k]);
  }
  const Vec3d size = high - low, corner = low - size * 0.1;
  return {{corner.x, corner.y, 0}, {1.2 * size.x, 0, 0}, {0, 1.2 * size.y, 0}};
}

// Openings that the grid of parameters does not reach, mirrored films, and a stretched space.
std::vector<CameraSetting> lens_settings(const std::string& model) {
  std::vector<CameraSetting> settings;
  const auto add = [&](const std::vector<Param>& params, std::vector<Param> more, bool stretched) {
    more.insert(more.begin(), params.begin(), params.end());
    const ModelUse use{model, std::move(more), {}};
    settings.push_back({setting_name(use) + (stretched ? ", stretched" : ""), use, stretched, stretched});
  };
  const std::vector<Param> lens{number("lensradius", {0.4}), number("focaldistance", {2.5})};
  const std::vector<Param> mirrored{number("screenwindow", {0.75, -0.5, -0.25, 0.75})};
  for (const char* shape : {"gaussian", "square", "pentagon", "star"}) add(lens, {text("aperture", shape)}, false);
  Param blades;
  blades.name = "blades";
  blades.kind = ParamKind::kInteger;
  blades.integers = {3};
  add(lens, {blades, number("bladerotation", {20})}, true);
  add(mirrored, {}, false);
  add(mirrored, lens, false);
  return settings;
}

}  // namespace

std::vector<CameraSetting> camera_settings() {
  std::vector<CameraSetting> settings;
  for (const ModelDecl* decl : models(Family::kCamera)) {
    const std::string& model = decl->name;
    for (const ModelUse& use : parameter_grid(*decl)) settings.push_back({setting_name(use), use});
    settings.push_back({model + "(moving)", {model, {}, {}}, true});
    if (model == "spherical")
      settings.push_back({model + "(stretched)", {model, {text("mapping", "equirectangular")}, {}}, true, true});
    else
      for (CameraSetting& setting : lens_settings(model)) settings.push_back(std::move(setting));
  }
  return settings;
}

MadeCamera camera_model(const CameraSetting& setting) {
  const ModelUse& use = setting.use;
  const Transform view = Transform::look_at({1.5, -2.0, 0.7}, {0.4, 1.0, 0.2}, {0.1, 0.2, 1.0}).inverse();
  SceneDescription d = bare_description();
  d.camera = use;
  d.camera_to_world = view;
  const Transform shape =
      setting.stretched ? Transform::scale({1.4, 0.7, 1.2}) * Transform::rotate(30, {0, 0, 1}) : Transform();
  // In the middle of its time a moving camera looks to where the others look, up to a shift.
  if (setting.moves)
    d.camera_to_world = {view * Transform::rotate(-8, {0, 1, 0}) * Transform::translate({-0.2, 0, 0}) * shape,
                         view * Transform::rotate(8, {0, 1, 0}) * Transform::translate({0.2, 0.1, 0}) * shape};
  const BareScene bare = compile_bare(d, CameraModel::kFilmWidth, CameraModel::kFilmHeight);
  if (!bare.scene) return {{}, bare.problem};
  const std::shared_ptr<const Scene> scene = bare.scene;
  const TransformPath to_world = TransformPath().then(d.camera_to_world);
  CameraModel m;
  m.name = setting.name;
  m.spread = spread_of(setting);
  m.eye = to_float(view.point({0, 0, 0}) - scene->origin);
  m.axis = to_float(normalize(view.vector({0, 0, 1})));
  m.up = to_float(normalize(view.vector({0, 1, 0})));
  // Parallel rays need enough of a lens to be turned by it.
  const double radius = number_of(use, "lensradius"), turn = radius / number_of(use, "focaldistance");
  m.blurs_alike = radius > 0 && m.spread == FilmSpread::kParallel && turn < 1e-3;
  if (radius > 0 && !m.blurs_alike) {
    const Window window = window_of_origins(scene->camera, to_world, scene->origin);
    m.lens = [=](float time) {
      const Transform t = to_world.at(double{time});
      return Window{t.point(window.corner) - scene->origin, t.vector(window.a), t.vector(window.b)};
    };
  }
  m.generate_ray = [scene](const CameraSample& s) { return scene->camera.generate_ray(s); };
  m.ray_time = [scene](float u) { return scene->camera.ray_time(u); };
  m.we = [scene](const Ray& ray, float margin) { return scene->camera.we(ray, margin); };
  m.sample_wi = [scene](Point3 p, Vec2 u, float time, float margin) {
    return scene->camera.sample_wi(p, u, time, margin);
  };
  return {m, {}};
}

}  // namespace etd
