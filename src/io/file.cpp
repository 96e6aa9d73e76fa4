#include "io/file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include <fmt/format.h>

namespace etd {

namespace fs = std::filesystem;

FileBytes read_file(const fs::path& path) {
  FileBytes result;
  std::error_code failed;
  const fs::file_status status = fs::status(path, failed);
  if (status.type() == fs::file_type::not_found) return result.error = "the file does not exist", result;
  if (failed) return result.error = failed.message(), result;
  if (!fs::is_regular_file(status)) return result.error = "not a regular file", result;
  const auto size = fs::file_size(path, failed);
  if (failed) return result.error = failed.message(), result;
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) return result.error = fmt::format("cannot open the file: {}", std::strerror(errno)), result;
  result.bytes.resize(size);
  in.read(result.bytes.data(), static_cast<std::streamsize>(size));
  if (static_cast<std::uintmax_t>(in.gcount()) != size) {
    result.bytes.clear();
    result.error = "the file could not be read to its end";
  }
  return result;
}

PendingFile::PendingFile(const fs::path& final_path) : final_path_(final_path) {
  // A link stays a link: what it points to is replaced.
  std::error_code failed;
  if (fs::is_symlink(final_path, failed)) {
    const fs::path target = fs::weakly_canonical(final_path, failed);
    if (!failed) final_path_ = target;
  }
  constexpr int kAttempts = 1000;
  const fs::path folder = final_path_.parent_path();
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const fs::path candidate =
        folder / fmt::format(".{}.{}-{}.part", final_path_.filename().string(), ::getpid(), attempt);
    const int descriptor = ::open(candidate.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (descriptor >= 0) {
      ::close(descriptor);
      path_ = candidate;
      return;
    }
    if (errno != EEXIST) break;
  }
  error_ = fmt::format("cannot create a file in {}: {}", folder.empty() ? "the current folder" : folder.string(),
                       std::strerror(errno));
}

PendingFile::~PendingFile() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove(path_, ignored);
}

std::string PendingFile::commit() {
  if (path_.empty()) return error_;
  std::error_code failed;
  fs::rename(path_, final_path_, failed);
  if (failed) return fmt::format("cannot write {}: {}", final_path_.string(), failed.message());
  path_.clear();
  return {};
}

std::string write_file(const fs::path& path, std::string_view bytes) {
  PendingFile pending(path);
  if (!pending.error().empty()) return pending.error();
  errno = 0;
  std::ofstream out(pending.path(), std::ios::binary | std::ios::trunc);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) return fmt::format("cannot write {}: {}", path.string(), std::strerror(errno));
  return pending.commit();
}

std::string in_quotes(std::string_view text) {
  constexpr size_t kLongest = 40;
  std::string shown = "\"";
  for (const char c : text.substr(0, kLongest)) shown += (c >= ' ' && c <= '~') ? c : '?';
  return shown + (text.size() > kLongest ? "...\"" : "\"");
}

}  // namespace etd
