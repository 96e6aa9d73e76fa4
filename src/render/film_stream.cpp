#include "render/film_stream.h"

namespace etd {

FilmStream::FilmStream(Receiver receiver, Report report, std::chrono::milliseconds interval)
    : receiver_(std::move(receiver)),
      report_(std::move(report)),
      interval_(interval),
      next_(Clock::now() + interval),
      worker_([this] { work(); }) {}

FilmStream::~FilmStream() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  worker_.join();
}

bool FilmStream::wants_film() const {
  if (busy_.load(std::memory_order_relaxed)) return false;
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

void FilmStream::send(const Film& film) {
  LayeredImage picture = make_picture(film);
  {
    const std::lock_guard lock(mutex_);
    if (failed_) return;
    picture_ = std::move(picture);
    busy_ = true;
  }
  changed_.notify_all();
}

void FilmStream::finish(const Film& film) {
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
