// The fast way through the data of a binary PLY file, for the layouts that nearly all files have: elements of equal
// length, whose values are converted column by column so that types are asked once for many of them, and triangles.
#pragma once

#include <span>
#include <string_view>

#include "io/ply_body.h"

namespace etd {

constexpr size_t kPlyRows = 128;  // that are converted at once: they stay in the fastest cache

// The bytes of every element of this kind, 0 where they differ because it has a list.
size_t ply_row_bytes(const PlyElement& element);

// Fills in the wanted values of elements that have no list and stand one after the other at `data`.
void convert_ply_rows(const char* data, const PlyPlan& plan, bool swap_bytes, std::span<PlyScalars> rows);

// Takes faces from the front of `data` and adds them, as PlyBody::read_triangles() promises. Knows lists of 32-bit
// indices with a length of one byte, and scalars beside them.
uint64_t take_ply_triangles(std::string_view& data, const PlyPlan& plan, bool swap_bytes, uint64_t most,
                            uint64_t vertices, FaceList& faces);

}  // namespace etd
