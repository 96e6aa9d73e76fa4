// Pictures of the maps that checks keep.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "io/image_write.h"
#include "verify/battery/run.h"

namespace etd {

namespace {

constexpr int kMinWidth = 360;  // maps of few cells are enlarged to about this
constexpr int kGap = 4;         // between the three parts, in pixels

struct Color {
  float r, g, b;
};

// Black, red, yellow, white.
Color heat(float v) {
  const auto ramp = [v](float from) { return std::clamp(3.0f * v - from, 0.0f, 1.0f); };
  return {ramp(0.0f), ramp(1.0f), ramp(2.0f)};
}
// Red: more than expected, blue: fewer; full at 5 standard deviations.
Color difference(float sigmas) {
  const float v = std::clamp(std::abs(sigmas) / 5.0f, 0.0f, 1.0f);
  return sigmas > 0.0f ? Color{1.0f, 1.0f - v, 1.0f - v} : Color{1.0f - v, 1.0f - v, 1.0f};
}

std::string file_name(const std::string& text) {
  std::string name;
  for (const char c : text) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) || c == '.';
    if (plain)
      name += c;
    else if (!name.empty() && name.back() != '-')
      name += '-';
  }
  while (!name.empty() && name.back() == '-') name.pop_back();
  return name;
}

}  // namespace

std::string write_check_map(const std::filesystem::path& path, const CheckMap& map) {
  const int scale = std::max(1, kMinWidth / map.width), width = map.width * scale, part = map.height * scale;
  const int height = 3 * part + 2 * kGap;
  // The same scale for both, on which the brightest thousandth may saturate.
  std::vector<float> sorted = map.expected;
  std::sort(sorted.begin(), sorted.end());
  const float top = std::max(sorted[(sorted.size() - 1) * 999 / 1000], 1e-30f);
  std::vector<float> rgb(static_cast<size_t>(width * height * 3), 0.5f);
  for (int p = 0; p < 3; ++p)
    for (int y = 0; y < part; ++y)
      for (int x = 0; x < width; ++x) {
        const auto i = static_cast<size_t>(y / scale * map.width + x / scale);
        const float density = p == 0 ? map.sampled[i] : map.expected[i];
        const Color c = p == 2 ? difference(map.sigmas[i]) : heat(std::sqrt(std::max(density, 0.0f) / top));
        const size_t at = static_cast<size_t>(((p * (part + kGap) + y) * width + x) * 3);
        rgb[at] = c.r, rgb[at + 1] = c.g, rgb[at + 2] = c.b;
      }
  return write_rgb(path, width, height, rgb);
}

std::vector<std::filesystem::path> write_check_pictures(const BatteryRun& run, const std::filesystem::path& folder,
                                                        bool all, std::string& problem) {
  std::vector<std::filesystem::path> files;
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) problem = fmt::format("cannot make the folder {}: {}", folder.string(), failed.message());
  for (const ModelReport& m : run.models)
    for (const CheckResult& r : m.results) {
      if (!problem.empty()) return files;
      if (!r.map || (r.passed && !all)) continue;
      const auto path = folder / (file_name(m.family + " " + r.subject + " " + r.name) + ".png");
      problem = write_check_map(path, *r.map);
      if (problem.empty()) files.push_back(path);
    }
  return files;
}

}  // namespace etd
