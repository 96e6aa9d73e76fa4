// All that an integrator sees of the film. It hands over samples, splats and counts; the sink admits or refuses values,
// exposes and sums them, counts what is invalid, and remembers the strongest. A work item has a sink of its own.
#pragma once

#include "film/film.h"
#include "film/invalid_samples.h"

namespace etd {

// What happened in a work item beside what the film holds; sums do not depend on the order of the items.
struct ItemCounts {
  RayCounts rays;
  InvalidSamples invalid;
  uint64_t light_paths = 0;

  ItemCounts& operator+=(const ItemCounts& b) {
    rays += b.rays, invalid += b.invalid, light_paths += b.light_paths;
    return *this;
  }
};

class Sink {
 public:
  explicit Sink(Film& film) : film_(film) {}
  Sink(const Sink&) = delete;
  Sink& operator=(const Sink&) = delete;

  // The samples of one pixel (full-image coordinates inside the crop) in one pass, replicate by replicate. They are
  // summed here and reach the film when their replicate is done. In a pass, no other item has samples of this pixel.
  // Replicates are named by their numbers in the whole image.
  class Pixel {
   public:
    Pixel(Sink& sink, int x, int y) : sink_(sink), x_(x), y_(y), replicate_(sink.film_.settings().first_replicate) {}
    ~Pixel();
    Pixel(const Pixel&) = delete;
    Pixel& operator=(const Pixel&) = delete;

    void add(uint32_t replicate, uint32_t index, PixelSample&& sample);

   private:
    void fold();

    Sink& sink_;
    int x_, y_;
    uint32_t replicate_;
    PixelSums sums_;  // of replicate_
    StrongestSample strongest_;
    PixelIds ids_;
  };

  // Light that a path from a light brings to the film after `depth` scattering events, not divided by the number of
  // paths. It is admitted once and may then be added to any pixel, also of other items, weighted with the pixel's
  // filter; what falls beside the crop is left out. `id` names the path, and the place, where the light is invalid.
  class Splat {
   public:
    Splat(Sink& sink, int depth, const Spectrum& light, const SampleId& id);
    void add(int x, int y, float filter) {
      const PixelBounds& crop = film_.settings().crop;
      if (x >= crop.x0 && x < crop.x1 && y >= crop.y0 && y < crop.y1) film_.splat(x, y, depth_, light_ * filter);
    }

   private:
    Film& film_;
    int depth_;
    Spectrum light_;
  };
  // Paths from lights that were begun, whether or not they reached the camera: what splats are divided by.
  void count_light_paths(uint64_t count) { counts_.light_paths += count; }
  // Rays that no sample of a pixel has counted.
  void count(const RayCounts& rays) { counts_.rays += rays; }

  const ItemCounts& counts() const { return counts_; }

 private:
  Film& film_;
  ItemCounts counts_;
};

inline void Sink::Pixel::add(uint32_t replicate, uint32_t index, PixelSample&& s) {
  const FilmSettings& film = sink_.film_.settings();
  if (replicate != replicate_) {
    fold();
    replicate_ = replicate;
  }
  const uint32_t number = index * film.all_replicates() + replicate;
  ids_.offer({s.distance2, number, s.ids});
  admit({x_, y_, number}, film.sensor, s, sink_.counts_.invalid);
  strongest_.offer({static_cast<float>(sums_.add(s)), number});
  sink_.counts_.rays += s.rays;
}

inline void Sink::Pixel::fold() {
  if (sums_.count > 0) sink_.film_.add(x_, y_, replicate_ - sink_.film_.settings().first_replicate, sums_);
  sums_ = {};
}

inline Sink::Pixel::~Pixel() {
  fold();
  sink_.film_.offer(x_, y_, strongest_);
  if (sink_.film_.settings().ids) sink_.film_.offer(x_, y_, ids_);
}

}  // namespace etd
