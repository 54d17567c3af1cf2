#include "tools/bench/table1_command.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "runtime/process/thread_pool.hpp"
#include "tools/bench/sensor_names.hpp"
#include "tools/bench/step_course.hpp"
#include "tools/bench/steps.hpp"
#include "tools/bench/table1.hpp"
#include "tools/bench/trade_offs.hpp"
#include "tools/progress/progress.hpp"

namespace floornav {
namespace {

double floor_rms_cm(const Table1Row& row) {
  return row.floor_vertices > 0 ? 100.0 * std::sqrt(row.floor_square_m2 / row.floor_vertices) : 0.0;
}

const char* noise_of(const Table1Row& row) {
  return row.matched ? "matched" : noise_name(row.correlated);
}

/// What is asked of matched pairs: twice the goals of simulated disparities, of level tops, in the paper's
/// usual sections.
void print_matched_goal(const std::vector<Table1Row>& rows) {
  constexpr double kNearGoal_cm = 0.16;
  constexpr double kFarGoal_cm = 0.80;
  for (const Table1Row& row : rows)
    if (row.matched && row.x_res == 4 && row.y_res == 3 && !row.error_growth)
      fmt::print("matched pairs, 4 x 3, level tops: {:.2f} / {:.2f} cm, goals {:.2f} / {:.2f}\n",
                 row.near.flat.mean_cm(), row.far.flat.mean_cm(), kNearGoal_cm, kFarGoal_cm);
}

/// Mean of all beside the paper's; of level and of sloped tops; the worst.
std::string text_of(const TopErrors& errors, double paper_cm) {
  const HeightErrors all = errors.all();
  return fmt::format("{:5.2f} [{:4.2f}] {:5.2f} {:5.2f} {:6.1f} ", all.mean_cm(), paper_cm,
                     errors.flat.mean_cm(), errors.sloped.mean_cm(), 100.0 * all.worst_m);
}

void print_text(const std::vector<Table1Row>& rows) {
  fmt::print(
      "Height error of obstacles in cm, one frame: mean of all [the paper's], of level tops, of sloped tops, "
      "worst. Last row: sections after eq. (5)\n");
  fmt::print("{:<10}{:<13}{:<6}| {:<33}| {:<33}| {:<8}| floor RMS\n", "sensor", "noise", "x, y", "< 3 m",
             "3 .. 5.5 m", "missed");
  for (const Table1Row& row : rows) {
    const PaperRow paper = paper_row(row.sensor, row.x_res, row.y_res);
    fmt::print("{:<10}{:<13}{:2}, {:<2}| {}| {}| {:>2}/{:<5}| {:.2f}{}\n", name_of(row.sensor), noise_of(row),
               row.x_res, row.y_res, text_of(row.near, paper.near_cm), text_of(row.far, paper.far_cm),
               row.near.all().missed + row.far.all().missed, row.near.all().count + row.far.all().count,
               floor_rms_cm(row), row.error_growth ? " (5)" : "");
  }
  print_matched_goal(rows);
}

nlohmann::json json_of(const TopErrors& errors, double paper_cm) {
  const HeightErrors all = errors.all();
  return {{"mean_cm", all.mean_cm()},
          {"paper_cm", paper_cm},
          {"flat_cm", errors.flat.mean_cm()},
          {"sloped_cm", errors.sloped.mean_cm()},
          {"worst_cm", 100.0 * all.worst_m},
          {"missed", all.missed},
          {"count", all.count}};
}

nlohmann::json json_of(const Table1Row& row) {
  const PaperRow paper = paper_row(row.sensor, row.x_res, row.y_res);
  return {{"sensor", name_of(row.sensor)},
          {"x_res", row.x_res},
          {"y_res", row.y_res},
          {"sections", row.error_growth ? "error_growth" : "uniform"},
          {"noise", noise_of(row)},
          {"near", json_of(row.near, paper.near_cm)},
          {"far", json_of(row.far, paper.far_cm)},
          {"floor_rms_cm", floor_rms_cm(row)}};
}

void print_steps(const std::vector<StepRow>& rows) {
  fmt::print("\nSteps found, % of poses, by distance\n{:<10}{:<13}{:>7}{:>6} |", "sensor", "noise", "frames",
             "cm");
  for (const double distance_m : kStepDistances_m) fmt::print("{:>6.1f} m", distance_m);
  fmt::print(" | false per m2\n");
  for (std::size_t i = 0; i < rows.size(); i += kStepDistances_m.size()) {
    const StepRow& row = rows[i];
    fmt::print("{:<10}{:<13}{:>7}{:>6.0f} |", name_of(row.sensor), noise_name(row.correlated), row.frames,
               100.0 * row.height_m);
    for (std::size_t k = 0; k < kStepDistances_m.size(); ++k)
      fmt::print("{:>8.0f}", 100.0 * rows[i + k].found / rows[i + k].poses);
    fmt::print(" | {:.3f}\n", row.false_per_m2);
  }
}

nlohmann::json json_of(const StepRow& row) {
  return {{"sensor", name_of(row.sensor)},
          {"noise", noise_name(row.correlated)},
          {"height_cm", 100.0 * row.height_m},
          {"distance_m", row.distance_m},
          {"frames", row.frames},
          {"poses", row.poses},
          {"found", static_cast<double>(row.found) / row.poses},
          {"false_per_m2", row.false_per_m2}};
}

void print_trade_offs(const std::vector<TradeOff>& trade_offs) {
  fmt::print(
      "\nThe four knobs, Kinect, one frame (mean error in cm, missed of "
      "all)\n{:<20}{:<26}{:>8}{:>8}{:>9}{:>8}\n",
      "knob", "setting", "< 3 m", "3..5.5", "missed", "ms");
  for (const TradeOff& t : trade_offs) {
    const HeightErrors near = t.errors.near.all();
    const HeightErrors far = t.errors.far.all();
    fmt::print("{:<20}{:<26}{:>8.2f}{:>8.2f}{:>5}/{:<4}{:>7.1f}\n", t.knob, t.setting, near.mean_cm(),
               far.mean_cm(), near.missed + far.missed, near.count + far.count, t.perception_ms);
  }
}

void print_claims(const MethodClaims& claims) {
  fmt::print("\nThe dominant plane of a frame\n");
  for (const SearchCost& search : claims.searches)
    fmt::print("{:<28}{:>7.0f} hypotheses {:>7.2f} ms\n", search.way, search.hypotheses, search.ms);
  fmt::print("points on planes: {:.1f} % with unlimited recursion, {:.1f} % by default\n",
             100.0 * claims.share_on_planes, 100.0 * claims.share_by_default);
  fmt::print("bytes a frame: {:.0f} as x, y, z floats, {:.0f} as depth_cloud_t, {:.0f} as surfels_t\n",
             claims.float_bytes, claims.cloud_bytes, claims.surfel_bytes);
}

nlohmann::json json_of(const TradeOff& t) {
  return {{"knob", t.knob},
          {"setting", t.setting},
          {"near_cm", t.errors.near.all().mean_cm()},
          {"far_cm", t.errors.far.all().mean_cm()},
          {"missed", t.errors.near.all().missed + t.errors.far.all().missed},
          {"ms", t.perception_ms}};
}

nlohmann::json json_of(const MethodClaims& claims) {
  nlohmann::json searches = nlohmann::json::array();
  for (const SearchCost& search : claims.searches)
    searches.push_back({{"way", search.way}, {"hypotheses", search.hypotheses}, {"ms", search.ms}});
  return {{"searches", searches},
          {"share_on_planes", claims.share_on_planes},
          {"share_on_planes_by_default", claims.share_by_default},
          {"float_bytes", claims.float_bytes},
          {"cloud_bytes", claims.cloud_bytes},
          {"surfel_bytes", claims.surfel_bytes}};
}

struct CommandOptions {
  std::string sensor = "both";
  bool full = false;
  int threads = 2;
  int trade_off_configurations = 4;
  Table1Options table;
  StepOptions steps;
  bool json = false;
};

constexpr int kFullPoses = 200;
constexpr std::uint64_t kPrintedSeed = 1001;

void settle(CommandOptions& options) {
  if (options.sensor == "kinect") options.table.sensors = {SensorKind::kKinect};
  if (options.sensor == "bumblebee") options.table.sensors = {SensorKind::kBumblebee};
  options.steps.sensors = options.table.sensors;
  options.steps.seed = options.table.seed;
  if (options.full) options.steps.poses = kFullPoses;
  if (options.full) options.steps.plain_m2 = std::max(options.steps.plain_m2, 1000.0);
}

void run(CommandOptions& options) {
  settle(options);
  ThreadPool pool(options.threads);
  const auto progress = [](const std::string& line) { fmt::print(stderr, "{}\n", line); };
  std::vector<Table1Row> rows;
  std::vector<StepRow> steps;
  if (options.table.configurations > 0) rows = measure_table1(options.table, pool, progress);
  if (options.steps.poses > 0) {
    Progress drives("drives over steps");
    steps = measure_steps(options.steps, pool, [&](int done, int all) { drives.at(done, all); });
  }
  std::vector<TradeOff> trade_offs;
  MethodClaims claims;
  if (options.trade_off_configurations > 0) {
    trade_offs = measure_trade_offs(options.trade_off_configurations, options.table.seed, progress);
    claims = measure_claims(options.trade_off_configurations, options.table.seed);
  }
  if (!options.json) {
    fmt::print("seed {}\n", options.table.seed);
    if (!rows.empty()) print_text(rows);
    if (!steps.empty()) print_steps(steps);
    if (!trade_offs.empty()) print_trade_offs(trade_offs);
    if (!trade_offs.empty()) print_claims(claims);
    return;
  }
  nlohmann::json result{{"rows", nlohmann::json::array()}, {"steps", nlohmann::json::array()}};
  for (const Table1Row& row : rows) result["rows"].push_back(json_of(row));
  for (const StepRow& row : steps) result["steps"].push_back(json_of(row));
  for (const TradeOff& t : trade_offs) result["trade_offs"].push_back(json_of(t));
  if (!trade_offs.empty()) result["claims"] = json_of(claims);
  result["seed"] = options.table.seed;
  fmt::print("{}\n", result.dump());
}

}  // namespace

void add_table1_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "table1", "Heights of simulated obstacles against the truth, as the paper's Table 1");
  const auto o = std::make_shared<CommandOptions>();
  o->steps.poses = 10;
  o->steps.plain_m2 = 200;
  o->table.seed = kPrintedSeed;
  command->add_option("--sensor", o->sensor)
      ->check(CLI::IsMember({"kinect", "bumblebee", "both"}))
      ->capture_default_str();
  command
      ->add_option("--configurations", o->table.configurations, "Obstacle configurations a row; 0: no table")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  command->add_flag("--matched", o->table.matched,
                    "The Bumblebee's rows from rendered pairs of images through the matcher, too");
  command
      ->add_option("--step-poses", o->steps.poses,
                   "Random poses for each height of step; 0: no steps. One drive of ten frames shows an edge "
                   "at each of the six distances; its last frame alone is the single frame; both noises "
                   "disturb the same depths")
      ->check(CLI::Range(0, 100000))
      ->capture_default_str();
  command
      ->add_option("--plain-m2", o->steps.plain_m2,
                   "Level and gently sloped floor without steps, for false alarms, with the same settings")
      ->check(CLI::Range(1.0, 1e6))
      ->capture_default_str();
  command
      ->add_option("--trade-off-configurations", o->trade_off_configurations,
                   "Configurations for the paper's four knobs and other claims; 0: not these")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  command->add_flag("--full", o->full, "200 poses a step and 1000 m2 of plain floor: half an hour and more");
  command
      ->add_option("--seed", o->table.seed,
                   "Of the configurations, poses and noise. The printed tables are of 1001; what is tuned is "
                   "tuned on seeds below 1000")
      ->capture_default_str();
  command->add_option("--threads", o->threads)->check(CLI::Range(1, 256))->capture_default_str();
  command->add_flag("--json", o->json, "For programs");
  command->callback([o] { run(*o); });
}

}  // namespace floornav
