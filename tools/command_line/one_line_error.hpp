#pragma once

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace floornav {

/// What is wrong with a command line is told in one line that begins with the program's name.
inline void tell_errors_in_one_line(CLI::App& app) {
  app.failure_message([](const CLI::App* program, const CLI::Error& error) {
    return fmt::format("{}: {} (see --help)\n", program->get_name(), error.what());
  });
}

}  // namespace floornav
