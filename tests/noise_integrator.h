// An integrator without a scene, for tests of what stands around integrators: every sample is a known distribution
// computed from its own numbers (pixel, index, replicate), as the contract of a replayable integrator asks.
#pragma once

#include "core/hash.h"
#include "integrators/integrator.h"

namespace etd {

// Samples are uniform in [0, 2) times the pixel's mean x + 1, so a sample has the relative variance 1/3.
class NoiseIntegrator : public Integrator {
 public:
  explicit NoiseIntegrator(const FilmSettings& film, int tile_size = 16) : film_(film), tile_(tile_size) {}

  IntegratorTraits traits() const override { return {}; }
  size_t work_items(const Pass&, uint32_t) const override {
    return static_cast<size_t>(tiles(film_.crop.width())) * static_cast<size_t>(tiles(film_.crop.height()));
  }
  void render(const Pass& pass, uint32_t, size_t item, Sink& sink) override {
    const int columns = tiles(film_.crop.width());
    const int x0 = film_.crop.x0 + static_cast<int>(item) % columns * tile_;
    const int y0 = film_.crop.y0 + static_cast<int>(item) / columns * tile_;
    for (int y = y0; y < std::min(y0 + tile_, film_.crop.y1); ++y)
      for (int x = x0; x < std::min(x0 + tile_, film_.crop.x1); ++x) {
        Sink::Pixel pixel(sink, x, y);
        const auto [begin, end] = pass.samples(x, y);
        for (uint32_t r = pass.first_replicate; r < pass.end_replicate; ++r)
          for (uint32_t i = begin; i < end; ++i) pixel.add(r, i, sample(x, y, r, i));
      }
  }

 private:
  int tiles(int n) const { return (n + tile_ - 1) / tile_; }
  static PixelSample sample(int x, int y, uint32_t replicate, uint32_t index) {
    HashStream random(hash_combine(static_cast<uint64_t>(x), static_cast<uint64_t>(y), replicate, index));
    PixelSample s;
    const float v = 2 * static_cast<float>(x + 1) * random.next_float();
    const float share = 0.25f + 0.5f * unit_float(static_cast<uint32_t>(x) << 27);
    s.emission = Spectrum(v * 0.1f);
    s.direct = Spectrum(v * 0.9f * share);
    s.indirect = Spectrum(v) - s.emission - s.direct;
    s.albedo = Spectrum::rgb(0.1f, 0.2f, 0.3f);
    s.normal = {0, 0, 1};
    s.depth = 4, s.coverage = 1;
    s.rays = {1, 2, 3};
    return s;
  }

  FilmSettings film_;
  int tile_;
};

}  // namespace etd
