#include "render/workers.h"

#include <algorithm>
#include <atomic>
#include <new>
#include <system_error>
#include <utility>

namespace etd {
namespace {

std::atomic<bool> g_refused{false};

// Starts this many threads, or as many as the system gives.
void start_threads(std::vector<std::thread>& threads, int count, const std::function<void()>& body) {
  try {
    threads.reserve(static_cast<size_t>(std::max(count, 0)));
    for (int i = 0; i < count; ++i) threads.emplace_back(body);
  } catch (const std::system_error&) {
    g_refused = true;
  } catch (const std::bad_alloc&) {
    g_refused = true;
  }
}

}  // namespace

int thread_count(int requested) {
  return requested > 0 ? requested : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

Workers::Workers(int threads) {
  start_threads(threads_, thread_count(threads) - 1, [this] { serve(); });
}

Workers::~Workers() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  begun_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void Workers::call(const std::function<void()>& work) {
  try {
    work();
  } catch (...) {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = std::current_exception();
  }
}

void Workers::serve() {
  std::unique_lock lock(mutex_);
  for (uint64_t seen = 0;;) {
    begun_.wait(lock, [&] { return ending_ || round_ != seen; });
    if (ending_) return;
    seen = round_;
    const std::function<void()>& work = *work_;
    lock.unlock();
    call(work);
    lock.lock();
    if (--running_ == 0) done_.notify_one();
  }
}

void Workers::run(const std::function<void()>& work) {
  {
    const std::lock_guard lock(mutex_);
    work_ = &work;
    running_ = threads_.size();
    ++round_;
  }
  begun_.notify_all();
  call(work);
  std::unique_lock lock(mutex_);
  done_.wait(lock, [this] { return running_ == 0; });
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

bool threads_were_refused() { return g_refused; }

bool can_have_threads(int count) {
  std::vector<std::thread> threads;
  std::mutex gate;
  {
    const std::lock_guard closed(gate);
    start_threads(threads, count, [&gate] { const std::lock_guard passing(gate); });
  }
  for (std::thread& thread : threads) thread.join();
  return static_cast<int>(threads.size()) >= count;
}

}  // namespace etd
