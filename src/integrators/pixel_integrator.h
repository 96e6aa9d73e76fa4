// The common part of integrators that estimate each pixel from paths that start at the camera: a work item is a tile,
// a pixel's samples are summed in registers and reach the film once per pass.
#pragma once

#include "core/bounds.h"
#include "integrators/pixel_tiles.h"

namespace etd {

class PixelIntegrator : public Integrator {
 public:
  explicit PixelIntegrator(const IntegratorContext& context) : context_(context), tiles_(context) {}

  size_t work_items(const Pass& pass, uint32_t phase) const override;
  void render(const Pass& pass, uint32_t phase, size_t item, Sink& sink) override;

  // One sample of one pixel (full-image coordinates), of index `index` in replicate `replicate`: any sample of an image
  // can be drawn alone.
  PixelSample sample(int x, int y, uint32_t replicate, uint32_t index) const;
  bool replay(const SampleId& id, PathRecord& record) const override;

 protected:
  // Sampler dimension 0 is the next to draw.
  virtual PixelSample sample_pixel(int x, int y, Sampler& sampler) const = 0;
  // The same, telling about the path. Without an implementation of its own nothing is told beside the sample.
  virtual PixelSample record_pixel(int x, int y, Sampler& sampler, PathRecord&) const {
    return sample_pixel(x, y, sampler);
  }

 private:
  Sampler start(int x, int y, uint32_t replicate, uint32_t index) const;

  IntegratorContext context_;
  PixelTiles tiles_;
};

}  // namespace etd
