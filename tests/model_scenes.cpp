#include "model_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "render/registry.h"
#include "render_helper.h"

namespace etd {
namespace {

constexpr int kBlock = 4;

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, at);) parts.push_back(part);
  return parts;
}

ModelScene parse_name(const std::filesystem::path& file) {
  ModelScene scene;
  scene.file = file;
  std::vector<std::string> parts = split(file.stem().string(), '-');
  if (parts.size() < 2 || parts.size() > 4) {
    scene.problem += "the name is not FAMILY-MODEL, FAMILY-MODEL-PARAMETER or FAMILY-MODEL-PARAMETER-VALUE\n";
    return scene;
  }
  parts.resize(4);
  const auto family = std::find_if(std::begin(kAllFamilies), std::end(kAllFamilies),
                                   [&](Family f) { return file_word(f) == parts[0]; });
  if (family == std::end(kAllFamilies))
    scene.problem += "there is no family \"" + parts[0] + "\"\n";
  else
    scene.family = *family;
  scene.model = parts[1];
  scene.parameter = parts[2];
  scene.value = parts[3];
  return scene;
}

RegionMeans means_of(const Film& film, const PixelBounds& region) {
  RegionMeans means{region, {}};
  for (int c = 0; c < 3; ++c)
    means.rgb[static_cast<size_t>(c)] = region_mean(film, region, {Quantity::Component::kBeauty, c}).estimate();
  return means;
}

}  // namespace

std::vector<ModelScene> model_scenes() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(source_path("tests/scenes/models")))
    if (entry.path().extension() == ".pbrt") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<ModelScene> scenes;
  for (const auto& file : files) {
    ModelScene& scene = scenes.emplace_back(parse_name(file));
    const AnsweredScene comments = read_comments(file);
    scene.modes = comments.modes;
    scene.problem += comments.problem;
    if (std::none_of(scene.modes.begin(), scene.modes.end(), [](const SceneMode& m) { return m.name == "mis"; }))
      scene.problem += "the scene does not name the mode \"mis\"\n";
  }
  return scenes;
}

std::string file_word(Family family) {
  std::string word(family_name(family));
  word.erase(std::remove(word.begin(), word.end(), ' '), word.end());
  return word;
}

void for_each_use(SceneDescription& scene, const std::function<void(Family, ModelUse&)>& f) {
  f(Family::kCamera, scene.camera);
  f(Family::kFilm, scene.film);
  f(Family::kFilter, scene.filter);
  f(Family::kSampler, scene.sampler);
  f(Family::kIntegrator, scene.integrator);
  for (TextureDesc& t : scene.textures) f(Family::kTexture, t.use);
  for (MaterialDesc& m : scene.materials) f(Family::kMaterial, m.use);
  for (ModelUse& l : scene.area_lights) f(Family::kAreaLight, l);
  for (LightDesc& l : scene.lights) f(Family::kLight, l.use);
  for (ShapeDesc& s : scene.shapes) f(Family::kShape, s.use);
  for (ObjectDesc& o : scene.objects)
    for (ShapeDesc& s : o.shapes) f(Family::kShape, s.use);
}

std::vector<RegionMeans> region_means(const Film& film) {
  const PixelBounds& all = film.settings().crop;
  std::vector<RegionMeans> means = {means_of(film, all)};
  for (int y = all.y0; y < all.y1; y += kBlock)
    for (int x = all.x0; x < all.x1; x += kBlock)
      means.push_back(means_of(film, {x, y, std::min(x + kBlock, all.x1), std::min(y + kBlock, all.y1)}));
  return means;
}

void write_means(const std::filesystem::path& file, const std::vector<RegionMeans>& means) {
  std::ofstream out(file);
  for (const RegionMeans& m : means) {
    out << fmt::format("{} {} {} {} ", m.region.x0, m.region.y0, m.region.x1, m.region.y1);
    for (const MeanEstimate& e : m.rgb) out << fmt::format(" {:.6g}", e.mean);
    for (const MeanEstimate& e : m.rgb) out << fmt::format(" {:.2g}", std::sqrt(e.variance_of_mean));
    out << ' ' << m.rgb[0].count << '\n';
  }
}

std::vector<RegionMeans> read_means(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::vector<RegionMeans> means;
  for (std::string line; std::getline(in, line);) {
    std::istringstream text(line);
    RegionMeans m;
    text >> m.region.x0 >> m.region.y0 >> m.region.x1 >> m.region.y1;
    for (MeanEstimate& e : m.rgb) text >> e.mean;
    for (MeanEstimate& e : m.rgb) {
      text >> e.variance_of_mean;
      e.variance_of_mean *= e.variance_of_mean;
    }
    uint64_t count = 0;
    if (!(text >> count) || count < 2) return {};
    for (MeanEstimate& e : m.rgb) e.count = count;
    means.push_back(m);
  }
  return means;
}

}  // namespace etd
