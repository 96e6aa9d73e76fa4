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

std::filesystem::path source_path(const std::string& relative) {
  return std::filesystem::path(ETENDUE_SOURCE_DIR) / relative;
}

Film render_scene(const std::filesystem::path& file, const RenderOverrides& overrides) {
  Diagnostics diagnostics;
  return render_description(read_pbrt(file, diagnostics), overrides, diagnostics);
}

Film render_text(const std::string& text, const std::string& folder, const RenderOverrides& overrides) {
  Diagnostics diagnostics;
  return render_description(read_pbrt_text(text, "test", source_path(folder), diagnostics), overrides, diagnostics);
}

std::optional<Quantity> parse_quantity(const std::string& text) {
  const size_t dot = text.find('.');
  const std::string component = text.substr(0, dot);
  Quantity q;
  if (component == "beauty")
    q.component = Quantity::Component::kBeauty;
  else if (component == "emission")
    q.component = Quantity::Component::kEmission;
  else if (component == "direct")
    q.component = Quantity::Component::kDirect;
  else if (component == "indirect")
    q.component = Quantity::Component::kIndirect;
  else
    return {};
  if (dot == std::string::npos) return q;
  const size_t channel = std::string("RGB").find(text.substr(dot + 1));
  if (text.size() != dot + 2 || channel == std::string::npos) return {};
  q.channel = static_cast<int>(channel);
  return q;
}

double value(const PixelSums& sums, const Quantity& q) {
  const auto of_channel = [&](size_t c) {
    switch (q.component) {
      case Quantity::Component::kEmission:
        return sums.emission[c];
      case Quantity::Component::kDirect:
        return sums.direct[c];
      case Quantity::Component::kIndirect:
        return sums.indirect[c];
      default:
        return sums.emission[c] + sums.direct[c] + sums.indirect[c];
    }
  };
  const double sum =
      q.channel ? of_channel(static_cast<size_t>(*q.channel)) : (of_channel(0) + of_channel(1) + of_channel(2)) / 3.0;
  return sum / sums.count;
}

RunningStats region_mean(const Film& film, const PixelBounds& region, const Quantity& quantity, double factor) {
  RunningStats stats;
  for (uint32_t r = 0; r < film.settings().replicates; ++r) {
    double sum = 0;
    for (int y = region.y0; y < region.y1; ++y)
      for (int x = region.x0; x < region.x1; ++x) sum += value(film.sums(x, y, r), quantity);
    stats.add(factor * sum / (static_cast<double>(region.width()) * region.height()));
  }
  return stats;
}

RunningStats image_mean(const Film& film, const Quantity& quantity) {
  return region_mean(film, film.settings().crop, quantity);
}

bool would_be_seen(double relative, double mean, double standard_error, double dof, double level) {
  constexpr double kNinthDecile = 1.2816;  // of the normal distribution
  if (standard_error == 0.0) return true;
  const double t = relative * std::abs(mean) / standard_error - kNinthDecile;
  return t > 0.0 && student_t_two_sided(t, dof) < level;
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
