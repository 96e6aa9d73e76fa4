#include "render_helper.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <stdexcept>

#include "formats/pbrt/reader.h"
#include "io/image_write.h"
#include "render/session.h"
#include "scene/scene.h"

namespace etd {
namespace {

Film render_description(const SceneDescription& description, const RenderOverrides& overrides,
                        Diagnostics& diagnostics) {
  auto prepared = prepare_render(description, overrides, diagnostics);
  if (!prepared) throw std::runtime_error(diagnostics.format_all());
  RenderObserver nobody;
  return std::move(run_render(*prepared, nobody).film);
}

}  // namespace

Film render_description(const SceneDescription& description, const RenderOverrides& overrides) {
  Diagnostics diagnostics;
  return render_description(description, overrides, diagnostics);
}

Film render_scene(const std::filesystem::path& file, const RenderOverrides& overrides) {
  Diagnostics diagnostics;
  return render_description(read_pbrt(file, diagnostics), overrides, diagnostics);
}

Film render_text(const std::string& text, const std::string& folder, const RenderOverrides& overrides) {
  Diagnostics diagnostics;
  return render_description(read_pbrt_text(text, "test", source_path(folder), diagnostics), overrides, diagnostics);
}

LayeredImage render_image(const std::string& text, const std::string& folder, const RenderOverrides& overrides) {
  Diagnostics diagnostics;
  auto prepared =
      prepare_render(read_pbrt_text(text, "test", source_path(folder), diagnostics), overrides, diagnostics);
  if (!prepared) throw std::runtime_error(diagnostics.format_all());
  RenderObserver nobody;
  return finished_image(*prepared, run_render(*prepared, nobody));
}

std::vector<float> picture(const Film& film) {
  const PixelBounds& crop = film.settings().crop;
  std::vector<float> rgb;
  for (int y = crop.y0; y < crop.y1; ++y)
    for (int x = crop.x0; x < crop.x1; ++x) {
      const std::array<double, 4> mean = film.total(x, y).mean_radiance();
      for (size_t c = 0; c < 3; ++c) rgb.push_back(static_cast<float>(mean[c]));
    }
  return rgb;
}

std::string write_evidence(const std::string& name, int width, int height, const std::vector<float>& ours,
                           const std::vector<float>& theirs) {
  double mean = 0;
  for (float v : theirs) mean += std::abs(static_cast<double>(v)) / static_cast<double>(theirs.size());
  const double scale = mean > 0 ? 10.0 / mean : 1.0;
  std::vector<float> difference(ours.size());
  for (size_t i = 0; i + 2 < ours.size(); i += 3) {
    double d = 0;
    for (size_t c = 0; c < 3; ++c) d += (static_cast<double>(ours[i + c]) - theirs[i + c]) * scale / 3.0;
    difference[i] = static_cast<float>(std::max(d, 0.0));
    difference[i + 2] = static_cast<float>(std::max(-d, 0.0));
  }
  std::string pattern = (std::filesystem::temp_directory_path() / "etendue-failure-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) return "no temporary folder for the failing images";
  const std::filesystem::path folder = pattern;
  std::string problems = write_rgb(folder / (name + ".png"), width, height, ours);
  problems += write_rgb(folder / (name + "-expected.png"), width, height, theirs);
  problems += write_rgb(folder / (name + "-difference.png"), width, height, difference);
  return fmt::format("images in {} {}", folder.string(), problems);
}

}  // namespace etd
