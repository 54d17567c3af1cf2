#include "tools/simulator/truth_file.hpp"

#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

namespace floornav {
namespace {

void write_file(const std::filesystem::path& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw std::runtime_error(path.string() + ": cannot be written");
}

std::string state_text(const PlanarState& state) {
  return fmt::format("{{position_m: [{:.6f}, {:.6f}], ahead: [{:.6f}, {:.6f}]}}", state.position_m.x(),
                     state.position_m.y(), state.ahead.x(), state.ahead.y());
}

std::string header(const Scene& scene, const RobotSettings& robot, const DriveSettings& settings,
                   const DriveSummary& drive, const TruthGrid& truth, const std::string& csv) {
  std::string text = fmt::format("scene: \"{}\"\nseed: {}\nseconds: {:.3f}\nframes: {}\nposes: {}\n",
                                 scene.name, settings.seed, drive.seconds, drive.frames, drive.poses);
  text += "start: " + state_text(drive.start) + "\nend: " + state_text(drive.end) + "\n";
  if (scene.goal_m) text += fmt::format("goal_m: [{}, {}]\n", scene.goal_m->x(), scene.goal_m->y());
  text += fmt::format("robot: {{height_m: {}, max_step_m: {}, max_slope_deg: {}}}\n", robot.height_m,
                      robot.max_step_m, robot.max_slope_deg);
  text += fmt::format("cells: {{file: \"{}\", resolution_m: {}, origin: [{}, {}], size: [{}, {}]}}\n", csv,
                      truth.lattice.pitch_m, truth.origin.ix, truth.origin.iy, truth.width, truth.height);
  return text;
}

std::string table(const TruthGrid& truth) {
  std::string text = "ix,iy,height_m,highest_m,drivable\n";
  for (std::int32_t j = 0; j < truth.height; ++j) {
    for (std::int32_t i = 0; i < truth.width; ++i) {
      const TruthCell& cell = truth.cells[static_cast<std::size_t>(j * truth.width + i)];
      text += fmt::format("{},{},{:.4f},{:.4f},{}\n", truth.origin.ix + i, truth.origin.iy + j, cell.height_m,
                          cell.highest_m, cell.drivable ? 1 : 0);
    }
  }
  return text;
}

}  // namespace

void write_truth(const std::filesystem::path& log, const Scene& scene, const RobotSettings& robot,
                 const DriveSettings& settings, const DriveSummary& drive, const TruthGrid& truth) {
  const std::string csv = log.filename().string() + ".truth.csv";
  write_file(log.string() + ".truth.yaml", header(scene, robot, settings, drive, truth, csv));
  write_file(log.string() + ".truth.csv", table(truth));
}

}  // namespace floornav
