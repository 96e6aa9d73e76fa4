#include "render/output.h"

#include <fmt/format.h>

#include <array>

#include "io/cut_out.h"
#include "render/registry.h"
#include "render/version.h"

namespace etd {
namespace {

using Rgb = std::array<float, 3>;

Rgb to_floats(const std::array<double, 3>& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

std::vector<std::string> channel_names(const FilmSettings& kept) {
  std::vector<std::string> names = {"R",        "G",        "B",        "emission.R", "emission.G", "emission.B",
                                    "direct.R", "direct.G", "direct.B", "indirect.R", "indirect.G", "indirect.B",
                                    "stderr.R", "stderr.G", "stderr.B", "stderr.Y"};
  const auto add = [&names](bool wanted, std::initializer_list<const char*> more) {
    if (wanted) names.insert(names.end(), more.begin(), more.end());
  };
  add(kept.features, {"albedo.R", "albedo.G", "albedo.B", "normal.X", "normal.Y", "normal.Z", "depth.Z", "coverage.A"});
  add(kept.features && kept.positions, {"position.X", "position.Y", "position.Z"});
  add(kept.alpha, {"foreground.R", "foreground.G", "foreground.B", "foreground.A"});
  add(kept.ids, {"id.object", "id.material"});
  return names;
}

// The layers of radiance, and the picture that they make.
struct Radiance {
  Rgb picture{}, emission{}, direct{}, indirect{};
};

Rgb add_up(const Rgb& emission, const Rgb& direct, const Rgb& indirect) {
  Rgb sum;
  for (size_t i = 0; i < 3; ++i) sum[i] = (emission[i] + direct[i]) + indirect[i];
  return sum;
}

Radiance radiance(const PixelSums& sums) {
  Radiance r{.emission = to_floats(sums.mean(sums.emission)),
             .direct = to_floats(sums.mean(sums.direct)),
             .indirect = to_floats(sums.mean(sums.indirect))};
  r.picture = add_up(r.emission, r.direct, r.indirect);
  return r;
}

Vec3d to_vec(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

// The mean normal in the space of the layers, whose transform may scale: unit normals stay of unit length there.
Rgb normal_layer(const PixelSums& sums, const Transform& space) {
  const Vec3d n = space.normal(to_vec(sums.mean(sums.normal))) * std::cbrt(std::abs(space.determinant3()));
  return to_floats({n.x, n.y, n.z});
}

// The mean position in the space of the layers, where misses count as 0.
Rgb position_layer(const PixelSums& sums, const Transform& space) {
  const double coverage = sums.count > 0 ? sums.coverage / sums.count : 0.0;
  const Vec3d p = space.vector(to_vec(sums.mean(sums.position))) + (space.point({}) - Point3d{}) * coverage;
  return to_floats({p.x, p.y, p.z});
}

// The values of one pixel in the order of channel_names().
void append_pixel(const Film& film, int x, int y, std::vector<float>& out) {
  const PixelSums sums = film.total(x, y);
  const Radiance r = radiance(sums);
  for (const Rgb& layer : {r.picture, r.emission, r.direct, r.indirect})
    out.insert(out.end(), layer.begin(), layer.end());
  for (double e : film.standard_error(x, y)) out.push_back(static_cast<float>(e));
  const FilmSettings& kept = film.settings();
  const auto add = [&out](const Rgb& layer) { out.insert(out.end(), layer.begin(), layer.end()); };
  const auto add_mean = [&](double sum) { out.push_back(static_cast<float>(sums.count > 0 ? sum / sums.count : 0)); };
  if (kept.features) {
    add(to_floats(sums.mean(sums.albedo)));
    add(normal_layer(sums, kept.feature_space));
    add_mean(sums.depth);
    add_mean(sums.coverage);
    if (kept.positions) add(position_layer(sums, kept.feature_space));
  }
  if (kept.alpha) {
    add(add_up(to_floats(sums.mean(sums.surface_emission)), r.direct, r.indirect));
    add_mean(sums.alpha);
  }
  if (!kept.ids) return;
  const SurfaceIds& ids = film.ids(x, y);
  for (const uint32_t id : {ids.object, ids.material}) out.push_back(static_cast<float>(id));
}

// The value that a model uses for a parameter: given, or its default.
MetadataValue parameter_value(const ParamReader& reader, const ParamDecl& p) {
  if (p.array) {
    const Param* given = reader.given(p.name);
    if (!given) return std::string();
    return fmt::format("{}{}{}", fmt::join(given->numbers, ","), fmt::join(given->integers, ","),
                       fmt::join(given->strings, ","));
  }
  switch (p.type) {
    case ParamType::kBool:
      return std::string(reader.boolean(p.name) ? "true" : "false");
    case ParamType::kInteger:
      return reader.integer(p.name);
    case ParamType::kFloat:
      return reader.number(p.name);
    case ParamType::kString:
      return reader.string(p.name);
    default:
      return fmt::format("{}", fmt::join(reader.numbers(p.name), ","));
  }
}

const char* stopped_by_name(StoppedBy reason) {
  switch (reason) {
    case StoppedBy::kSamples:
      return "samples";
    case StoppedBy::kInterrupt:
      return "interrupt";
    case StoppedBy::kTime:
      return "time";
    case StoppedBy::kError:
      return "error";
    case StoppedBy::kMemory:
      return "memory";
  }
  return "";
}

// Whether or not the error stopped it: an image that went on because its error looked large was selected as well.
std::string bias_text(const std::string& of_integrator, const Sensor& sensor, const RenderResult& result) {
  std::string text = of_integrator;
  if (const std::string limit = sensor.bias(); !limit.empty()) text += (text.empty() ? "" : "; ") + limit;
  if (result.error_tests > 0)
    text += fmt::format("{}adaptive stopping (the error was tested {} time{})", text.empty() ? "" : "; ",
                        result.error_tests, result.error_tests == 1 ? "" : "s");
  return text.empty() ? std::string("nothing") : text;
}

// The size and place of the film.
ImageHeader header_of(const FilmSettings& settings, std::vector<std::string> channels) {
  ImageHeader header;
  header.width = settings.crop.width();
  header.height = settings.crop.height();
  header.x = settings.crop.x0;
  header.y = settings.crop.y0;
  header.full_width = settings.width;
  header.full_height = settings.height;
  header.channels = std::move(channels);
  return header;
}

// What covers each pixel, and how much of it.
std::string write_cut_out(const std::filesystem::path& path, const RowImage& image, float exposure) {
  LayeredImage one;
  static_cast<ImageHeader&>(one) = image;
  one.height = 1;
  const auto append_rgba = [&image, &one](int row, std::vector<float>& out) {
    one.pixels.clear();
    image.append_row(row, one.pixels);
    CutOut cut = cut_out(one);
    divide_by_alpha(cut);
    for (size_t i = 0; i < cut.alpha.size(); ++i) {
      for (size_t c = 0; c < 3; ++c) out.push_back(cut.rgb[3 * i + c]);
      out.push_back(cut.alpha[i]);
    }
  };
  return write_rgb(path, image.width, image.height, append_rgba, exposure, true);
}

void append(const Rgb& values, std::vector<float>& out) { out.insert(out.end(), values.begin(), values.end()); }

}  // namespace

ImageHeader layers_header(const FilmSettings& settings, bool replicate_layers) {
  std::vector<std::string> channels = channel_names(settings);
  for (uint32_t r = 0; replicate_layers && r < settings.replicates; ++r)
    for (const char* c : {"R", "G", "B"}) channels.push_back(fmt::format("replicate{}.{}", r, c));
  return header_of(settings, std::move(channels));
}

RowImage layer_rows(const Film& film, bool replicate_layers) {
  const uint32_t replicates = replicate_layers ? film.settings().replicates : 0;
  return {layers_header(film.settings(), replicate_layers), [&film, replicates](int row, std::vector<float>& out) {
            const PixelBounds& crop = film.settings().crop;
            for (int x = crop.x0, y = crop.y0 + row; x < crop.x1; ++x) {
              append_pixel(film, x, y, out);
              for (uint32_t r = 0; r < replicates; ++r) append(radiance(film.sums(x, y, r)).picture, out);
            }
          }};
}

LayeredImage make_layers(const Film& film, bool replicate_layers) {
  return all_rows(layer_rows(film, replicate_layers));
}

LayeredImage make_picture(const Film& film) {
  return all_rows({header_of(film.settings(), {"R", "G", "B"}), [&film](int row, std::vector<float>& out) {
                     const PixelBounds& crop = film.settings().crop;
                     for (int x = crop.x0, y = crop.y0 + row; x < crop.x1; ++x)
                       append(radiance(film.total(x, y)).picture, out);
                   }});
}

Metadata make_metadata(const std::filesystem::path& scene, const RenderSettings& settings, const std::string& bias,
                       const RenderResult& result) {
  const FilmSettings& film = settings.film;
  const PixelBounds& crop = film.crop;
  // 64-bit numbers become text, since no number type of the format holds them all.
  Metadata data = {{"etendue:version", std::string(version())},
                   {"etendue:scene", scene.filename().string()},
                   {"etendue:integrator", settings.integrator.model}};
  if (const ModelDecl* decl = find_any_model(Family::kIntegrator, settings.integrator.model)) {
    Diagnostics checked_before;
    const ParamReader reader(*decl, settings.integrator, checked_before);
    for (const ParamDecl& p : decl->params)
      data.emplace_back("etendue:integrator." + p.name, parameter_value(reader, p));
  }
  const auto add = [&data](const char* name, MetadataValue value) {
    data.emplace_back(std::string("etendue:") + name, std::move(value));
  };
  add("sampler", std::string(settings.sampler.name()));
  add("seed", std::to_string(settings.seed));
  add("replicates", static_cast<int>(film.replicates));
  if (film.replicates != film.all_replicates())
    add("replicate_range", fmt::format("{} to {} of {}", film.first_replicate,
                                       film.first_replicate + film.replicates - 1, film.all_replicates()));
  add("spp", static_cast<int>(result.spp));
  add("spp_planned", settings.spp_unlimited ? MetadataValue(std::string("unlimited")) : static_cast<int>(settings.spp));
  add("spp_unequal", std::string(result.unequal ? "true" : "false"));
  if (result.empty > 0) add("empty", result.empty);
  if (settings.driver.seconds < HUGE_VAL) add("seconds_limit", settings.driver.seconds);
  if (settings.driver.error > 0) add("error_goal", settings.driver.error);
  add("imaging_ratio", film.sensor.imaging_ratio);
  add("white_balance", film.sensor.white_balance);
  add("size", fmt::format("{}x{}", film.width, film.height));
  add("crop", fmt::format("{},{},{},{}", crop.x0, crop.x1, crop.y0, crop.y1));
  add("rays.camera", std::to_string(result.rays.camera));
  add("rays.indirect", std::to_string(result.rays.indirect));
  add("rays.shadow", std::to_string(result.rays.shadow));
  add("seconds", result.seconds);
  add("error", result.error);
  const std::string noise_only = settings.traits.consistent ? "; noise only, without the bias" : "";
  const char* spread = film.replicates >= kReplicatesForSpread ? "spread of the replicates"
                                                               : "second moments (conservative for sobol samples)";
  add("stderr", spread + noise_only);
  add("consistent", std::string(settings.traits.consistent ? "true" : "false"));
  add("biased", bias_text(bias, film.sensor, result));
  add("invalid_samples", invalid_text(result.invalid));
  add("stopped_by", std::string(stopped_by_name(result.stopped_by)));
  add("interrupted", std::string(result.stopped_by == StoppedBy::kInterrupt ? "true" : "false"));
  return data;
}

std::string invalid_text(const InvalidSamples& invalid) {
  std::string text;
  for (const auto& [count, kind] : {std::pair(invalid.nan, "NaN"), std::pair(invalid.infinite, "infinite"),
                                    std::pair(invalid.negative, "negative")})
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, kind);
  return text.empty() ? std::string("none") : text;
}

std::string write_output(const std::filesystem::path& path, const RowImage& image, double exposure, bool alpha) {
  if (is_layered_path(path)) return write_layers(path, image);
  if (alpha) return write_cut_out(path, image, static_cast<float>(exposure));
  const std::array<int, 3> picture = {image.find("R"), image.find("G"), image.find("B")};
  std::vector<float> all;
  const auto append_rgb = [&](int row, std::vector<float>& out) {
    all.clear();
    image.append_row(row, all);
    for (size_t pixel = 0; pixel < all.size(); pixel += image.channels.size())
      for (int channel : picture) out.push_back(all[pixel + static_cast<size_t>(channel)]);
  };
  return write_rgb(path, image.width, image.height, append_rgb, static_cast<float>(exposure));
}

std::string write_output(const std::filesystem::path& path, const LayeredImage& image, double exposure, bool alpha) {
  return write_output(path, rows_of(image), exposure, alpha);
}

}  // namespace etd
