#include <atomic>
#include <cstdio>
#include <exception>
#include <stdexcept>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "runtime/process/stop_signals.hpp"
#include "tools/calibrate/calibrate.hpp"
#include "tools/command_line/one_line_error.hpp"
#include "tools/progress/progress.hpp"

namespace {

using namespace floornav;

constexpr const char* kExample = R"(
Every pair must show the whole board to both eyes, and the pairs together the whole image and several distances and
tilts; ten or more are good. The report gives the error of each pair: take those that stand out away and run again. In
the pictures each corner must lie on the same line at the left and at the right.

Example:
  floornav-calibrate --left left/*.png --right right/*.png --corners 9x6 --square 0.025 -o camera.yaml --pictures check/
  floornav-import stereo left right -o boards.lcm --calibration camera.yaml --height 1 --pitch 0 --roll 0)";

Chessboard board_of(const std::string& corners, double square_m) {
  Chessboard board;
  char rest = 0;
  if (std::sscanf(corners.c_str(), "%dx%d%c", &board.columns, &board.rows, &rest) != 2 || board.columns < 3 ||
      board.rows < 3 || board.columns > 100 || board.rows > 100)
    throw std::runtime_error(
        fmt::format("--corners \"{}\" is not COLUMNSxROWS of inner corners, each 3 .. 100", corners));
  board.square_m = square_m;
  return board;
}

int run_program(int argc, char** argv) {
  CLI::App app("Calibrates a stereo camera from pairs of images of a chessboard");
  app.name("floornav-calibrate");
  CalibrationTask task;
  std::string corners = "9x6";
  double square_m = 0;
  app.add_option("--left", task.left, "The left images")->required()->check(CLI::ExistingFile);
  app.add_option("--right", task.right, "The right images, in the same order")
      ->required()
      ->check(CLI::ExistingFile);
  app.add_option("--corners", corners, "Inner corners of the board a row and a column")
      ->capture_default_str();
  app.add_option("--square", square_m, "Side of a square, m")->required()->check(CLI::Range(0.001, 1.0));
  app.add_option("-o,--output", task.result, "The calibration to write, OpenCV's YAML")->required();
  app.add_option("--pictures", task.pictures, "Folder for the rectified pairs");
  tell_errors_in_one_line(app);
  app.footer(kExample);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  }
  task.board = board_of(corners, square_m);
  const std::atomic<bool>& stop_asked = stop_on_signals();
  std::vector<std::string> report;
  {
    Progress progress("pairs");
    report = calibrate_from_files(task, [&](std::int64_t done, std::int64_t total) {
      if (stop_asked) throw std::runtime_error("interrupted, nothing written");
      progress.at(done, total);
    });
  }
  for (const std::string& line : report) fmt::print("{}\n", line);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run_program(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "floornav-calibrate: {}\n", error.what());
    return 1;
  }
}
