#include "lights/light_data.h"

#include <fmt/format.h>

#include "io/layer_param.h"
#include "io/named_images.h"
#include "lights/light_data.h"

namespace etd {

std::optional<EnvironmentMap::Layout> EnvironmentMap::layout_of(int width, int height) {
  if (width == height) return Layout::kEqualArea;
  if (width == 2 * height) return Layout::kLatLong;
  return {};
}

EnvironmentMap::EnvironmentMap(const Image& image)
    : layout_(layout_of(image.width(), image.height()).value_or(Layout::kEqualArea)),
      width_(image.width()),
      height_(image.height()) {
  set_solid_angles();
  const size_t count = static_cast<size_t>(width_) * static_cast<size_t>(height_);
  texels_.reserve(count);
  std::vector<double> weights, above_average;
  double total = 0, integral[3] = {0, 0, 0};
  for (int y = 0; y < height_; ++y) {
    const double solid_angle = solid_angles_[static_cast<size_t>(y)];
    for (int x = 0; x < width_; ++x) {
      std::array<float, 3> rgb;
      for (int c = 0; c < 3; ++c)
        rgb[static_cast<size_t>(c)] = std::max(0.0f, image.texel(x, y, image.channels() == 1 ? 0 : c));
      texels_.push_back(rgb);
      for (size_t c = 0; c < 3; ++c) integral[c] += static_cast<double>(rgb[c]) * solid_angle;
      weights.push_back((static_cast<double>(rgb[0]) + rgb[1] + rgb[2]) / 3.0 * solid_angle);
      total += weights.back();
    }
  }
  integral_ =
      Spectrum::rgb(static_cast<float>(integral[0]), static_cast<float>(integral[1]), static_cast<float>(integral[2]));
  full_ = GridDistribution(width_, height_, weights);
  // Karlik et al. 2019, "MIS Compensation", section 6: the average is what scattering finds well enough alone. Where
  // that leaves nothing to speak of, the map is constant but for rounding.
  const double average = total / (4.0 * kPiD);
  double kept = 0;
  for (size_t i = 0; i < count; ++i) {
    const double share = average * solid_angles_[i / static_cast<size_t>(width_)];
    above_average.push_back(std::max(0.0, weights[i] - share));
    kept += above_average.back();
  }
  compensated_ = kept > 1e-4 * total ? GridDistribution(width_, height_, above_average) : full_;
}

void EnvironmentMap::set_solid_angles() {
  const double step = kPiD / height_;
  for (int y = 0; y <= height_; ++y) row_cosines_.push_back(std::cos(y * step));
  for (int y = 0; y < height_; ++y)
    solid_angles_.push_back(layout_ == Layout::kEqualArea
                                ? 4.0 * kPiD / (static_cast<double>(width_) * height_)
                                // The difference of two cosines, without cancellation at the poles.
                                : 4.0 * kPiD / width_ * std::sin(0.5 * step) * std::sin((y + 0.5) * step));
}

EnvironmentMap::Cell EnvironmentMap::cell_of(Vec3 w) const {
  Vec2 st;
  if (layout_ == Layout::kEqualArea) {
    st = equal_area_square(w);
  } else {
    const float phi = std::atan2(w.y, w.x);
    st.x = (phi < 0.0f ? phi + 2.0f * kPi : phi) * (0.5f * kInvPi);
    st.y = std::atan2(std::sqrt(w.x * w.x + w.y * w.y), w.z) * kInvPi;
  }
  return {std::min(static_cast<int>(st.x * static_cast<float>(width_)), width_ - 1),
          std::min(static_cast<int>(st.y * static_cast<float>(height_)), height_ - 1)};
}

Vec3 EnvironmentMap::direction(const GridDistribution::Sample& at) const {
  const float s = (static_cast<float>(at.x) + at.offset.x) / static_cast<float>(width_);
  if (layout_ == Layout::kEqualArea)
    return equal_area_direction({s, (static_cast<float>(at.y) + at.offset.y) / static_cast<float>(height_)});
  // Uniform in the cosine between the row's edges.
  const auto row = static_cast<size_t>(at.y);
  const double top = row_cosines_[row], bottom = row_cosines_[row + 1];
  const double cos_theta = top + (bottom - top) * at.offset.y;
  const double sin_theta = std::sqrt(std::max(0.0, 1.0 - cos_theta * cos_theta)), phi = 2.0 * kPiD * s;
  return to_float(Vec3d{sin_theta * std::cos(phi), sin_theta * std::sin(phi), cos_theta});
}

Spectrum EnvironmentMap::value(Vec3 w) const {
  const Cell c = cell_of(w);
  const auto& t = texels_[static_cast<size_t>(c.y) * static_cast<size_t>(width_) + static_cast<size_t>(c.x)];
  return Spectrum::rgb(t[0], t[1], t[2]);
}

std::optional<Vec3> EnvironmentMap::sample(Vec2 u, LightSampling sampling) const {
  const GridDistribution& d = distribution(sampling);
  if (!d.any()) return {};
  return direction(d.sample(u));
}

float EnvironmentMap::pdf(Vec3 w, LightSampling sampling) const {
  const Cell c = cell_of(w);
  return distribution(sampling).probability(c.x, c.y) / static_cast<float>(solid_angles_[static_cast<size_t>(c.y)]);
}

Spectrum EnvironmentMap::irradiance_up() const {
  // The middle of many small parts of each texel, each as large as any other in the same texel.
  const int parts = std::max(1, 512 / height_);
  double sum[3] = {0, 0, 0};
  GridDistribution::Sample at;
  for (at.y = 0; at.y < height_; ++at.y)
    for (at.x = 0; at.x < width_; ++at.x) {
      double cosine = 0;
      for (int i = 0; i < parts * parts; ++i) {
        at.offset = {(static_cast<float>(i % parts) + 0.5f) / static_cast<float>(parts),
                     (static_cast<float>(i / parts) + 0.5f) / static_cast<float>(parts)};
        cosine += std::max(0.0f, direction(at).z);
      }
      const auto& t = texels_[static_cast<size_t>(at.y) * static_cast<size_t>(width_) + static_cast<size_t>(at.x)];
      for (size_t c = 0; c < 3; ++c)
        sum[c] += t[c] * cosine / (parts * parts) * solid_angles_[static_cast<size_t>(at.y)];
    }
  return Spectrum::rgb(static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2]));
}

std::filesystem::path light_image_key(const ParamReader& params, const std::filesystem::path& folder) {
  return (folder / params.given("filename")->strings[0]).string() + "\n" + layer_name(params);
}

std::shared_ptr<const Image> read_light_image(const ParamReader& params, const ImageSource& source,
                                              const LightData& data) {
  const Param* file = params.given("filename");
  if (!file) return nullptr;
  LightImages* const kept = source.find(file->strings[0]) ? nullptr : data.kept;
  const std::filesystem::path key = light_image_key(params, source.folder);
  if (kept)
    if (const auto known = kept->find(key); known != kept->end()) return known->second;
  std::shared_ptr<const Image> image = read_named_image(params, *file, source);
  if (kept && image) kept->emplace(key, image);
  return image;
}

const EnvironmentMap* read_environment(const ParamReader& params, const LightContext& context) {
  const Param* file = params.given("filename");
  if (!file) return nullptr;
  const auto [entry, is_new] =
      context.data.environment_of.try_emplace(light_image_key(params, context.images.folder), nullptr);
  if (entry->second || !is_new) return entry->second;
  const std::shared_ptr<const Image> image = read_light_image(params, context.images, context.data);
  if (!image) return nullptr;
  if (EnvironmentMap::layout_of(image->width(), image->height()))
    return entry->second = &context.data.environments.emplace_back(*image);
  params.diagnostics().error(file->value_loc,
                             fmt::format("image \"{}\" of {} x {} texels is no map of directions", file->strings[0],
                                         image->width(), image->height()),
                             "valid: square (equal-area octahedral), or twice as wide as high (latitude-longitude)");
  return nullptr;
}

}  // namespace etd
