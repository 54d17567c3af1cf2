#include "tools/bench/figure_command.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tools/bench/figures.hpp"

namespace floornav {
namespace {

struct FigureOptions {
  int number = 1;
  std::string folder = ".";
  std::string scene = "tools/simulator/scenes/furnished_room.yaml";
};

void run(const FigureOptions& options) {
  std::filesystem::create_directories(options.folder);
  std::vector<std::filesystem::path> files;
  if (options.number == 1) files = draw_figure_1(options.folder);
  if (options.number == 2) files = draw_figure_2(options.folder);
  if (options.number == 7) files = draw_figure_7(options.scene, options.folder);
  for (const auto& file : files) fmt::print("{}\n", file.string());
}

}  // namespace

void add_figure_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "figure",
      "The paper's figure 1 (test bed and grid-maps), 2 (error against distance) or 7 (terrain map)");
  const auto o = std::make_shared<FigureOptions>();
  command->add_option("number", o->number, "1, 2 or 7")->required()->check(CLI::IsMember({1, 2, 7}));
  command->add_option("--out", o->folder, "Folder for the pictures")->capture_default_str();
  command->add_option("--scene", o->scene, "What is driven through for figure 7")->capture_default_str();
  command->callback([o] { run(*o); });
}

}  // namespace floornav
