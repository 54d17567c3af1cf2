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

/// A fixed number of workers; the thread that calls run() from outside is worker 0, and only one may at a
/// time. run() allocates nothing.
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
  /// One call of run(), on its caller's stack.
  struct Run {
    const std::function<void(int, int)>& piece;
    int count = 0;
    std::atomic<int> next{0};     ///< next index that nobody has taken
    std::atomic<int> helpers{0};  ///< workers that take part besides the caller; changes under mutex_
    std::exception_ptr exception{};
    int exception_index = 0;

    [[nodiscard]] bool has_more() const { return next.load(std::memory_order_relaxed) < count; }
  };

  void serve(int worker);
  Run* newest_with_more();
  void work(Run& run, int worker);
  void keep_exception(Run& run, int index);
  void wait_for_helpers(Run& run);
  void wait_for_news(std::unique_lock<std::mutex>& lock);

  std::mutex mutex_;
  std::condition_variable start_;
  std::condition_variable done_;
  bool stopping_ = false;
  std::vector<Run*> runs_;              ///< going on, the newest last
  std::atomic<std::uint64_t> news_{0};  ///< counts calls of run()
  std::vector<std::thread> threads_;
};

}  // namespace floornav
