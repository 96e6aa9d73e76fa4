// Files of text, and of text in front of binary data (PLY), however a program marked their encoding.
#pragma once

#include "io/file.h"
#include "params/limits.h"

namespace etd {

// Removes the byte-order mark of UTF-8 in front of a text, which is no part of it. Returns what keeps the text from
// being read (it is in UTF-16 or UTF-32), or an empty string.
std::string strip_byte_order_mark(std::string& text);

// What is in a file, which may be compressed with gzip, without a byte-order mark.
FileBytes read_text_file(const std::filesystem::path& path, const Limits& limits = {});

}  // namespace etd
