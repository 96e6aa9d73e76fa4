#include "integrators/pixel_integrator.h"

#include "core/flush_to_zero.h"
#include "integrators/path_record.h"

namespace etd {

namespace {

size_t tiles_along(int pixels, int tile) { return static_cast<size_t>((pixels + tile - 1) / tile); }

}  // namespace

size_t PixelIntegrator::work_items(const Pass&, uint32_t) const {
  return tiles_along(context_.crop.width(), context_.tile_size) *
         tiles_along(context_.crop.height(), context_.tile_size);
}

Sampler PixelIntegrator::start(int x, int y, uint32_t replicate, uint32_t index) const {
  Sampler sampler(context_.sampler, context_.seed);
  sampler.start(static_cast<uint64_t>(y) * static_cast<uint64_t>(context_.width) + static_cast<uint64_t>(x), replicate,
                index);
  return sampler;
}

PixelSample PixelIntegrator::sample(int x, int y, uint32_t replicate, uint32_t index) const {
  Sampler sampler = start(x, y, replicate, index);
  return sample_pixel(x, y, sampler);
}

bool PixelIntegrator::replay(const SampleId& id, PathRecord& record) const {
  const FlushToZero as_in_a_render;
  record = {};
  record.id = id;
  record.replicate = id.number % context_.replicates;
  record.index = id.number / context_.replicates;
  Sampler sampler = start(id.x, id.y, record.replicate, record.index);
  record.sample = record_pixel(id.x, id.y, sampler, record);
  return true;
}

void PixelIntegrator::render(const Pass& pass, uint32_t, size_t item, Sink& sink) {
  const size_t across = tiles_along(context_.crop.width(), context_.tile_size);
  const int x0 = context_.crop.x0 + static_cast<int>(item % across) * context_.tile_size;
  const int y0 = context_.crop.y0 + static_cast<int>(item / across) * context_.tile_size;
  const int x1 = std::min(x0 + context_.tile_size, context_.crop.x1);
  const int y1 = std::min(y0 + context_.tile_size, context_.crop.y1);
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) {
      Sink::Pixel pixel(sink, x, y);
      const auto [begin, end] = pass.samples(x, y);
      for (uint32_t replicate = pass.first_replicate; replicate < pass.end_replicate; ++replicate)
        for (uint32_t index = begin; index < end; ++index) pixel.add(replicate, index, sample(x, y, replicate, index));
    }
}

}  // namespace etd
