// Turns a film into files: the layers of the image, what is known about it, and the formats.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "film/film.h"
#include "io/image_write.h"
#include "render/driver.h"
#include "render/settings.h"

namespace etd {

using Metadata = std::vector<std::pair<std::string, MetadataValue>>;

// The film as float layers: R, G, B; direct.*, indirect.*, emission.* (radiance); with features albedo.R..B,
// normal.X..Z, depth.Z (metres), coverage.A, and of a gbuffer position.X..Z; stderr.R, .G, .B, .Y. The picture is
// (emission + direct) + indirect of the float layers, so that this sum holds bit for bit in the file. With alpha,
// foreground.R, .G, .B, .A: the light that comes from surfaces, and the share of the samples that met one, by which it
// is multiplied already; with ids, id.object and id.material.
// `replicate_layers` adds replicate0.R, .G, .B, replicate1.R ...: the picture as each replicate sees it, whose mean is
// the picture. The film must outlive the rows.
RowImage layer_rows(const Film& film, bool replicate_layers = false);
// What such an image has, without the film.
ImageHeader layers_header(const FilmSettings& settings, bool replicate_layers);
// The same in memory.
LayeredImage make_layers(const Film& film, bool replicate_layers = false);

// The picture alone: the layers R, G and B of make_layers().
LayeredImage make_picture(const Film& film);

// Everything needed to make the same image again and to judge it, under names that start with "etendue:": version,
// scene, integrator and all its parameters, sampler, seed, replicates, spp, sizes, rays by kind, seconds, limits, what
// is biased ("nothing" when nothing is), whether that falls to 0 with more samples, the share of pixels without a
// sample if there are any, invalid samples ("none" when there are none) and what stopped it.
Metadata make_metadata(const std::filesystem::path& scene, const RenderSettings& settings, const std::string& bias,
                       const RenderResult& result);

// "2 NaN, 1 infinite", or "none".
std::string invalid_text(const InvalidSamples& invalid);

// Writes one file in the format of its ending: all layers, or the picture alone (`exposure` in stops, for formats of
// limited range), with its alpha if that is wanted and the film has kept it. Returns what went wrong ("cannot write
// NAME: ..."), or an empty string.
std::string write_output(const std::filesystem::path& path, const RowImage& image, double exposure, bool alpha = false);
std::string write_output(const std::filesystem::path& path, const LayeredImage& image, double exposure,
                         bool alpha = false);

}  // namespace etd
