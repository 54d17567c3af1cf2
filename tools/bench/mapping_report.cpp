#include "tools/bench/mapping_report.hpp"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tools/bench/sensor_names.hpp"

namespace floornav {
namespace {

constexpr double kFuseGoal_ms = 2.0;
constexpr double kSlowerGoal = 1.2;
constexpr double kBytesGoal_per_m2 = 8000;
constexpr double kBlockedGoal = 0.01;
constexpr double kFreeGoal = 0.001;
constexpr double kHeightGoal_cm = 0.3;
constexpr double kTrailGoal = 0.01;
constexpr int kFramesGoal = 3;
constexpr double kFarErrorGoal = 0.5;  // of one frame's
constexpr double kStepHeight_m = 0.01;
constexpr double kStepDistance_m = 4.0;
constexpr double kStepsGoal = 0.9;
constexpr double kAlarmsGoal_per_m2 = 0.01;

double share(std::int64_t part, std::int64_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}
double rms_cm(double square_m2, std::int64_t count) {
  return count > 0 ? 100.0 * std::sqrt(square_m2 / static_cast<double>(count)) : 0.0;
}

const char* verdict(bool holds) {
  return holds ? "holds" : "short of it";
}

void print_costs(const MappingFigures& f) {
  fmt::print("fuse a frame's {:.0f} cells   {:.2f} ms median, {:.2f} p99 (goal {}: {})\n", f.fuse.cells,
             f.fuse.fuse_median_ms, f.fuse.fuse_p99_ms, kFuseGoal_ms,
             verdict(f.fuse.fuse_median_ms <= kFuseGoal_ms));
  fmt::print("judge what changed         {:.2f} ms median, {:.2f} p99\n", f.fuse.refresh_median_ms,
             f.fuse.refresh_p99_ms);
  fmt::print(
      "terrain map on the wire    {:.1f} bytes a m2 at 0.2 m, {:.1f} at 0.1 m (2 bytes a cell: 50 and 200)\n",
      f.fuse.terrain_bytes_per_m2, f.fuse.fine_terrain_bytes_per_m2);
  for (const MapSizeCost& size : f.sizes)
    fmt::print(
        "map of {:7.0f} m2          {:.2f} ms an update (mean {:.2f}), {:.0f} bytes a m2 (goal {}: {})\n",
        size.area_m2, size.update_median_ms, size.update_mean_ms, size.bytes_per_m2, kBytesGoal_per_m2,
        verdict(size.bytes_per_m2 <= kBytesGoal_per_m2));
  if (f.sizes.size() < 2) return;
  const double slower = f.sizes.back().update_mean_ms / f.sizes.front().update_mean_ms;
  fmt::print("largest against smallest   {:.2f} times the update's mean time (goal {}: {})\n", slower,
             kSlowerGoal, verdict(slower <= kSlowerGoal));
}

void print_accuracy(const MapAccuracyOptions& options, const MapAccuracy& a) {
  fmt::print("\n{} random worlds, {} frames, jitter {:.0f} mm and {:.1f} deg, cells within 3 m\n",
             options.worlds, options.frames, 1e3 * options.pose_noise.position_m,
             options.pose_noise.angle_deg);
  const double blocked = share(a.drivable_blocked, a.drivable);
  const double free = share(a.undrivable_free, a.undrivable);
  fmt::print(
      "drivable cells blocked     {:.2f} % of {} (goal {} %: {}); more than a cell from what is not drivable "
      "{:.2f} %\n",
      100 * blocked, a.drivable, 100 * kBlockedGoal, verdict(blocked <= kBlockedGoal),
      100 * share(a.drivable_inside_blocked, a.drivable_inside));
  fmt::print(
      "undrivable cells free      {:.2f} % of {} (goal {} %: {}); more than a cell from what is drivable "
      "{:.2f} %\n",
      100 * free, a.undrivable, 100 * kFreeGoal, verdict(free <= kFreeGoal),
      100 * share(a.undrivable_inside_free, a.undrivable_inside));
  fmt::print(
      "with a step on the border  {:.1f} % of {} free, their edges over it closed; with them {:.2f} %\n",
      100 * share(a.beside_step_free, a.beside_step), a.beside_step,
      100 * share(a.undrivable_free + a.beside_step_free, a.undrivable + a.beside_step));
  fmt::print("never seen                 {:.1f} % of the view\n", 100 * share(a.unseen, a.in_view));
  const double height_cm = rms_cm(a.square_m2, a.heights);
  fmt::print(
      "height RMS                 {:.2f} cm (goal {}: {}); the mean of the told poses errs by {:.2f} cm "
      "there, what "
      "the map adds to it {:.2f} cm\n",
      height_cm, kHeightGoal_cm, verdict(height_cm <= kHeightGoal_cm), rms_cm(a.pose_square_m2, a.heights),
      rms_cm(a.shape_square_m2, a.heights));
}

void print_change(const MapChangeOptions& options, const MapChange& c) {
  fmt::print("\n{} walks of a person through the view, then a box put down; the worst\n", options.walks);
  fmt::print("floor blocked 1 s after    {:.2f} % (mean {:.2f}; goal {} %: {})\n", 100 * c.trail,
             100 * c.trail_mean, 100 * kTrailGoal, verdict(c.trail <= kTrailGoal));
  fmt::print("a new box is in the map    after {} frames (goal {}: {})\n", c.frames_until_blocked,
             kFramesGoal, verdict(c.frames_until_blocked <= kFramesGoal));
  fmt::print("a standing box' cells lost {:.1f} %\n", 100 * c.eroded);
}

void print_gain(const HeightGainOptions& options, const std::array<HeightGain, 2>& gains) {
  fmt::print(
      "\n{} courses of Table 1, {}, 4 x 3 sections, ten frames at 0.2 m/s against the last one alone\n",
      options.configurations, name_of(options.sensor));
  for (std::size_t noise = 0; noise < gains.size(); ++noise) {
    const HeightErrors one = gains[noise].one_frame.far.all();
    const HeightErrors ten = gains[noise].ten_frames.far.all();
    const double ratio = ten.mean_cm() / one.mean_cm();
    fmt::print(
        "{:<12}3..5.5 m      {:.2f} cm of {:.2f}: {:.2f} (goal {}: {}); < 3 m {:.2f} of {:.2f}; missed {} "
        "and {} "
        "of {}\n",
        noise_name(noise == 1), ten.mean_cm(), one.mean_cm(), ratio, kFarErrorGoal,
        verdict(ratio <= kFarErrorGoal), gains[noise].ten_frames.near.all().mean_cm(),
        gains[noise].one_frame.near.all().mean_cm(), ten.missed, one.missed, one.count);
  }
}

bool is_asked_for(const StepRow& row) {
  return row.frames > 1 && row.height_m == kStepHeight_m && row.distance_m == kStepDistance_m;
}

void print_steps(const std::vector<StepRow>& rows) {
  fmt::print("\nsteps after ten frames at 0.2 m/s\n");
  for (const StepRow& row : rows) {
    if (!is_asked_for(row)) continue;
    const double found = static_cast<double>(row.found) / row.poses;
    fmt::print(
        "{:<12}1 cm at 4 m   {:.1f} % of {} (goal {} %: {}); false alarms {:.2f} in 100 m2 (goal 1: {})\n",
        noise_name(row.correlated), 100 * found, row.poses, 100 * kStepsGoal, verdict(found >= kStepsGoal),
        100 * row.false_per_m2, verdict(row.false_per_m2 < kAlarmsGoal_per_m2));
  }
}

nlohmann::json json_of(const HeightGain& gain) {
  return {{"one_frame_far_cm", gain.one_frame.far.all().mean_cm()},
          {"ten_frames_far_cm", gain.ten_frames.far.all().mean_cm()}};
}

}  // namespace

nlohmann::json json_of(const MappingFigures& f) {
  nlohmann::json sizes = nlohmann::json::array();
  for (const MapSizeCost& size : f.sizes)
    sizes.push_back({{"area_m2", size.area_m2},
                     {"update_median_ms", size.update_median_ms},
                     {"update_mean_ms", size.update_mean_ms},
                     {"bytes_per_m2", size.bytes_per_m2}});
  nlohmann::json steps = nlohmann::json::array();
  for (const StepRow& row : f.steps)
    if (is_asked_for(row))
      steps.push_back({{"noise", noise_name(row.correlated)},
                       {"found", static_cast<double>(row.found) / row.poses},
                       {"false_per_m2", row.false_per_m2}});
  const MapAccuracy& a = f.accuracy;
  return {{"fuse_median_ms", f.fuse.fuse_median_ms},
          {"fuse_p99_ms", f.fuse.fuse_p99_ms},
          {"refresh_median_ms", f.fuse.refresh_median_ms},
          {"terrain_bytes_per_m2", f.fuse.terrain_bytes_per_m2},
          {"sizes", sizes},
          {"drivable_blocked", share(a.drivable_blocked, a.drivable)},
          {"drivable_inside_blocked", share(a.drivable_inside_blocked, a.drivable_inside)},
          {"undrivable_free", share(a.undrivable_free, a.undrivable)},
          {"undrivable_inside_free", share(a.undrivable_inside_free, a.undrivable_inside)},
          {"unseen", share(a.unseen, a.in_view)},
          {"trail", f.change.trail},
          {"frames_until_blocked", f.change.frames_until_blocked},
          {"eroded", f.change.eroded},
          {"heights_independent", json_of(f.gain[0])},
          {"heights_correlated", json_of(f.gain[1])},
          {"steps", steps},
          {"pose_height_rms_cm", rms_cm(a.pose_square_m2, a.heights)},
          {"beside_step_free", share(a.beside_step_free, a.beside_step)},
          {"height_rms_cm", rms_cm(a.square_m2, a.heights)},
          {"height_shape_rms_cm", rms_cm(a.shape_square_m2, a.heights)}};
}

void print(const MappingFigures& f) {
  print_costs(f);
  if (f.accuracy.in_view > 0) print_accuracy(f.accuracy_options, f.accuracy);
  if (f.change_options.walks > 0) print_change(f.change_options, f.change);
  if (f.gain_options.configurations > 0) print_gain(f.gain_options, f.gain);
  if (!f.steps.empty()) print_steps(f.steps);
}

}  // namespace floornav
