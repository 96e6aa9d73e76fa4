// What it takes to draw any sample of an image again, kept in the image itself: the scene, the options that it was
// rendered with, a hash that tells whether the scene is still the same, and the samples that may be worth a look.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "film/strongest.h"
#include "render/session.h"

namespace etd {

// Hashes the texts that scene and view were read from, or the scene's file itself if that is no text; meshes and images
// do not count. The hash has 16 hexadecimal digits.
std::string hash_scene(const SceneDescription& description, const Sources& sources);

// The command that shows this sample of an image step by step: the scene as it was named, and the options that matter.
std::string replay_command(const PreparedRender& prepared, const RenderResult& result, const SampleId& id);

// Adds to the metadata of an image "etendue:scene_path" (absolute), ":scene_hash", ":options" (a JSON list),
// ":substitutes" (what stands in for unsupported uses, or "none"), ":strongest" (the kStrongestKept strongest samples,
// a JSON list of [x, y, sample, luminance, share of the pixel's mean]), and, where samples were invalid,
// ":invalid_replay", the command that shows the first of them.
inline constexpr size_t kStrongestKept = 64;
void add_provenance(const PreparedRender& prepared, const FinishedRender& finished, Metadata& metadata);

struct Provenance {
  std::filesystem::path scene;
  std::string scene_hash, version;
  std::vector<std::string> options;
  std::vector<SampleStrength> strongest;  // without the field `strength`

  // The same render; the strongest samples follow from the rest.
  bool operator==(const Provenance& other) const {
    return scene == other.scene && scene_hash == other.scene_hash && version == other.version &&
           options == other.options;
  }
};
// Nothing when the metadata are not what add_provenance() writes.
std::optional<Provenance> read_provenance(const ImageHeader& image);

}  // namespace etd
