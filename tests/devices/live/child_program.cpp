#include "tests/devices/live/child_program.hpp"

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <utility>

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace floornav {

pid_t start_program(const std::vector<std::string>& command, const std::vector<EnvironmentVariable>& more) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);  // no daemon is left behind by a watch that has crashed
  for (const EnvironmentVariable& variable : more) ::setenv(variable.name.c_str(), variable.value.c_str(), 1);
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  ::execvp(arguments.front(), arguments.data());
  std::perror(arguments.front());
  std::_Exit(127);
}

int wait_for_program(pid_t child, double seconds, const std::atomic<bool>& stop) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  bool asked = false;
  int status = 0;
  while (::waitpid(child, &status, WNOHANG) == 0) {
    const bool over = stop || (seconds > 0 && std::chrono::steady_clock::now() > end);
    if (over && !std::exchange(asked, true)) ::kill(child, SIGTERM);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace floornav
