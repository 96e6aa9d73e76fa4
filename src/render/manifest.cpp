#include "render/manifest.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>

#include "film/pixel_ids.h"

namespace etd {
namespace {

std::string label(const SceneNames::Item& item, const std::string& name, const Sources& sources) {
  std::string text = name.empty() ? std::string(item.model) : fmt::format("{} ({})", name, item.model);
  if (item.loc.file >= 0) text += fmt::format(", {}:{}", sources.name(item.loc.file), item.loc.line);
  return text;
}

std::string manifest(const std::set<uint32_t>& ids, const std::vector<std::string>& labels) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const uint32_t id : ids)
    if (id > 0 && id <= labels.size()) json[std::to_string(id)] = labels[id - 1];
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace

IdLabels label_ids(const SceneNames& names, Diagnostics& diagnostics) {
  IdLabels labels;
  if (names.objects.size() >= kMostIds) {
    diagnostics.error(
        {}, fmt::format("the scene has {} objects, and ids are told apart for {}", names.objects.size(), kMostIds - 1),
        "leave out --id-layers");
    return labels;
  }
  for (const SceneNames::Object& o : names.objects) labels.objects.push_back(label(o, o.name, diagnostics.sources()));
  for (size_t i = 0; i < names.materials.size(); ++i)
    labels.materials.push_back(label(names.materials[i], names.material_names[i], diagnostics.sources()));
  return labels;
}

void add_manifests(const IdLabels& labels, const Film& film, Metadata& metadata) {
  const PixelBounds& crop = film.settings().crop;
  std::set<uint32_t> objects, materials;
  for (int y = crop.y0; y < crop.y1; ++y)
    for (int x = crop.x0; x < crop.x1; ++x) {
      objects.insert(film.ids(x, y).object);
      materials.insert(film.ids(x, y).material);
    }
  metadata.emplace_back("etendue:id.object", manifest(objects, labels.objects));
  metadata.emplace_back("etendue:id.material", manifest(materials, labels.materials));
}

}  // namespace etd
