#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "runtime/geometry/parallel.hpp"

namespace floornav {

/// A fixed number of workers; the caller of run() is worker 0. run() allocates nothing. One run at a time:
/// neither two threads nor a piece may call run() while another one is going on.
class ThreadPool final : public Parallel {
 public:
  /// 1 worker: no thread is started. Throws std::invalid_argument for less than 1.
  explicit ThreadPool(int workers);
  ~ThreadPool() override;
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  [[nodiscard]] int workers() const override { return static_cast<int>(threads_.size()) + 1; }

  /// Every piece is called even where one throws; of several exceptions the one of the lowest index is
  /// thrown.
  void run(int count, const std::function<void(int index, int worker)>& piece) override;

 private:
  void serve(int worker);
  void work(int worker);
  void keep_exception(int index);

  std::mutex mutex_;
  std::condition_variable start_;
  std::condition_variable done_;
  bool stopping_ = false;
  std::uint64_t runs_ = 0;  ///< counts calls of run(), so that a thread takes part in each at most once
  int active_ = 0;          ///< threads that are working on the current run
  const std::function<void(int, int)>* piece_ = nullptr;  ///< null between runs
  int count_ = 0;
  std::atomic<int> next_{0};  ///< next index that nobody has taken
  std::exception_ptr exception_;
  int exception_index_ = 0;
  std::vector<std::thread> threads_;
};

}  // namespace floornav
