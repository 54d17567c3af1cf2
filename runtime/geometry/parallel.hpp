#pragma once

#include <functional>

namespace floornav {

/// Who runs independent pieces of work. A core is handed one and starts no thread itself.
class Parallel {
 public:
  virtual ~Parallel() = default;
  /// Number of workers; `worker` below is smaller, so that each can own its scratch memory.
  [[nodiscard]] virtual int workers() const = 0;
  /// Calls piece(index, worker) once for each index in [0, count), starting them in order; returns when all
  /// are done. An exception of a piece is thrown here after the others have ended. A piece may call run()
  /// itself: its own pieces are shared with workers that have nothing else to do, and meanwhile its worker
  /// does nothing but them.
  virtual void run(int count, const std::function<void(int index, int worker)>& piece) = 0;
};

/// One after the other, on the caller's thread.
class Serial final : public Parallel {
 public:
  [[nodiscard]] int workers() const override { return 1; }
  void run(int count, const std::function<void(int, int)>& piece) override {
    for (int index = 0; index < count; ++index) piece(index, 0);
  }
};

}  // namespace floornav
