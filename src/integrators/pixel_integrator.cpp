#include "integrators/pixel_integrator.h"

namespace etd {

namespace {

size_t tiles_along(int pixels, int tile) { return static_cast<size_t>((pixels + tile - 1) / tile); }

}  // namespace

size_t PixelIntegrator::work_items(const Pass&) const {
  return tiles_along(context_.crop.width(), context_.tile_size) *
         tiles_along(context_.crop.height(), context_.tile_size);
}

PixelSample PixelIntegrator::sample(int x, int y, uint32_t replicate, uint32_t index) const {
  Sampler sampler(context_.sampler, context_.seed);
  sampler.start(static_cast<uint64_t>(y) * static_cast<uint64_t>(context_.width) + static_cast<uint64_t>(x), replicate,
                index);
  return sample_pixel(x, y, sampler);
}

void PixelIntegrator::render(const Pass& pass, size_t item, Film& film, RayCounts& rays) const {
  const size_t across = tiles_along(context_.crop.width(), context_.tile_size);
  const int x0 = context_.crop.x0 + static_cast<int>(item % across) * context_.tile_size;
  const int y0 = context_.crop.y0 + static_cast<int>(item / across) * context_.tile_size;
  const int x1 = std::min(x0 + context_.tile_size, context_.crop.x1);
  const int y1 = std::min(y0 + context_.tile_size, context_.crop.y1);
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x)
      for (uint32_t replicate = 0; replicate < context_.replicates; ++replicate) {
        PixelSums sums;
        for (uint32_t index = pass.begin; index < pass.end; ++index) {
          PixelSample s = sample(x, y, replicate, index);
          film.settings().sensor.expose(s);
          sums.add(s);
          rays += s.rays;
        }
        film.add(x, y, replicate, sums);
      }
}

}  // namespace etd
