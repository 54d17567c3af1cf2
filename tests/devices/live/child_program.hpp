#pragma once

#include <atomic>
#include <string>
#include <vector>

#include <sys/types.h>

namespace floornav {

/// A variable that a program is started with.
struct EnvironmentVariable {
  std::string name;
  std::string value;
};

/// Starts a program, found as by a shell.
pid_t start_program(const std::vector<std::string>& command, const std::vector<EnvironmentVariable>& more);

/// Its exit code; asks it to end when `stop` is set or the time is over (0: never).
int wait_for_program(pid_t child, double seconds, const std::atomic<bool>& stop);

}  // namespace floornav
