#include "integrators/pixel_integrator.h"

#include "core/flush_to_zero.h"
#include "integrators/path_record.h"

namespace etd {

size_t PixelIntegrator::work_items(const Pass&, uint32_t) const { return tiles_.count(); }

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
  const PixelBounds tile = tiles_.tile(item);
  for (int y = tile.y0; y < tile.y1; ++y)
    for (int x = tile.x0; x < tile.x1; ++x) {
      Sink::Pixel pixel(sink, x, y);
      const auto [begin, end] = pass.samples(x, y);
      for (uint32_t replicate = pass.first_replicate; replicate < pass.end_replicate; ++replicate)
        for (uint32_t index = begin; index < end; ++index) pixel.add(replicate, index, sample(x, y, replicate, index));
    }
}

}  // namespace etd
