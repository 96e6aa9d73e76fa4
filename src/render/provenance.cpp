#include "render/provenance.h"

#include <fmt/format.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "core/hash.h"
#include "io/file.h"
#include "render/overrides.h"

namespace etd {
namespace {

uint64_t hash_bytes(uint64_t hash, std::string_view bytes) {
  hash = hash_combine(hash, bytes.size());
  for (; !bytes.empty(); bytes.remove_prefix(std::min<size_t>(8, bytes.size()))) {
    uint64_t word = 0;
    std::memcpy(&word, bytes.data(), std::min<size_t>(8, bytes.size()));
    hash = hash_combine(hash, word);
  }
  return hash;
}

// Where the number of samples was left to a limit of time or error, the options ask for enough of them to contain every
// one taken.
std::vector<std::string> options(const PreparedRender& prepared, const RenderResult& result) {
  RenderOverrides overrides = prepared.overrides;
  if (const RenderSettings& s = prepared.settings; s.spp_unlimited) {
    const uint32_t replicates = s.film.all_replicates();
    const Pass next = next_pass({0, 0, result.spp / replicates}, s.spp / replicates);
    overrides.spp = result.unequal ? next.end * replicates : result.spp;
  }
  std::vector<std::string> list = sample_options(overrides);
  if (!prepared.camera_file.empty()) {
    list.emplace_back("--camera");
    list.push_back(std::filesystem::absolute(prepared.camera_file).lexically_normal().string());
  }
  if (prepared.allow_unsupported) list.emplace_back("--allow-unsupported");
  for (const std::string& limit : changed_limits(prepared.limits)) {
    list.emplace_back("--limit");
    list.push_back(limit);
  }
  return list;
}

// Quotes the word as a shell reads it back.
std::string quoted(const std::string& word) {
  constexpr std::string_view kPlain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_./,=:+@%-";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  text += '\'';
  return text;
}

std::string command(const std::filesystem::path& scene, const SampleId& id, const std::vector<std::string>& options) {
  std::string text =
      fmt::format("etendue replay {} --pixel {},{} --sample {}", quoted(scene.string()), id.x, id.y, id.number);
  for (const std::string& option : options) text += fmt::format(" {}", quoted(option));
  return text;
}

std::string strongest_json(const Film& film) {
  std::string list;
  for (const SampleStrength& s : strongest_samples(film, kStrongestKept))
    list += fmt::format("{}[{},{},{},{},{:.6g}]", list.empty() ? "" : ",", s.id.x, s.id.y, s.id.number, s.luminance,
                        s.share);
  return fmt::format("[{}]", list);
}

}  // namespace

std::string hash_scene(const SceneDescription& description, const Sources& sources) {
  uint64_t hash = 0;
  std::vector<int32_t> read = description.sources;
  std::erase_if(read, [&sources](int32_t i) { return i >= sources.count(); });  // others have read them
  if (read.empty() || sources.name(read[0]) != description.file)
    hash = hash_bytes(hash, read_file(description.file).bytes);
  for (const int32_t i : read) hash = hash_bytes(hash, sources.text(i));
  return fmt::format("{:016x}", hash);
}

std::string replay_command(const PreparedRender& prepared, const RenderResult& result, const SampleId& id) {
  return command(prepared.scene_file, id, options(prepared, result));
}

void add_provenance(const PreparedRender& prepared, const FinishedRender& finished, Metadata& metadata) {
  const std::vector<std::string> list = options(prepared, finished.result);
  const std::filesystem::path scene = std::filesystem::absolute(prepared.scene_file).lexically_normal();
  metadata.emplace_back("etendue:scene_path", scene.string());
  metadata.emplace_back("etendue:scene_hash", prepared.scene_hash);
  metadata.emplace_back("etendue:options",
                        nlohmann::json(list).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  metadata.emplace_back("etendue:substitutes", prepared.substitutes.empty() ? "none" : prepared.substitutes);
  metadata.emplace_back("etendue:strongest", strongest_json(finished.film));
  if (const auto& first = finished.result.invalid.first; first && prepared.settings.traits.replayable)
    metadata.emplace_back("etendue:invalid_replay", command(scene, *first, list));
}

std::optional<Provenance> read_provenance(const ImageHeader& image) {
  const auto text = [&image](const char* name) -> std::string {
    const MetadataValue* value = image.find_metadata(std::string("etendue:") + name);
    const std::string* s = value ? std::get_if<std::string>(value) : nullptr;
    return s ? *s : std::string();
  };
  Provenance p;
  p.scene = text("scene_path");
  p.scene_hash = text("scene_hash");
  p.version = text("version");
  try {
    nlohmann::json::parse(text("options")).get_to(p.options);
    for (const nlohmann::json& entry : nlohmann::json::parse(text("strongest"))) {
      SampleStrength s{{entry.at(0), entry.at(1), entry.at(2)}, 0, entry.at(4)};
      s.luminance = entry.at(3);
      p.strongest.push_back(s);
    }
  } catch (const nlohmann::json::exception&) {
    return {};
  }
  return p.scene.empty() ? std::nullopt : std::optional(p);
}

}  // namespace etd
