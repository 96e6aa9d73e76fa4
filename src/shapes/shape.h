// The family of shapes as scenes name them: each turns its parameters into a mesh, bilinear patches or a quadric.
#pragma once

#include <filesystem>
#include <optional>
#include <span>

#include "params/declaration.h"
#include "shapes/mesh_shapes.h"
#include "shapes/shape_geometry.h"

namespace etd {

std::span<const ModelDecl* const> shape_models();
// Makes the shape of a checked use; problems are reported, and nothing comes back when there are any. `folder` is where
// relative file names start, `files` what has been read of them.
std::optional<ShapeGeometry> make_shape(const ModelUse& use, const std::filesystem::path& folder, MeshFiles& files,
                                        Diagnostics& diagnostics);

}  // namespace etd
