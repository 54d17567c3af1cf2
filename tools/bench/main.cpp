#include <cstdio>
#include <exception>

#include <CLI/CLI.hpp>

#include "tools/bench/driver_command.hpp"
#include "tools/bench/figure_command.hpp"
#include "tools/bench/mapping_command.hpp"
#include "tools/bench/outliers_command.hpp"
#include "tools/bench/perception_command.hpp"
#include "tools/bench/planner_command.hpp"
#include "tools/bench/stereo_command.hpp"
#include "tools/bench/table1_command.hpp"

int main(int argc, char** argv) {
  CLI::App app("Measures the claims of floornav", "floornav-bench");
  app.require_subcommand(1);
  try {
    floornav::add_driver_command(app);
    floornav::add_figure_command(app);
    floornav::add_mapping_command(app);
    floornav::add_outliers_command(app);
    floornav::add_perception_command(app);
    floornav::add_planner_command(app);
    floornav::add_stereo_command(app);
    floornav::add_table1_command(app);
    CLI11_PARSE(app, argc, argv);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "floornav-bench: %s\n", e.what());
    return 1;
  }
  return 0;
}
