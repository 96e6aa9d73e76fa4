// A file that takes its name only when it is complete, so that nobody ever sees half a file, whatever ends the program.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>

namespace etd {

// A file that is written beside its final place. Destroyed before `commit()`, it leaves nothing behind and whatever
// stood at the final place untouched. Links stay links: what they lead to is replaced, or made. What processes that
// were killed have left of the same output is removed.
class PendingFile {
 public:
  // Chooses an unused hidden name in the folder of `final_path` and creates the empty file.
  explicit PendingFile(const std::filesystem::path& final_path);
  ~PendingFile();
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  // Returns where the bytes go, for libraries that open files themselves. Empty when the file could not be created.
  const std::filesystem::path& path() const { return path_; }
  // Why the file could not be created, or what went wrong first while it was written; empty if nothing did.
  const std::string& error() const { return error_; }

  void write(const void* bytes, size_t size);
  // The next bytes go there, counted from the beginning of the file.
  void seek(int64_t offset);
  // Renames into place, replacing what is there. Returns error(), or what else went wrong, or an empty string.
  std::string commit();

 private:
  bool create(const std::filesystem::path& candidate);
  bool open(const std::filesystem::path& candidate);
  void fail(int error_number);

  std::filesystem::path final_path_, path_;
  std::FILE* file_ = nullptr;
  int slot_ = -1;  // in the list of remove_pending_files()
  std::string error_;
};

// Why no file can be written there: its name, its folder, what stands there. Leaves an existing file as it is and
// nothing new behind. Empty when one can.
std::string place_problem(const std::filesystem::path& path);

// Returns where a file goes that is written to this path: links are followed, also those that lead to nothing yet.
std::filesystem::path follow_links(const std::filesystem::path& path);

// Removes every pending file of this process, which must end afterwards. May be called by a signal handler.
void remove_pending_files();

}  // namespace etd
