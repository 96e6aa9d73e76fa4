#include "lights/projection.h"

namespace etd {

namespace {

// Solid angle of the rectangle from (0, 0) to (x, y) in the plane z = 1, signed.
double solid_angle_to(double x, double y) { return std::atan(x * y / std::sqrt(1.0 + x * x + y * y)); }

}  // namespace

std::optional<PointLight<ProjectionIntensity>> ProjectionIntensity::create(const ParamReader& p,
                                                                           const LightContext& context) {
  const std::optional<Frame> axes = light_axes(context.to_world, p);
  const double fov = p.number("fov");
  const bool flat = !(fov < 180.0);
  if (flat) p.diagnostics().error(p.given("fov")->value_loc, "the field of view must be below 180 degrees");
  if (!p.given("filename")) return {};
  const auto [entry, is_new] = context.data.slide_of.try_emplace({light_image_key(p, context.images.folder), fov});
  LightData::Slide& slide = entry->second;
  if (is_new)
    if (auto image = read_light_image(p, context.images, context.data))
      slide.image = context.data.keep(std::move(image));
  if (!slide.image || !axes || flat) return {};
  const double half = std::tan(0.5 * radians(fov));
  const double aspect = static_cast<double>(slide.image->width()) / slide.image->height();
  const auto half_x = static_cast<float>(half * std::max(1.0, aspect));
  const auto half_y = static_cast<float>(half * std::max(1.0, 1.0 / aspect));
  ProjectionIntensity light = of(slide, *axes, half_x, half_y, context.data);
  light.scale = emission_scale(p, "power", light.power());
  return PointLight<ProjectionIntensity>{light_position(p, context), light};
}

ProjectionIntensity ProjectionIntensity::of(LightData::Slide& slide, const Frame& axes, float half_x, float half_y,
                                            LightData& data) {
  ProjectionIntensity light;
  light.image = slide.image;
  light.axes = axes;
  light.half_x = half_x;
  light.half_y = half_y;
  if (!slide.texels) {
    const int width = light.image->width(), height = light.image->height();
    std::vector<double> weights;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        weights.push_back(static_cast<double>(mean_value(light.texel(x, y))) * light.solid_angle(x, y));
    slide.texels = &data.grids.emplace_back(width, height, weights);
  }
  light.texels = slide.texels;
  return light;
}

Spectrum ProjectionIntensity::texel(int x, int y) const {
  const auto channel = [&](int c) { return std::max(0.0f, image->texel(x, y, image->channels() == 1 ? 0 : c)); };
  return Spectrum::rgb(channel(0), channel(1), channel(2)) * scale;
}

std::optional<ProjectionIntensity::Cell> ProjectionIntensity::cell_of(Vec3 v) const {
  if (!(v.z > 0.0f)) return {};
  const float s = 0.5f + 0.5f * v.x / (v.z * half_x), t = 0.5f - 0.5f * v.y / (v.z * half_y);
  if (!(s >= 0.0f && s < 1.0f && t >= 0.0f && t < 1.0f)) return {};
  const int width = image->width(), height = image->height();
  return Cell{std::min(static_cast<int>(s * static_cast<float>(width)), width - 1),
              std::min(static_cast<int>(t * static_cast<float>(height)), height - 1)};
}

Spectrum ProjectionIntensity::intensity(Vec3 w, const ShadingContext&) const {
  const auto cell = cell_of(axes.to_local(w));
  return cell ? texel(cell->x, cell->y) : Spectrum();
}

// Uniform over the image within a texel: times W H / (4 half_x half_y) per area at z = 1, of which a solid angle
// dw covers dw / cos^3.
std::optional<Vec3> ProjectionIntensity::sample(Vec2 u) const {
  if (!texels->any()) return {};
  const GridDistribution::Sample at = texels->sample(u);
  const float s = (static_cast<float>(at.x) + at.offset.x) / static_cast<float>(image->width());
  const float t = (static_cast<float>(at.y) + at.offset.y) / static_cast<float>(image->height());
  return normalize(axes.to_world({(2.0f * s - 1.0f) * half_x, (1.0f - 2.0f * t) * half_y, 1.0f}));
}

float ProjectionIntensity::pdf(Vec3 w) const {
  const Vec3 v = axes.to_local(w);
  const auto cell = cell_of(v);
  if (!cell) return 0.0f;
  const float texel_area = 4.0f * half_x * half_y / static_cast<float>(image->width() * image->height());
  return texels->probability(cell->x, cell->y) / (texel_area * v.z * v.z * v.z);
}

double ProjectionIntensity::solid_angle(int x, int y) const {
  const auto edge = [](int i, int n, float half) { return half * (2.0 * i / n - 1.0); };
  const double x0 = edge(x, image->width(), half_x), x1 = edge(x + 1, image->width(), half_x);
  const double y0 = edge(y, image->height(), half_y), y1 = edge(y + 1, image->height(), half_y);
  return solid_angle_to(x1, y1) - solid_angle_to(x0, y1) - solid_angle_to(x1, y0) + solid_angle_to(x0, y0);
}

Spectrum ProjectionIntensity::power() const {
  double sum[3] = {0, 0, 0};
  for (int y = 0; y < image->height(); ++y)
    for (int x = 0; x < image->width(); ++x) {
      const Spectrum value = texel(x, y);
      for (int c = 0; c < 3; ++c) sum[c] += static_cast<double>(value[c]) * solid_angle(x, y);
    }
  return Spectrum::rgb(static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2]));
}

// The cone around the corners; the mean over the image has to do for its intensity.
void ProjectionIntensity::bound(LightBounds& b) const {
  b.cone = {axes.z, std::atan(std::hypot(half_x, half_y)), false};
  b.fall = 0;
  b.intensity = luminance(power()) / static_cast<float>(4.0 * solid_angle_to(half_x, half_y));
}

}  // namespace etd
