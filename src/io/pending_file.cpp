#include "io/pending_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "core/hash.h"

namespace etd {
namespace {

namespace fs = std::filesystem;

// The pending files of this process, where a signal handler finds them: it may not wait for a lock or free memory.
// Whoever moves a slot out of kFull owns its path. What finds no slot is removed at the next write of its output.
struct Slot {
  enum State : int { kFree, kFilling, kFull, kRemoving };
  std::atomic<int> state{kFree};
  char path[PATH_MAX] = {};
};
std::array<Slot, 32> g_slots;
static_assert(std::atomic<int>::is_always_lock_free);

int take_slot(const std::string& path) {
  if (path.size() >= PATH_MAX) return -1;
  for (size_t i = 0; i < g_slots.size(); ++i) {
    int expected = Slot::kFree;
    if (!g_slots[i].state.compare_exchange_strong(expected, Slot::kFilling)) continue;
    std::memcpy(g_slots[i].path, path.c_str(), path.size() + 1);
    g_slots[i].state = Slot::kFull;
    return static_cast<int>(i);
  }
  return -1;
}

void give_slot_back(int slot) {
  int expected = Slot::kFull;
  if (slot >= 0) g_slots[static_cast<size_t>(slot)].state.compare_exchange_strong(expected, Slot::kFree);
}

// What all hidden names of one output begin with. File systems limit names to 255 bytes or fewer: a long one becomes
// its hash.
std::string hidden_stem(const fs::path& final_path) {
  constexpr size_t kLongest = 100;
  const std::string name = final_path.filename().string();
  if (name.size() <= kLongest) return "." + name + ".";
  uint64_t hash = name.size();
  for (const char c : name) hash = hash_combine(hash, static_cast<unsigned char>(c));
  return fmt::format(".{:016x}.", hash);
}

constexpr std::string_view kEnding = ".part";

// A file without an owner that locks it was left by a process that has ended.
bool is_abandoned(const fs::path& part) {
  const int descriptor = ::open(part.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (descriptor < 0) return false;
  struct stat status = {};
  const bool abandoned =
      ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) && ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
  ::close(descriptor);
  return abandoned;
}

void remove_abandoned(const fs::path& folder, const std::string& stem) {
  std::error_code ignored;
  for (fs::directory_iterator at(folder.empty() ? "." : folder, ignored), end; at != end; at.increment(ignored)) {
    const std::string name = at->path().filename().string();
    if (name.size() <= stem.size() + kEnding.size() || name.compare(0, stem.size(), stem) != 0) continue;
    const std::string_view rest = std::string_view(name).substr(stem.size());
    const size_t digits = rest.find_first_not_of("0123456789-");
    if (digits == 0 || digits == std::string_view::npos || rest.substr(digits) != kEnding) continue;
    if (is_abandoned(at->path())) fs::remove(at->path(), ignored);
    if (ignored) return;
  }
}

}  // namespace

fs::path follow_links(const fs::path& path) {
  constexpr int kMostLinks = 40;  // as in the kernel; a loop of links is then found when the file is created
  fs::path place = path;
  for (int i = 0; i < kMostLinks; ++i) {
    std::error_code failed;
    const fs::path target = fs::read_symlink(place, failed);
    if (failed) break;
    place = place.parent_path() / target;  // `target` alone if it is absolute
  }
  return place;
}

PendingFile::PendingFile(const fs::path& final_path) : final_path_(follow_links(final_path)) {
  struct stat status = {};
  if (::stat(final_path_.c_str(), &status) != 0) {
    // A name that is too long for the final file is not for the hidden one.
    if (errno == ENAMETOOLONG || errno == ELOOP) {
      fail(errno);
      return;
    }
  } else if (!S_ISREG(status.st_mode)) {
    error_ = fmt::format("{} is not a file that can be replaced", final_path_.string());
    return;
  }
  constexpr int kAttempts = 1000;
  const fs::path folder = final_path_.parent_path();
  const std::string stem = hidden_stem(final_path_);
  remove_abandoned(folder, stem);
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    if (create(folder / fmt::format("{}{}-{}{}", stem, ::getpid(), attempt, kEnding))) return;
    if (errno != EEXIST) break;
  }
  error_ = fmt::format("cannot create a file in {}: {}", folder.empty() ? "the current folder" : folder.string(),
                       std::strerror(errno));
}

// False with errno, EEXIST when another process has the name. The slot is taken first: a signal may end the process as
// soon as the file exists.
bool PendingFile::create(const fs::path& candidate) {
  if (::access(candidate.c_str(), F_OK) == 0) return errno = EEXIST, false;
  slot_ = take_slot(candidate.string());
  if (open(candidate)) {
    path_ = candidate;
    return true;
  }
  const int why = errno;
  give_slot_back(std::exchange(slot_, -1));
  return errno = why, false;
}

// Creates and locks the file. False with errno.
bool PendingFile::open(const fs::path& candidate) {
  const int descriptor = ::open(candidate.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
  if (descriptor < 0) return false;
  // Before it was locked, another process may have taken it for abandoned. Some file systems have no locks: there
  // nobody takes it for that.
  struct stat status = {};
  if ((::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) || ::fstat(descriptor, &status) != 0 ||
      status.st_nlink == 0) {
    ::close(descriptor);
    return errno = EEXIST, false;
  }
  file_ = ::fdopen(descriptor, "wb");
  if (file_) return true;
  const int why = errno;
  ::close(descriptor);
  ::unlink(candidate.c_str());
  return errno = why, false;
}

PendingFile::~PendingFile() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove(path_, ignored);
  give_slot_back(slot_);
  if (file_) std::fclose(file_);
}

void PendingFile::fail(int error_number) {
  if (error_.empty()) error_ = std::strerror(error_number);
}

void PendingFile::write(const void* bytes, size_t size) {
  if (error_.empty() && std::fwrite(bytes, 1, size, file_) != size) fail(errno);
}

void PendingFile::seek(int64_t offset) {
  if (error_.empty() && ::fseeko(file_, offset, SEEK_SET) != 0) fail(errno);
}

std::string PendingFile::commit() {
  // The file stays open, and so locked, until it has its name. Network file systems tell of a full disk when a
  // descriptor is closed, which that of a copy does as well.
  if (file_ && std::fflush(file_) != 0) fail(errno);
  if (const int copy = file_ ? ::dup(::fileno(file_)) : -1; copy >= 0 && ::close(copy) != 0) fail(errno);
  if (!error_.empty()) return error_;
  std::error_code failed;
  fs::rename(path_, final_path_, failed);
  if (failed) return error_ = failed.message();
  path_.clear();
  return {};
}

std::string place_problem(const fs::path& path) {
  if (path.filename().empty()) return "it names no file";
  std::error_code ignored;
  const fs::path place = follow_links(path);
  const fs::path folder = place.has_parent_path() ? place.parent_path() : fs::path(".");
  if (!fs::exists(folder, ignored)) return fmt::format("the folder {} does not exist", folder.string());
  if (!fs::is_directory(folder, ignored)) return fmt::format("{} is not a folder", folder.string());
  if (fs::is_regular_file(place, ignored) && ::access(place.c_str(), W_OK) != 0)
    return fmt::format("{} is write-protected", place.string());
  return PendingFile(place).error();
}

void remove_pending_files() {
  for (Slot& slot : g_slots) {
    int expected = Slot::kFull;
    if (slot.state.compare_exchange_strong(expected, Slot::kRemoving)) ::unlink(slot.path);
  }
}

}  // namespace etd
