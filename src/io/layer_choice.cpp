#include "io/layer_choice.h"

#include <algorithm>

#include <fmt/format.h>

#include "io/file.h"

namespace etd {
namespace {

bool same_letters(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](char x, char y) { return lower(x) == lower(y); });
}

// The name by which a layer can be asked for; with that of its part where there are several.
std::string full_name(const PartLayer& layer, bool many_parts) {
  if (layer.prefix.empty()) return layer.part_name;
  const bool says_part = layer.prefix == layer.part_name || layer.prefix.starts_with(layer.part_name + ".");
  return !many_parts || layer.part_name.empty() || says_part ? layer.prefix : layer.part_name + "." + layer.prefix;
}

std::string listed(const std::vector<const PartLayer*>& layers, bool many_parts) {
  constexpr size_t kShown = 20, kLongest = 40;
  std::vector<std::string> titles;
  for (const PartLayer* l : layers) {
    if (titles.size() == kShown) return fmt::format("{}, ...", fmt::join(titles, ", "));
    std::string name = full_name(*l, many_parts);
    if (name.size() > kLongest) name = name.substr(0, kLongest) + "...";
    titles.push_back(fmt::format("{}({})", name.empty() ? "" : in_quotes(name) + " ", fmt::join(l->names, ", ")));
  }
  return fmt::format("{}", fmt::join(titles, ", "));
}

// Without a name.
LayerChoice choose_among(const std::vector<const PartLayer*>& all, bool many_parts) {
  std::vector<const PartLayer*> rgb, plain_rgb, grey;
  for (const PartLayer* l : all) {
    if (l->has_rgb()) (l->prefix.empty() ? plain_rgb : rgb).push_back(l);
    if (l->is_grey() && l->prefix.empty()) grey.push_back(l);
  }
  for (const auto* found : {&plain_rgb, &rgb, &grey}) {
    if (found->size() == 1) return {found->front(), {}};
    if (found->size() > 1)
      return {nullptr, fmt::format("it has several parts or layers, {}", listed(*found, many_parts))};
  }
  if (all.size() == 1) return {all[0], {}};
  return {nullptr,
          fmt::format("none of its parts and layers has R, G, B or Y, but it has {}", listed(all, many_parts))};
}

}  // namespace

int PartLayer::find(std::string_view name) const {
  for (size_t i = 0; i < names.size(); ++i)
    if (same_letters(names[i], name)) return channels[i];
  return -1;
}

bool PartLayer::is_called(std::string_view name) const {
  return name == prefix || name == part_name || (!prefix.empty() && name == part_name + "." + prefix);
}

void add_layers(int part, const std::string& part_name, const std::vector<std::string>& channels,
                std::vector<PartLayer>& to) {
  const auto first = static_cast<std::ptrdiff_t>(to.size());
  for (size_t c = 0; c < channels.size(); ++c) {
    const std::string& name = channels[c];
    const size_t dot = name.rfind('.');
    const std::string prefix = dot == std::string::npos ? "" : name.substr(0, dot);
    auto layer = std::find_if(to.begin() + first, to.end(), [&](const PartLayer& l) { return l.prefix == prefix; });
    if (layer == to.end()) layer = to.insert(to.end(), {part, part_name, prefix, {}, {}});
    layer->channels.push_back(static_cast<int>(c));
    layer->names.push_back(dot == std::string::npos ? name : name.substr(dot + 1));
  }
}

LayerChoice choose_layer(const std::vector<PartLayer>& layers, const std::string& name) {
  const bool many_parts = !layers.empty() && layers.back().part != layers.front().part;
  std::vector<const PartLayer*> all, named;
  for (const PartLayer& l : layers) {
    all.push_back(&l);
    if (l.is_called(name)) named.push_back(&l);
  }
  if (name.empty()) return choose_among(all, many_parts);
  if (named.size() == 1) return {named[0], {}};
  // The name of a part that is also that of its main layer, or whose layers have other names.
  const bool same_part =
      std::all_of(named.begin(), named.end(), [&](const PartLayer* l) { return l->part == named[0]->part; });
  const auto exact = std::find_if(named.begin(), named.end(), [&](const PartLayer* l) { return l->prefix == name; });
  if (same_part && exact != named.end()) return {*exact, {}};
  if (same_part && !named.empty()) return choose_among(named, many_parts);
  return {nullptr, fmt::format("it has {} {}, but {}", named.empty() ? "no part or layer" : "several parts or layers",
                               in_quotes(name), listed(all, many_parts))};
}

}  // namespace etd
