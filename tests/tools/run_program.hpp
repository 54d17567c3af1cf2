#pragma once

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include <sys/wait.h>

#include "tests/tools/temporary_folder.hpp"

namespace floornav {

/// What a program did.
struct Outcome {
  int exit_code = -1;  ///< -1: it ended by a signal
  std::string out;
  std::string err;
  [[nodiscard]] auto lines_of_err() const { return std::ranges::count(err, '\n'); }
};

/// Runs one of the project's programs, e.g. {"floornav-import", "tum", "folder"}.
inline Outcome run_program(const std::vector<std::string>& words) {
  const TemporaryFolder folder;
  std::string command = std::string(FLOORNAV_PROGRAMS) + "/" + words.front();
  for (std::size_t i = 1; i < words.size(); ++i) {
    command += " '";
    for (const char c : words[i]) command += c == '\'' ? std::string("'\\''") : std::string(1, c);
    command += "'";
  }
  command += " >" + (folder / "out").string() + " 2>" + (folder / "err").string();
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, file_content(folder / "out"),
          file_content(folder / "err")};
}

}  // namespace floornav
