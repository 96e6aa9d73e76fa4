#include <fmt/format.h>

#include <algorithm>

#include "film/invalid_samples.h"
#include "render/path_names.h"
#include "render/replay.h"

namespace etd {
namespace {

// Radiance in digits that read back as the same floats.
std::string exact(const Spectrum& s) { return fmt::format("({}, {}, {})", s[0], s[1], s[2]); }
std::string text(const Spectrum& s) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", s[0], s[1], s[2]); }
template <class V>
std::string triple(const V& v) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x, v.y, v.z);
}

// "sphere, scene.pbrt:12", "glass (dielectric), scene.pbrt:7".
std::string text(const PathItem& item) {
  return fmt::format("{}{}{}", item.name.empty() ? item.model : fmt::format("{} ({})", item.name, item.model),
                     item.place.empty() ? "" : ", ", item.place);
}

class Table {
 public:
  Table(const PathRecord& path, const ReplayedScene& in) : path_(path), in_(in) {}

  std::string text_of_all() {
    const CameraSample& c = path_.camera;
    line("pixel {},{}  sample {} (index {} of replicate {})", path_.id.x, path_.id.y, path_.id.number, path_.index,
         path_.replicate);
    if (!path_.vertices.empty())
      line("camera      film ({}, {})  lens ({}, {})  time {}  ray from {} along {}", c.film.x, c.film.y, c.lens.x,
           c.lens.y, path_.ray.time, triple(file_position(in_, path_.ray.o)), triple(path_.ray.d));
    for (const PathVertex& v : path_.vertices) add(v);
    if (!path_.vertices.empty()) line("\nend         {}", end_text(path_.end));
    add_sum();
    return std::move(out_);
  }

 private:
  template <class... Args>
  void line(fmt::format_string<Args...> format, Args&&... args) {
    out_ += fmt::format(format, std::forward<Args>(args)...);
    out_ += '\n';
  }

  void add(const PathVertex& v) {
    if (!v.on_surface) {
      line("\nvertex {}    no surface along {}", v.depth, triple(-v.wo));
      line("  throughput  {}", exact(v.throughput));
    } else {
      const SurfacePoint& p = v.surface.point;
      line("\nvertex {}    {}  [{} {}]", v.depth, text(shape_item(in_, v.hit)),
           v.hit.on_quadric() ? "quadric"
           : v.hit.on_patch() ? "patch"
                              : "triangle",
           v.hit.primitive);
      line("  material    {}", text(material_item(in_, v.material)));
      line("  p           {}  uv ({:.6g}, {:.6g})", triple(file_position(in_, p.p)), p.uv.x, p.uv.y);
      line("  ng          {}  ns {}", triple(p.ng), triple(v.ns));
      line("  wo          {}  cos {:.6g}", triple(v.wo), dot(v.wo, v.ns));
      line("  throughput  {}", exact(v.throughput));
    }
    for (const EmissionRecord& e : v.emission) add(v, e);
    if (v.light) add(v, *v.light);
    if (v.scatter) add(v, *v.scatter);
    if (v.roulette)
      line("  roulette    survival probability {:.6g}: {}", v.roulette->survival,
           v.roulette->survived ? "goes on" : "ends");
  }

  void add(const PathVertex& v, const EmissionRecord& e) {
    line("  emission    {}: radiance {}", text(light_item(in_, e.light)), text(e.radiance));
    if (v.depth > 0)  // a camera ray has no other way
      line("              pdf of scattering {:.6g}, of light sampling {:.6g}: MIS weight {:.6g}", e.pdf_scatter,
           e.pdf_light, e.mis_weight);
    add_contribution(v.depth, e.contribution);
  }

  void add(const PathVertex& v, const LightRecord& l) {
    line("  light       {}: chosen with probability {:.6g}", text(light_item(in_, l.light)), l.probability);
    if (!l.sample) line("              sends nothing here");
    if (l.sample) add_sample(v, l);
    // What is black is left out, unless the throughput makes something of it that is not a number.
    if (l.visible || (l.contribution && !is_black(*l.contribution))) add_contribution(v.depth + 1, l.contribution);
  }

  void add_sample(const PathVertex& v, const LightRecord& l) {
    line("              wi {}  cos {:.6g}  pdf {:.6g}{}  radiance {}", triple(l.sample->wi), dot(l.sample->wi, v.ns),
         l.sample->pdf, l.sample->is_delta ? " (delta)" : "", text(l.sample->radiance));
    line("              f cos {}{}", text(l.f_cos), is_black(l.f_cos) ? "" : l.visible ? ", visible" : ", occluded");
    if (l.visible)
      line("              pdf of light sampling {:.6g}, of scattering {:.6g}: MIS weight {:.6g}",
           l.probability * l.sample->pdf, l.pdf_scatter, l.mis_weight);
  }

  void add(const PathVertex& v, const BsdfSample& s) {
    line("  scattering  {}: wi {}  cos {:.6g}", lobe_text(s.lobe), triple(s.wi), dot(s.wi, v.ns));
    line("              f cos {}  {} {:.6g}  weight {}{}", text(s.is_delta() ? s.weight : s.weight * s.pdf),
         s.is_delta() ? "(delta) probability" : "pdf", s.pdf, text(s.weight),
         s.eta == 1.0f ? std::string() : fmt::format("  eta {:.6g}", s.eta));
  }

  void add_contribution(int depth, const std::optional<Spectrum>& c) {
    if (c)
      line("  {:<11} {}", fmt::format("+{}", component_name(depth)), exact(*c));
    else
      line("              {} light is not kept", component_name(depth));
  }

  void add_sum() {
    const PixelSample& s = path_.sample;
    line("\nsum         emission {}", exact(s.emission));
    line("            direct   {}", exact(s.direct));
    line("            indirect {}", exact(s.indirect));
    const Received film = received_by_film(path_, in_);
    line("film        ({}, {}, {})  luminance {}  (the sum, exposed, times the filter's weight {})", film.rgb[0],
         film.rgb[1], film.rgb[2], film.luminance, s.weight);
    if (!film.valid) line("            the sample is invalid: the film received black instead");
  }

  const PathRecord& path_;
  const ReplayedScene& in_;
  std::string out_;
};

// Says where on the path the largest contribution was made, and with what light.
struct Brightest {
  size_t vertex = 0;
  uint32_t light = kNoId;
  bool by_light_sampling = false;
  float luminance = 0;
};

Brightest brightest(const PathRecord& path) {
  Brightest best;
  const auto offer = [&best](size_t vertex, uint32_t light, bool sampled, const std::optional<Spectrum>& c) {
    if (!c) return;
    const float y = luminance(*c);
    if (y > best.luminance || (best.light == kNoId && !(y <= 0))) best = {vertex, light, sampled, y};
  };
  for (size_t i = 0; i < path.vertices.size(); ++i) {
    for (const EmissionRecord& e : path.vertices[i].emission) offer(i, e.light, false, e.contribution);
    if (const auto& l = path.vertices[i].light) offer(i, l->light, true, l->contribution);
  }
  return best;
}

// "floor", "glass S" (by a delta lobe), "glass T" (through it), "glass ST".
std::string step(const PathVertex& v, const ReplayedScene& in) {
  std::string s = material_item(in, v.material).label();
  if (!v.scatter) return s;
  const bool delta = v.scatter->is_delta(), through = v.scatter->is_transmission();
  return fmt::format("{}{}{}{}", s, delta || through ? " " : "", delta ? "S" : "", through ? "T" : "");
}

}  // namespace

Received received_by_film(const PathRecord& path, const ReplayedScene& in) {
  PixelSample sample = path.sample;
  InvalidSamples invalid;
  admit(path.id, in.sensor, sample, invalid);
  PixelSums sums;
  const double luminance = sums.add(sample);
  const std::array<double, 4> mean = sums.mean_radiance();
  return {{mean[0], mean[1], mean[2]}, luminance, invalid.total() == 0};
}

std::string replay_text(const PathRecord& path, const ReplayedScene& in) { return Table(path, in).text_of_all(); }

std::string replay_line(const PathRecord& path, const ReplayedScene& in) {
  const Brightest best = brightest(path);
  if (best.light == kNoId) return "no light";
  std::vector<std::string> steps;
  const size_t surfaces = best.vertex + (best.by_light_sampling ? 1 : 0);
  for (size_t i = 0; i < surfaces; ++i) {
    const PathVertex& v = path.vertices[i];
    steps.push_back(i + 1 < surfaces || !best.by_light_sampling ? step(v, in) : material_item(in, v.material).label());
  }
  constexpr size_t kMost = 9, kEnds = 4;
  if (steps.size() > kMost) {
    const std::string middle = fmt::format("... {} more ...", steps.size() - 2 * kEnds);
    steps.erase(steps.begin() + kEnds, steps.end() - kEnds);
    steps.insert(steps.begin() + kEnds, middle);
  }
  steps.push_back(light_item(in, best.light).label() + (best.by_light_sampling ? " (light sampling)" : ""));
  return fmt::format("{}", fmt::join(steps, " > "));
}

}  // namespace etd
