// Accumulates an image as R independent replicates, in doubles, so that its error can be told from their spread
// (docs/architecture.md, "The estimate").
#pragma once

#include <optional>
#include <vector>

#include "core/bounds.h"
#include "core/transform.h"
#include "film/feature_store.h"
#include "film/pixel_sample.h"
#include "film/sensor.h"
#include "film/splat_buffer.h"
#include "film/strongest.h"

namespace etd {

// From this many replicates on, the standard error comes from their spread (Student t with R - 1 degrees of freedom).
inline constexpr uint32_t kReplicatesForSpread = 4;

struct FilmSettings {
  int width = 0, height = 0;  // of the full image
  PixelBounds crop;           // the pixels kept
  uint32_t replicates = 2;    // kept here: those from number first_replicate on, of `of_replicates` of the whole image
  uint32_t first_replicate = 0;
  uint32_t of_replicates = 0;  // 0: as many as up to the last one kept
  bool features = true;        // albedo, normal, depth, coverage
  bool positions = false;      // beside the features, if there are any
  bool alpha = false;          // and the light of what it covers
  bool ids = false;            // of objects and materials
  bool splats = false;         // light comes as splats, one replicate after the other
  bool correlated = false;     // errors of pixels depend on each other, and only replicates tell that of a region
  Transform feature_space{};   // from the recentred world to the space of the layers of normals and positions
  Sensor sensor{};             // through which samples go before they are added

  // How many replicates the whole image has.
  uint32_t all_replicates() const { return of_replicates > 0 ? of_replicates : first_replicate + replicates; }
};

// A replicate is named here by its place among those that are kept, from 0 on.
class Film {
 public:
  explicit Film(const FilmSettings& settings);
  const FilmSettings& settings() const { return settings_; }

  // Adds the sums of one pass to a pixel (full-image coordinates inside the crop). Different pixels may be added
  // concurrently; sums of one (pixel, replicate) are added in the order of the calls.
  void add(int x, int y, uint32_t replicate, const PixelSums& sums);
  // Remembers the candidate if the pixel has none that is as strong.
  void offer(int x, int y, const StrongestSample& candidate) { strongest_[pixel(x, y)].offer(candidate); }
  const StrongestSample& strongest(int x, int y) const { return strongest_[pixel(x, y)]; }
  // Remembers the ids if the pixel has none of a sample that is as near to its centre; only of a film with ids.
  void offer(int x, int y, const PixelIds& candidate) { ids_[pixel(x, y)].offer(candidate); }
  const SurfaceIds& ids(int x, int y) const { return ids_[pixel(x, y)].ids; }
  // Adds light that came to a pixel inside the crop after `depth` scattering events; only of a film with splats. Any
  // thread may add to any pixel.
  void splat(int x, int y, int depth, const Spectrum& light);
  // Makes all splats of a row, which came from `light_paths` paths and brought `rays` rays about in the whole image,
  // samples of the replicate: as many for each pixel as there were paths for each pixel of the full image. Different
  // rows may be folded concurrently.
  void fold_splats(int y, uint32_t replicate, uint64_t light_paths, uint64_t rays);
  // The light and the number of samples that have been accumulated so far for a pixel and replicate. Squares are kept
  // where there are fewer than kReplicatesForSpread replicates, and 0 otherwise.
  PixelSums sums(int x, int y, uint32_t replicate) const;
  // The same of all replicates, folded in their order.
  PixelSums light(int x, int y) const;
  // light() with the features of all replicates, and rays.
  PixelSums total(int x, int y) const;
  // Those replicates alone whose numbers in the whole image are even (0) or odd (1), with their features.
  PixelSums half(int x, int y, uint32_t parity) const;
  // Standard error of the pixel's mean R, G, B and Y: from the spread of the replicate means where four or more have
  // samples, otherwise from the second moments of the samples (conservative for low-discrepancy sampling); +inf where
  // too few samples or replicates know it.
  std::array<double, 4> standard_error(int x, int y) const;

  size_t bytes() const;
  static size_t bytes_for(const FilmSettings& settings);

 private:
  size_t pixel(int x, int y) const;
  size_t offset(int x, int y, uint32_t replicate) const;

  FilmSettings settings_;
  size_t channels_;           // doubles of a replicate of a pixel
  std::vector<double> sums_;  // [pixel][replicate][channel]
  std::vector<double> rays_;  // by pixel
  FeatureStore features_;
  std::vector<StrongestSample> strongest_;
  std::vector<PixelIds> ids_;          // empty without ids
  std::optional<SplatBuffer> splats_;  // [pixel][emission, direct, indirect][lane]
};

}  // namespace etd
