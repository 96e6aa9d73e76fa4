#include <nlohmann/json.hpp>

#include "render/path_names.h"
#include "render/replay.h"

namespace etd {
namespace {

using Json = nlohmann::ordered_json;

// A float is a double too, so that its digits read back as the same bits.
Json number(double v) {
  if (std::isnan(v)) return "NaN";
  if (std::isinf(v)) return v > 0 ? "Infinity" : "-Infinity";
  return v;
}

Json json(const Spectrum& s) { return {number(s[0]), number(s[1]), number(s[2])}; }
template <class V>
Json triple(const V& v) {
  return {number(v.x), number(v.y), number(v.z)};
}
Json json(const Vec2& v) { return {number(v.x), number(v.y)}; }

Json json(const PathItem& item) {
  Json j = {{"model", item.model}};
  if (!item.name.empty()) j["name"] = item.name;
  if (!item.place.empty()) j["place"] = item.place;
  return j;
}

void add_contribution(Json& to, int depth, const std::optional<Spectrum>& c) {
  to["component"] = component_name(depth);
  to["contribution"] = c ? json(*c) : Json();
}

Json json(const EmissionRecord& e, int depth, const ReplayedScene& in) {
  Json j = {{"light", json(light_item(in, e.light))},
            {"radiance", json(e.radiance)},
            {"pdf_scatter", number(e.pdf_scatter)},
            {"pdf_light", number(e.pdf_light)},
            {"mis_weight", number(e.mis_weight)}};
  add_contribution(j, depth, e.contribution);
  return j;
}

Json json(const LightRecord& l, int depth, const ReplayedScene& in) {
  Json j = {{"light", json(light_item(in, l.light))}, {"probability", number(l.probability)}};
  add_contribution(j, depth, l.contribution);
  if (!l.sample) return j;
  j["wi"] = triple(l.sample->wi);
  j["pdf"] = number(l.sample->pdf);
  j["delta"] = l.sample->is_delta;
  j["radiance"] = json(l.sample->radiance);
  j["f_cos"] = json(l.f_cos);
  j["visible"] = l.visible;
  if (!l.visible) return j;
  j["pdf_light"] = number(l.probability * l.sample->pdf);
  j["pdf_scatter"] = number(l.pdf_scatter);
  j["mis_weight"] = number(l.mis_weight);
  return j;
}

Json json(const BsdfSample& s) {
  Json j = {{"lobe", lobe_text(s.lobe)}, {"wi", triple(s.wi)}, {"pdf", number(s.pdf)}, {"weight", json(s.weight)}};
  if (!s.is_delta()) j["f_cos"] = json(s.weight * s.pdf);
  j["eta"] = number(s.eta);
  return j;
}

Json json(const PathVertex& v, const ReplayedScene& in) {
  Json j = {{"depth", v.depth}, {"throughput", json(v.throughput)}, {"wo", triple(v.wo)}};
  if (v.on_surface) {
    j["shape"] = json(shape_item(in, v.hit));
    j["primitive"] = v.hit.primitive;
    j["material"] = json(material_item(in, v.material));
    j["p"] = triple(file_position(in, v.surface.point.p));
    j["uv"] = json(v.surface.point.uv);
    j["ng"] = triple(v.surface.point.ng);
    j["ns"] = triple(v.ns);
  }
  for (const EmissionRecord& e : v.emission) j["emission"].push_back(json(e, v.depth, in));
  if (v.light) j["light"] = json(*v.light, v.depth + 1, in);
  if (v.scatter) j["scattering"] = json(*v.scatter);
  if (v.roulette) j["roulette"] = {{"survival", number(v.roulette->survival)}, {"survived", v.roulette->survived}};
  return j;
}

}  // namespace

std::string replay_json(const PathRecord& path, const ReplayedScene& in) {
  const PixelSample& s = path.sample;
  Json j = {{"pixel", {path.id.x, path.id.y}},
            {"sample", path.id.number},
            {"replicate", path.replicate},
            {"index", path.index},
            {"film", json(path.camera.film)},
            {"lens", json(path.camera.lens)},
            {"time", number(path.ray.time)},
            {"ray", {{"o", triple(file_position(in, path.ray.o))}, {"d", triple(path.ray.d)}}}};
  j["vertices"] = Json::array();
  for (const PathVertex& v : path.vertices) j["vertices"].push_back(json(v, in));
  j["end"] = end_text(path.end);
  j["sum"] = {{"emission", json(s.emission)}, {"direct", json(s.direct)}, {"indirect", json(s.indirect)}};
  j["filter_weight"] = number(s.weight);
  const Received film = received_by_film(path, in);
  j["valid"] = film.valid;
  j["received"] = {{"rgb", film.rgb}, {"luminance", film.luminance}};
  return j.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace etd
