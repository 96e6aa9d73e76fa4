// Files that were compressed with gzip, as scene archives often hold them ("mesh.ply.gz", or just "mesh.ply").
#pragma once

#include "io/file.h"
#include "params/limits.h"

namespace etd {

// Whether these bytes begin like a gzip file (RFC 1952).
inline bool is_gzip(std::string_view bytes) { return bytes.substr(0, 2) == "\x1f\x8b"; }

// What a gzip file holds, all its members in a row, or why it cannot be had: it may be more than `limits` let it be.
FileBytes gunzip(std::string_view compressed, const Limits& limits = {});

// read_file(), and what is inside when it is a gzip file, whatever its name.
FileBytes read_file_uncompressed(const std::filesystem::path& path, const Limits& limits = {});

// The ending of a file's name in lower case, with its point: the one in front of ".gz" where there is that.
std::string uncompressed_ending(std::filesystem::path path);

}  // namespace etd
