#include <cstdio>
#include <exception>

#include <CLI/CLI.hpp>

#include "tools/simulate/closed_loop_command.hpp"
#include "tools/simulate/drive_command.hpp"

int main(int argc, char** argv) {
  CLI::App app(
      "Renders scenes as a Kinect or a Bumblebee would see them, with their errors and the truth beside",
      "floornav-simulate");
  app.require_subcommand(1);
  try {
    floornav::add_drive_command(app);
    floornav::add_closed_loop_command(app);
    CLI11_PARSE(app, argc, argv);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "floornav-simulate: %s\n", e.what());
    return 1;
  }
  return 0;
}
