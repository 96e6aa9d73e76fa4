// Lets somebody watch the image while it is made: every few seconds the picture is copied out of the film while nothing
// renders, and given to a receiver (a file, a viewer) on a thread of its own, so that a slow one costs no time.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "render/driver.h"
#include "render/output.h"

namespace etd {

class FilmStream : public RenderObserver {
 public:
  // Takes the picture; returns what went wrong, or an empty string. After a failure it is not called again.
  using Receiver = std::function<std::string(const LayeredImage& picture)>;
  // Told once, on another thread, when the receiver fails or there is no memory for a picture.
  using Report = std::function<void(const std::string& problem)>;

  // The first picture is sent when the first pass is done or `interval` has passed, and the next one `interval` after
  // that or later: when the receiver is still busy, or copying takes more than a twentieth of the time. Where no thread
  // can be had, the receiver gets the final image alone.
  FilmStream(Receiver receiver, Report report, std::chrono::milliseconds interval);
  // Waits for the receiver.
  ~FilmStream() override;

  void on_pass_end(const RenderProgress&) override { pass_done_ = true; }
  bool wants_film() const override;
  void on_film(const Film& film) override;
  // Sends the final image, after what is under way, and waits until it has been received.
  void finish(const Film& film);

 private:
  using Clock = std::chrono::steady_clock;
  void work();
  std::string receive(const LayeredImage& picture) const;
  void send(const Film& film);
  void give_up(const std::string& problem);

  const Receiver receiver_;
  const Report report_;
  const Clock::duration interval_;
  // Written between items only.
  Clock::time_point next_;
  bool pass_done_ = false, pass_shown_ = false;

  std::atomic<bool> busy_{false};  // a picture is waiting or being received, or the receiver has failed
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<LayeredImage> picture_;
  bool failed_ = false, ending_ = false;
  std::thread worker_;
};

// Passes everything on to several observers.
class ObserverList : public RenderObserver {
 public:
  void add(RenderObserver& observer) { observers_.push_back(&observer); }

  void on_progress(const RenderProgress& progress) override {
    for (RenderObserver* o : observers_) o->on_progress(progress);
  }
  void on_pass_end(const RenderProgress& progress) override {
    for (RenderObserver* o : observers_) o->on_pass_end(progress);
  }
  bool wants_film() const override {
    return std::any_of(observers_.begin(), observers_.end(), [](const RenderObserver* o) { return o->wants_film(); });
  }
  // Only to those who want it.
  void on_film(const Film& film) override {
    for (RenderObserver* o : observers_)
      if (o->wants_film()) o->on_film(film);
  }

 private:
  std::vector<RenderObserver*> observers_;
};

}  // namespace etd
