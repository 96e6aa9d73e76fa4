#include "io/file.h"

#include <cerrno>
#include <cstring>
#include <fstream>

#include <fmt/format.h>

#include "io/pending_file.h"

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

std::string write_file(const fs::path& path, std::string_view bytes) {
  PendingFile pending(path);
  pending.write(bytes.data(), bytes.size());
  const std::string problem = pending.commit();
  return problem.empty() ? problem : fmt::format("cannot write {}: {}", path.string(), problem);
}

std::string in_quotes(std::string_view text) {
  constexpr size_t kLongest = 40;
  std::string shown = "\"";
  for (const char c : text.substr(0, kLongest)) shown += (c >= ' ' && c <= '~') ? c : '?';
  return shown + (text.size() > kLongest ? "...\"" : "\"");
}

}  // namespace etd
