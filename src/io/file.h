// Whole files in and out of memory.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace etd {

// The bytes of a file, or why it could not be read (one line, without the file's name).
struct FileBytes {
  std::string bytes;
  std::string error;
};
FileBytes read_file(const std::filesystem::path& path);

// Creates or replaces a file as a whole. Returns what went wrong ("cannot write NAME: ..."), or an empty string.
std::string write_file(const std::filesystem::path& path, std::string_view bytes);

// A piece of a file as it may be shown in a message: in quotes, cut to 40 bytes, unprintable bytes as '?'.
std::string in_quotes(std::string_view text);

}  // namespace etd
