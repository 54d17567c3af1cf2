#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace floornav {

/// Tells on stderr how far a program is, once it has taken longer than two seconds: one line that is
/// rewritten on a terminal, a line every five seconds elsewhere.
class Progress {
 public:
  /// `what` is being counted, e.g. "images".
  explicit Progress(std::string what);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void at(std::int64_t done, std::int64_t total);

 private:
  using Clock = std::chrono::steady_clock;
  std::string what_;
  bool on_terminal_;
  bool shown_ = false;
  Clock::time_point start_;
  Clock::time_point next_;
};

}  // namespace floornav
