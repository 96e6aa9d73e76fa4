// Headers of images that ask for more memory than their files can be worth. A few bytes may name a size of terabytes,
// and libraries believe them: some before they tell the size to anybody.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "params/limits.h"

namespace etd {

// Each returns why the image must not be read, or an empty string.

// Judges a file before a library sees it: EXR, GIF and JPEG files, whose libraries take memory when they open them.
// What is no such file, or a broken one, is for the library to report.
std::string image_header_problem(const std::filesystem::path& path, const Limits& limits);

// Judges the size that a header states by the size of its file.
std::string image_size_problem(uint64_t width, uint64_t height, uint64_t bytes_per_pixel, uint64_t file_bytes,
                               const Limits& limits);

}  // namespace etd
