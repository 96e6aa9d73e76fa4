// Whole files in and out: reading into memory, and writing so that nobody ever sees half a file.
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

// A file that is written beside its final place and takes its name only when it is complete. Destroyed before
// `commit()`, it leaves nothing behind and whatever stood at the final place untouched.
class PendingFile {
 public:
  // Chooses an unused hidden name in the folder of `final_path` and creates the empty file.
  explicit PendingFile(const std::filesystem::path& final_path);
  ~PendingFile();
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  // Where to write. Empty when the file could not be created: then error() says why.
  const std::filesystem::path& path() const { return path_; }
  const std::string& error() const { return error_; }
  // Renames into place, replacing what is there. Returns what went wrong, or an empty string.
  std::string commit();

 private:
  std::filesystem::path final_path_, path_;
  std::string error_;
};

// Creates or replaces a file as a whole. Returns what went wrong, or an empty string.
std::string write_file(const std::filesystem::path& path, std::string_view bytes);

// A piece of a file as it may be shown in a message: in quotes, cut to 40 bytes, unprintable bytes as '?'.
std::string in_quotes(std::string_view text);

}  // namespace etd
