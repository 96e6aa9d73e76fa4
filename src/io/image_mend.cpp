// Texels that are not finite, as renderers and photographs of the sun leave them: one would make every lookup near it,
// and every coarser level over it, what it is.
#include <cmath>

#include <fmt/format.h>

#include "io/image.h"

namespace etd {

namespace {

bool is_finite_texel(const Image& image, int x, int y) {
  for (int c = 0; c < image.channels(); ++c)
    if (!std::isfinite(image.texel(x, y, c))) return false;
  return true;
}

}  // namespace

void Image::set_texel(int x, int y, int c, float linear) {
  const size_t i = index(x, y) * static_cast<size_t>(channels_) + static_cast<size_t>(c);
  const uint16_t half = float_to_half(linear);
  if (format_.kind() == TexelFormat::Kind::kHalf)
    std::memcpy(&texels_[2 * i], &half, sizeof half);
  else
    std::memcpy(&texels_[4 * i], &linear, sizeof linear);
}

// Mends from the rim of each hole inwards: those that have finite neighbours are mended together, then those that touch
// them.
MendedImage mend_texels(Image image) {
  MendedImage result{std::move(image)};
  Image& im = result.image;
  if (im.format().kind() == TexelFormat::Kind::kByte) return result;
  const int width = im.width(), height = im.height();
  using Place = std::array<int, 2>;
  std::vector<Place> holes;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (!is_finite_texel(im, x, y)) holes.push_back({x, y});
  result.texels = holes.size();
  if (holes.empty()) return result;
  result.x = holes[0][0], result.y = holes[0][1];
  const auto for_neighbours = [&](Place p, const auto& f) {
    for (int y = std::max(0, p[1] - 1); y <= std::min(height - 1, p[1] + 1); ++y)
      for (int x = std::max(0, p[0] - 1); x <= std::min(width - 1, p[0] + 1); ++x) f(Place{x, y});
  };
  std::vector<std::array<float, 4>> means;
  std::vector<Place> rim;
  while (!holes.empty()) {
    rim.clear(), means.clear();
    for (const Place p : holes) {
      int count = 0;
      std::array<double, 4> sum{};
      for_neighbours(p, [&](Place n) {
        if (!is_finite_texel(im, n[0], n[1])) return;
        ++count;
        for (int c = 0; c < im.channels(); ++c) sum[static_cast<size_t>(c)] += im.texel(n[0], n[1], c);
      });
      if (count == 0) continue;
      rim.push_back(p);
      std::array<float, 4>& mean = means.emplace_back();
      for (size_t c = 0; c < 4; ++c) mean[c] = static_cast<float>(sum[c] / count);
    }
    if (rim.empty()) return result;
    for (size_t i = 0; i < rim.size(); ++i)
      for (int c = 0; c < im.channels(); ++c) im.set_texel(rim[i][0], rim[i][1], c, means[i][static_cast<size_t>(c)]);
    holes.clear();
    for (const Place p : rim)
      for_neighbours(p, [&](Place n) {
        if (!is_finite_texel(im, n[0], n[1])) holes.push_back(n);
      });
    std::sort(holes.begin(), holes.end());
    holes.erase(std::unique(holes.begin(), holes.end()), holes.end());
  }
  return result;
}

bool is_finite(const Image& image) {
  if (image.format().kind() == TexelFormat::Kind::kByte) return true;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      if (!is_finite_texel(image, x, y)) return false;
  return true;
}

ImageResult finite_image(Image image) {
  ImageResult result;
  MendedImage mended = mend_texels(std::move(image));
  const auto all = static_cast<size_t>(mended.image.width()) * static_cast<size_t>(mended.image.height());
  if (mended.texels == all) {
    result.error = "none of its texels is finite";
    return result;
  }
  result.image = std::move(mended.image);
  if (mended.texels > 0)
    result.notes.push_back(
        mended.texels == 1
            ? fmt::format("its texel ({}, {}) is not finite: it becomes the mean of its neighbours", mended.x, mended.y)
            : fmt::format("{} of its texels are not finite, the first at ({}, {}): they become the mean of their "
                          "neighbours",
                          mended.texels, mended.x, mended.y));
  return result;
}

ImageResult read_finite_image(const std::filesystem::path& path, const ImageOptions& options) {
  ImageResult read = read_image(path, options);
  if (!read.image) return read;
  ImageResult finite = finite_image(std::move(*read.image));
  read.image = std::move(finite.image);
  read.error = std::move(finite.error);
  read.notes.insert(read.notes.end(), finite.notes.begin(), finite.notes.end());
  return read;
}

}  // namespace etd
