// Turns declared parameters into values and references to textures: the part of building a scene that materials, lights
// and textures share.
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>

#include "core/transform.h"
#include "params/declaration.h"
#include "textures/image_store.h"

namespace etd {

// Which textures a model makes; a model without a member kKind makes both.
enum class TextureKind : uint8_t { kFloat, kSpectrum };

// The RGB value of a spectrum parameter (rgb, float, spectrum, blackbody), or of its declared default, clamped where
// the declaration says so. Spectra become the mean seen under D65 (reflectance_rgb); unknown names are errors.
Spectrum spectrum_value(const ParamReader& params, std::string_view name);
// The same for emitted light: rgb and float as they are, spectra and blackbodies at luminance 1 (emission_rgb).
Spectrum emission_value(const ParamReader& params, std::string_view name);

// The textures built so far by name, and the means to build more.
class TextureBuilder {
 public:
  // `images`: those that are no files in the folder.
  TextureBuilder(TextureTable& table, std::filesystem::path folder, NamedImages images = {})
      : table_(table), images_(table, std::move(folder), std::move(images)) {}

  // Builds a checked use, whose children must have been built before. A float texture is made of float textures only.
  void add(const std::string& name, bool is_float, const ModelUse& use, const Transform& to_world,
           Diagnostics& diagnostics);
  // Call once when the world's origin is known: its coordinates are those of the scene file minus `origin`.
  void recentre(Vec3d origin);

  // These describe the texture that is being built: whether it is a float texture, where it was defined, and that as a
  // space of the table (an error if the transform is singular).
  bool is_float() const { return is_float_; }
  const Transform& to_world() const { return to_world_; }
  int32_t space(const ParamReader& params);

  SpectrumSource spectrum(const ParamReader& params, std::string_view name) const;
  FloatSource number(const ParamReader& params, std::string_view name) const;
  // A texture of the table that shows an image over uv, bilinear and repeated; -1 and an error when it can't be read.
  int32_t image_texture(const Param& filename, std::string_view encoding, const std::string& layer,
                        Diagnostics& diagnostics);
  // Index of an image of the table (see ImageStore::add()).
  int32_t image(const Param& filename, std::string_view encoding, const std::string& layer,
                std::optional<ImageWrap> levels, Diagnostics& diagnostics) {
    return images_.add(filename, encoding, layer, levels, diagnostics);
  }
  // Reads the images that were asked for since the last call; none can be looked up before.
  void load_images(const TextureMemory& memory, Diagnostics& diagnostics) { images_.load(memory, diagnostics); }

 private:
  int32_t find(const Param& reference, bool is_float, Diagnostics& diagnostics) const;

  TextureTable& table_;
  ImageStore images_;
  bool is_float_ = false;  // while a float texture is built
  Transform to_world_;
  std::vector<Transform> spaces_;  // to the world, of those of the table
  std::map<std::pair<std::string, bool>, int32_t> names_;
};

std::span<const ModelDecl* const> texture_models();

}  // namespace etd
