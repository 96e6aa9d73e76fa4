#include "formats/mesh/reader.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/bounds.h"
#include "formats/mesh/obj_scene.h"
#include "formats/mesh/params.h"
#include "io/gzip.h"
#include "shapes/mesh_shapes.h"

namespace etd {

namespace {

constexpr std::array<std::string_view, 3> kEndings = {".obj", ".off", ".ply"};

std::shared_ptr<const MeshData> read_plain_mesh(const std::filesystem::path& file, const std::string& ending,
                                                Diagnostics& diagnostics) {
  MeshResult result = ending == ".ply" ? read_ply(file, diagnostics.limits()) : read_off(file, diagnostics.limits());
  report_mesh_problems(result.problems, result.notes, {}, {}, file.string(), diagnostics);
  return result.mesh ? without_unused_vertices(std::move(*result.mesh)) : nullptr;
}

// The world around the mesh: a frame whose y is up and whose size is the mesh's.
struct Stage {
  bool z_up = false;
  Point3d center;  // of the bounding sphere, in the mesh's own coordinates
  double radius = 1;
  double lowest = 0;  // of the mesh along the way up, from the centre

  // A place given right, up and towards the viewer from the centre.
  Point3d place(double right, double up, double front) const {
    return center + (z_up ? Vec3d{right, -front, up} : Vec3d{right, up, front});
  }
  Vec3d up() const { return z_up ? Vec3d{0, 0, 1} : Vec3d{0, 1, 0}; }
};

Stage make_stage(const std::vector<ShapeDesc>& shapes) {
  Bounds3 bounds;
  const auto for_each = [&](const auto& f) {
    for (const ShapeDesc& s : shapes) {
      for (const Point3d& p : s.mesh->positions) f(p);
    }
  };
  for_each([&](const Point3d& p) { bounds.extend(p); });
  Stage stage;
  if (bounds.empty()) return stage;
  const Vec3d size = bounds.hi - bounds.lo;
  stage.z_up = size.z > 1.4 * std::max(size.x, size.y);
  stage.center = bounds.center();
  double r2 = 0;
  for_each([&](const Point3d& p) { r2 = std::max(r2, dot(p - stage.center, p - stage.center)); });
  if (r2 > 0) stage.radius = std::sqrt(r2);
  stage.lowest = -0.5 * (stage.z_up ? size.z : size.y);
  return stage;
}

void add_camera(const Stage& stage, SceneDescription& scene) {
  constexpr double kFov = 30, kAzimuth = 30, kElevation = 22, kMargin = 1.02;
  const double distance = kMargin * stage.radius / std::sin(radians(kFov / 2));
  const double flat = distance * std::cos(radians(kElevation));
  const Point3d eye = stage.place(flat * std::sin(radians(kAzimuth)), distance * std::sin(radians(kElevation)),
                                  flat * std::cos(radians(kAzimuth)));
  const Transform to_world = Transform::look_at(eye, stage.center, stage.up()).inverse();
  // LookAt makes a left-handed camera, whose x then points to the left of what a right-handed world shows: turned back.
  scene.camera_to_world = to_world * Transform::scale({-1, 1, 1});
  scene.camera = {"perspective", {number_param("fov", {kFov})}, {}};
}

// A square ground at the lowest point, large enough that its edge is out of sight, and a sphere of light up front on
// the left, as large as the mesh. A thousandth of the radius keeps a flat base from lying in the ground.
void add_surroundings(const Stage& stage, SceneDescription& scene) {
  const double r = stage.radius, side = 40 * r, height = stage.lowest - 1e-3 * r;
  MeshData ground;
  for (const auto& [x, z] : {std::pair(-side, side), {side, side}, {side, -side}, {-side, -side}})
    ground.positions.push_back(stage.place(x, height, z));
  ground.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene.materials.push_back({"", {"diffuse", {rgb_param("reflectance", {0.4f, 0.4f, 0.4f})}, {}}});
  scene.shapes.push_back({{"trianglemesh", {}, {}}, {}, false, static_cast<int>(scene.materials.size()) - 1, -1});
  scene.shapes.back().mesh = std::make_shared<const MeshData>(std::move(ground));

  const Point3d lamp = stage.place(-2.6 * r, 3.4 * r, 2.4 * r);
  scene.materials.push_back({"", {"diffuse", {rgb_param("reflectance", {0, 0, 0})}, {}}});
  scene.area_lights.push_back({"diffuse", {rgb_param("L", {24, 22.5f, 20})}, {}});
  scene.shapes.push_back({{"sphere", {number_param("radius", {r})}, {}},
                          Transform::translate({lamp.x, lamp.y, lamp.z}),
                          false,
                          static_cast<int>(scene.materials.size()) - 1,
                          static_cast<int>(scene.area_lights.size()) - 1});
  scene.lights.push_back({{"infinite", {rgb_param("L", {0.28f, 0.31f, 0.36f})}, {}}, {}});
}

}  // namespace

bool is_mesh_ending(std::string_view ending) {
  return std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end();
}

SceneDescription read_mesh_scene(const std::filesystem::path& file, Diagnostics& diagnostics) {
  SceneDescription scene;
  scene.file = file;
  scene.folder = file.parent_path();
  std::filesystem::path stem = file.stem();
  if (is_mesh_ending(uncompressed_ending(stem))) stem.replace_extension();
  scene.film = {"rgb",
                {integer_param("xresolution", {960}), integer_param("yresolution", {720}),
                 string_param("filename", stem.string() + ".exr")},
                {}};
  scene.filter = {"gaussian", {}, {}};
  scene.sampler = {"sobol", {integer_param("pixelsamples", {64})}, {}};
  scene.integrator = {"path", {}, {}};

  scene.materials.push_back({"", {"diffuse", {rgb_param("reflectance", {0.6f, 0.6f, 0.6f})}, {}}});
  const ShapeDesc grey{{}, {}, false, 0, -1};
  const std::string ending = uncompressed_ending(file);
  if (ending == ".obj") {
    ObjResult obj = read_obj(file, diagnostics.limits());
    report_mesh_problems(obj.problems, obj.notes, {}, {}, file.string(), diagnostics);
    scene.shapes = add_obj(ObjFile(std::move(obj)), file.filename(), grey, true, scene, diagnostics);
  } else if (auto mesh = read_plain_mesh(file, ending, diagnostics)) {
    scene.shapes.push_back(grey);
    scene.shapes.back().use.model = "trianglemesh";
    scene.shapes.back().mesh = std::move(mesh);
  }
  const Stage stage = make_stage(scene.shapes);
  add_camera(stage, scene);
  add_surroundings(stage, scene);
  return scene;
}

}  // namespace etd
