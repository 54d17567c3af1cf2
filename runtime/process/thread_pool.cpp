#include "runtime/process/thread_pool.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace floornav {

namespace {

/// Looks of a worker for news before it sleeps: about as long as waking up would take.
constexpr int kLooks = 2000;

/// Which worker of which pool this thread is.
thread_local const ThreadPool* own_pool = nullptr;
thread_local int own_worker = 0;

void pause_briefly() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#else
  std::atomic_signal_fence(std::memory_order_seq_cst);
#endif
}

template <class Condition>
bool comes_soon(Condition condition) {
  for (int look = 0; look < kLooks; ++look) {
    if (condition()) return true;
    pause_briefly();
  }
  return false;
}

}  // namespace

ThreadPool::ThreadPool(int workers) {
  if (workers < 1)
    throw std::invalid_argument("a pool needs 1 worker or more, not " + std::to_string(workers));
  runs_.reserve(2 * static_cast<std::size_t>(workers));
  threads_.reserve(static_cast<std::size_t>(workers - 1));
  for (int worker = 1; worker < workers; ++worker) threads_.emplace_back([this, worker] { serve(worker); });
}

ThreadPool::~ThreadPool() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    news_.fetch_add(1, std::memory_order_relaxed);
  }
  start_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void ThreadPool::run(int count, const std::function<void(int, int)>& piece) {
  Run run{piece, count};
  const int worker = own_pool == this ? own_worker : 0;
  const bool is_shared = count > 1 && !threads_.empty();
  if (is_shared) {
    {
      const std::lock_guard lock(mutex_);
      runs_.push_back(&run);
      news_.fetch_add(1, std::memory_order_relaxed);
    }
    start_.notify_all();
  }
  work(run, worker);
  if (is_shared) wait_for_helpers(run);
  if (run.exception) std::rethrow_exception(run.exception);
}

void ThreadPool::wait_for_helpers(Run& run) {
  const auto are_done = [&] { return run.helpers.load(std::memory_order_acquire) == 0; };
  comes_soon(are_done);
  std::unique_lock lock(mutex_);
  done_.wait(lock, are_done);
  runs_.erase(std::find(runs_.begin(), runs_.end(), &run));
}

void ThreadPool::serve(int worker) {
  own_pool = this;
  own_worker = worker;
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    Run* const run = newest_with_more();
    if (run == nullptr) {
      wait_for_news(lock);
      continue;
    }
    run->helpers.fetch_add(1, std::memory_order_relaxed);
    lock.unlock();
    work(*run, worker);
    lock.lock();
    if (run->helpers.fetch_sub(1, std::memory_order_release) == 1) done_.notify_all();
  }
}

ThreadPool::Run* ThreadPool::newest_with_more() {
  const auto newest = std::find_if(runs_.rbegin(), runs_.rend(), [](const Run* r) { return r->has_more(); });
  return newest == runs_.rend() ? nullptr : *newest;
}

void ThreadPool::wait_for_news(std::unique_lock<std::mutex>& lock) {
  const std::uint64_t known = news_.load(std::memory_order_relaxed);
  const auto is_news = [&] { return news_.load(std::memory_order_relaxed) != known; };
  lock.unlock();
  comes_soon(is_news);
  lock.lock();
  start_.wait(lock, is_news);
}

void ThreadPool::work(Run& run, int worker) {
  for (int index = run.next.fetch_add(1, std::memory_order_relaxed); index < run.count;
       index = run.next.fetch_add(1, std::memory_order_relaxed)) {
    try {
      run.piece(index, worker);
    } catch (...) {
      keep_exception(run, index);
    }
  }
}

void ThreadPool::keep_exception(Run& run, int index) {
  const std::lock_guard lock(mutex_);
  if (run.exception && run.exception_index < index) return;
  run.exception = std::current_exception();
  run.exception_index = index;
}

}  // namespace floornav
