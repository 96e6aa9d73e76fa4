#include "render/film_stream.h"

#include <fmt/format.h>

#include <new>
#include <system_error>

namespace etd {
namespace {

constexpr const char* kNoMemory = "there is no memory for a picture to be shown";

}  // namespace

FilmStream::FilmStream(Receiver receiver, Report report, std::chrono::milliseconds interval)
    : receiver_(std::move(receiver)), report_(std::move(report)), interval_(interval), next_(Clock::now() + interval) {
  try {
    worker_ = std::thread([this] { work(); });
  } catch (const std::system_error& error) {
    report_(fmt::format("the picture cannot be shown before it is complete, for want of a thread: {}",
                        error.code().message()));
  }
}

FilmStream::~FilmStream() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  if (worker_.joinable()) worker_.join();
}

bool FilmStream::wants_film() const {
  if (!worker_.joinable() || busy_.load(std::memory_order_relaxed)) return false;
  return (pass_done_ && !pass_shown_) || Clock::now() >= next_;
}

void FilmStream::on_film(const Film& film) {
  const Clock::time_point start = Clock::now();
  send(film);
  const Clock::time_point end = Clock::now();
  constexpr int kShareOfTime = 20;
  next_ = end + std::max(interval_, kShareOfTime * (end - start));
  pass_shown_ = pass_done_;
}

// A picture to look at is not worth the render.
void FilmStream::send(const Film& film) {
  try {
    LayeredImage picture = make_picture(film);
    const std::lock_guard lock(mutex_);
    if (failed_) return;
    picture_ = std::move(picture);
    busy_ = true;
  } catch (const std::bad_alloc&) {
    give_up(kNoMemory);
  }
  changed_.notify_all();
}

void FilmStream::give_up(const std::string& problem) {
  {
    const std::lock_guard lock(mutex_);
    if (failed_) return;
    failed_ = busy_ = true;
  }
  report_(problem);
}

void FilmStream::finish(const Film& film) {
  if (!worker_.joinable()) {
    std::string problem;
    try {
      problem = receive(make_picture(film));
    } catch (const std::bad_alloc&) {
      problem = kNoMemory;
    }
    if (!problem.empty()) report_(problem);
    return;
  }
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !busy_ || failed_; });
  }
  send(film);
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !busy_ || failed_; });
}

std::string FilmStream::receive(const LayeredImage& picture) const {
  try {
    return receiver_(picture);
  } catch (const std::exception& e) {
    return e.what();
  }
}

void FilmStream::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return picture_ || ending_; });
    if (!picture_) return;
    const LayeredImage picture = std::move(*picture_);
    picture_.reset();
    lock.unlock();
    const std::string problem = receive(picture);
    if (!problem.empty()) report_(problem);
    lock.lock();
    failed_ = !problem.empty();
    busy_ = failed_;
    changed_.notify_all();
    if (failed_) return;
  }
}

}  // namespace etd
