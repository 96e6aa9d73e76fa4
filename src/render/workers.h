// Threads that work on one thing together: as many as were asked for, or as can be had.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace etd {

// 0 means all cores.
int thread_count(int requested);

class Workers {
 public:
  // Where the system refuses threads, those that there are do the work: threads_were_refused() tells.
  explicit Workers(int threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  // Counts the thread that calls run(), too, so at least one.
  int count() const { return static_cast<int>(threads_.size()) + 1; }
  // Calls work() on each of them at once and waits for all. The first exception passes through.
  void run(const std::function<void()>& work);

 private:
  void serve();
  void call(const std::function<void()>& work);

  std::vector<std::thread> threads_;
  std::mutex mutex_;
  std::condition_variable begun_, done_;
  const std::function<void()>* work_ = nullptr;
  uint64_t round_ = 0;  // that work_ belongs to
  size_t running_ = 0;  // threads that have not finished it
  bool ending_ = false;
  std::exception_ptr failure_;
};

// Whether the system has refused this process a thread so far.
bool threads_were_refused();
// Whether this many threads can be had at once, beside those that there are.
bool can_have_threads(int count);

}  // namespace etd
