#include "tools/progress/progress.hpp"

#include <cstdio>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

namespace floornav {

Progress::Progress(std::string what)
    : what_(std::move(what)),
      on_terminal_(isatty(STDERR_FILENO) == 1),
      start_(Clock::now()),
      next_(start_ + std::chrono::seconds(2)) {}

Progress::~Progress() {
  if (shown_ && on_terminal_) std::fputc('\n', stderr);
}

void Progress::at(std::int64_t done, std::int64_t total) {
  const auto now = Clock::now();
  if (now < next_) return;
  next_ = now + (on_terminal_ ? std::chrono::milliseconds(200) : std::chrono::seconds(5));
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const std::string line = fmt::format("{} of {} {}, {:.0f} s", done, total, what_, seconds);
  fmt::print(stderr, "{}{:<60}{}", on_terminal_ ? "\r" : "", line, on_terminal_ ? "" : "\n");
  std::fflush(stderr);
  shown_ = true;
}

}  // namespace floornav
