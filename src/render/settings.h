// Everything a render needs to know beside the scene itself: what the scene file asks for, overridden by the caller.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "integrators/integrator.h"
#include "params/diagnostics.h"
#include "render/driver.h"
#include "samplers/sampler.h"
#include "scene/description.h"
#include "textures/image_store.h"

namespace etd {

struct RenderSettings {
  // Of the replicates that are rendered; feature_space starts from the world as the description gives it.
  FilmSettings film{.width = 1280, .height = 720, .crop = {0, 0, 1280, 720}};
  DriverSettings driver;       // of the replicates that are rendered
  uint32_t spp = 16;           // of the whole image, at most; a multiple of all replicates
  bool spp_unlimited = false;  // nobody asked for a number of samples: spp is the largest possible one
  uint64_t seed = 0;
  SamplerKind sampler;
  ModelUse integrator;  // with the overrides applied
  IntegratorTraits traits;
  int tile_size = 16;
  TextureMemory textures;
  std::string filename;  // that the scene's film asks for
  bool half = false;     // EXR files of 16-bit floats
};

// What the caller overrides; absent means as the scene says.
struct RenderOverrides {
  std::optional<std::pair<int, int>> size;
  std::optional<PixelBounds> crop;
  std::optional<uint32_t> spp, replicates;
  std::optional<std::pair<uint32_t, uint32_t>> replicate_range;  // the first one and how many are rendered of them
  // Stop conditions. With one of them, the samples that the scene asks for do not count, only those given here.
  std::optional<double> seconds, error;
  std::optional<uint64_t> seed;
  std::optional<int> threads, tile_size;
  std::optional<bool> features, alpha, ids;
  std::optional<size_t> texture_memory;
  std::optional<std::filesystem::path> texture_cache;
  std::optional<std::string> sampler, integrator;
  // "integrator.mode" = "naive" and the like: a declared parameter of the film, sampler or integrator model.
  std::vector<std::pair<std::string, std::string>> set;
};

// Reads film, sampler and integrator of the description, applies the overrides, checks both.
RenderSettings make_settings(const SceneDescription& description, const RenderOverrides& overrides,
                             Diagnostics& diagnostics);

}  // namespace etd
