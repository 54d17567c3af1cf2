#include "runtime/process/thread_pool.hpp"

#include <stdexcept>
#include <string>
#include <utility>

namespace floornav {

ThreadPool::ThreadPool(int workers) {
  if (workers < 1)
    throw std::invalid_argument("a pool needs 1 worker or more, not " + std::to_string(workers));
  threads_.reserve(static_cast<std::size_t>(workers - 1));
  for (int worker = 1; worker < workers; ++worker) threads_.emplace_back([this, worker] { serve(worker); });
}

ThreadPool::~ThreadPool() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  start_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void ThreadPool::run(int count, const std::function<void(int, int)>& piece) {
  {
    const std::lock_guard lock(mutex_);
    piece_ = &piece;
    count_ = count;
    next_.store(0, std::memory_order_relaxed);
    ++runs_;
  }
  if (count > 1) start_.notify_all();
  work(0);
  std::unique_lock lock(mutex_);
  done_.wait(lock, [this] { return active_ == 0; });
  piece_ = nullptr;
  if (exception_) std::rethrow_exception(std::exchange(exception_, nullptr));
}

void ThreadPool::serve(int worker) {
  std::uint64_t seen = 0;
  std::unique_lock lock(mutex_);
  while (true) {
    start_.wait(lock, [&] { return stopping_ || (runs_ != seen && piece_ != nullptr); });
    if (stopping_) return;
    seen = runs_;
    ++active_;
    lock.unlock();
    work(worker);
    lock.lock();
    if (--active_ == 0) done_.notify_one();
  }
}

void ThreadPool::work(int worker) {
  for (int index = next_.fetch_add(1, std::memory_order_relaxed); index < count_;
       index = next_.fetch_add(1, std::memory_order_relaxed)) {
    try {
      (*piece_)(index, worker);
    } catch (...) {
      keep_exception(index);
    }
  }
}

void ThreadPool::keep_exception(int index) {
  const std::lock_guard lock(mutex_);
  if (exception_ && exception_index_ < index) return;
  exception_ = std::current_exception();
  exception_index_ = index;
}

}  // namespace floornav
