#include "tools/bench/stereo_command.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/utility.hpp>

#include "drivers/bumblebee/stereo_pipeline.hpp"
#include "tools/bench/cpu_clock.hpp"
#include "tools/bench/stereo_scenes.hpp"
#include "tools/simulator/sensor_spec.hpp"

namespace floornav {
namespace {

struct Options {
  int scenes = 3;
  int repeats = 3;
  std::uint64_t seed = 1;
  bool full = false;
  bool json = false;
};

/// A camera of the table.
struct Contest {
  const char* camera;
  StereoRigSpec rig;
  StereoSettings settings;
};

std::vector<Contest> contests() {
  StereoRigSpec narrow = bumblebee_xb3_rig();
  narrow.eyes_m = {0.0, 0.12};
  return {{"Bumblebee2 640x480", bumblebee2_rig(), {}},
          {"XB3 narrow 1280x960", narrow, {}},
          {"XB3 wide 1280x960", bumblebee_xb3_rig(), {}}};
}

/// One row of the table.
struct Result {
  std::string camera;
  std::string matcher;
  double cpu_ms = 0;  ///< of rectification and matching, median
  StereoQuality quality;
  double locking_px = 0;
};

/// Finds the disparities of a scene, and the rows in which it looked for them.
class Contestant {
 public:
  virtual ~Contestant() = default;
  virtual void run(const StereoScene& scene) = 0;
  [[nodiscard]] virtual cv::Mat1f disparity() const = 0;
};

class Ours final : public Contestant {
 public:
  Ours(const StereoSettings& settings, const Rectification& rectification)
      : pipeline_(settings, rectification,
                  search_of(MatchedRegion{}, rectification.camera(), rectification.baseline_m(),
                            mounted(0.0, 0.0, 0.72, 20.0), settings.nearest_m)) {}
  void run(const StereoScene& scene) override {
    pipeline_.match(scene.raw_left, scene.raw_right, serial_, image_);
  }
  [[nodiscard]] cv::Mat1f disparity() const override {
    cv::Mat1f found(image_.height, image_.width);
    for (std::size_t i = 0; i < image_.pixels.size(); ++i)
      found.ptr<float>()[i] = static_cast<float>(image_.pixels[i]) * DisparityImage::kUnit_px;
    return found;
  }
  [[nodiscard]] cv::Range rows() const { return pipeline_.rows(); }

 private:
  StereoPipeline pipeline_;
  Serial serial_;
  DisparityImage image_;
};

/// OpenCV's calls as its manual has them, over the whole images, for the same nearest distance.
class Plain final : public Contestant {
 public:
  Plain(const StereoSettings& settings, const Rectification& rectification) : rectification_(rectification) {
    const double most_px =
        static_cast<double>(rectification.camera().fx) * rectification.baseline_m() / settings.nearest_m;
    const int count = 16 * static_cast<int>(most_px / 16 + 1);
    if (settings.matcher == "block")
      matcher_ = cv::StereoBM::create(count, 15);
    else
      matcher_ =
          cv::StereoSGBM::create(0, count, 5, 200, 800, 1, 31, 10, 100, 2, cv::StereoSGBM::MODE_SGBM_3WAY);
  }
  void run(const StereoScene& scene) override {
    rectification_.apply(scene.raw_left, scene.raw_right, left_, right_);
    matcher_->compute(left_, right_, found_);
  }
  [[nodiscard]] cv::Mat1f disparity() const override {
    cv::Mat1f found;
    found_.convertTo(found, CV_32F, 1.0 / 16);
    return cv::Mat1f(cv::max(found, 0.0F));
  }

 private:
  Rectification rectification_;
  cv::Ptr<cv::StereoMatcher> matcher_;
  cv::Mat left_, right_, found_;
};

Result measure(const Contest& contest, const std::string& name, Contestant& contestant, cv::Range rows,
               const std::vector<StereoScene>& scenes, int repeats) {
  Result result;
  result.camera = contest.camera;
  result.matcher = name;
  std::vector<double> ms;
  for (const StereoScene& scene : scenes) {
    for (int i = 0; i < repeats; ++i) {
      const double began = thread_cpu_ms();
      contestant.run(scene);
      ms.push_back(thread_cpu_ms() - began);
    }
    const cv::Mat1f found = contestant.disparity();
    result.quality.add(scene, found, rows);
    result.locking_px = std::max(result.locking_px, locking_px(scene, found));
  }
  result.cpu_ms = quantile_of(ms, 0.5);
  return result;
}

void compete(const Contest& contest, const Options& options, std::vector<Result>& results) {
  StereoRig rig(contest.rig, options.seed);
  const std::vector<StereoScene> scenes = stereo_scenes(rig, options.scenes, options.seed);
  const cv::Size size(contest.rig.ideal.width, contest.rig.ideal.height);
  const Rectification rectification = rectification_of(rig.calibration(), size, false, 1);
  for (const char* matcher : {"auto", "half", "quarter", "block", "sgbm"}) {
    if (!options.full && std::string(matcher) != contest.settings.matcher) continue;
    StereoSettings settings = contest.settings;
    settings.matcher = matcher;
    Ours ours(settings, rectification);
    results.push_back(
        measure(contest, fmt::format("floornav {}", matcher), ours, ours.rows(), scenes, options.repeats));
  }
  for (const char* matcher : {"block", "sgbm"}) {
    StereoSettings settings = contest.settings;
    settings.matcher = matcher;
    Plain plain(settings, rectification);
    const cv::Range rows = Ours(contest.settings, rectification).rows();
    const char* name = std::string(matcher) == "block" ? "OpenCV StereoBM 15" : "OpenCV SGBM 3WAY 5";
    results.push_back(measure(contest, name, plain, rows, scenes, 1));
  }
}

double share(std::int64_t part, std::int64_t all) {
  return all > 0 ? static_cast<double>(part) / static_cast<double>(all) : 0.0;
}

double rms_px(const StereoQuality& quality) {
  return std::sqrt(quality.squares_px2 /
                   static_cast<double>(std::max<std::int64_t>(1, quality.valid - quality.bad)));
}

void print(const std::vector<Result>& results, bool json) {
  if (json) {
    nlohmann::json rows = nlohmann::json::array();
    for (const Result& r : results)
      rows.push_back({{"camera", r.camera},
                      {"matcher", r.matcher},
                      {"cpu_ms", r.cpu_ms},
                      {"floor_valid", share(r.quality.floor_valid, r.quality.floor)},
                      {"bad", share(r.quality.bad, r.quality.valid)},
                      {"rms_px", rms_px(r.quality)},
                      {"locking_px", r.locking_px}});
    fmt::print("{}\n", nlohmann::json{{"rows", rows}}.dump());
    return;
  }
  fmt::print("{:<21}{:<20}{:>14}{:>20}{:>14}{:>9}{:>12}\n", "camera", "rectify + match", "CPU ms a pair",
             "valid floor < 3 m", "> 1 px off", "rms px", "locking px");
  for (const Result& r : results)
    fmt::print("{:<21}{:<20}{:>14.1f}{:>18.2f} %{:>12.2f} %{:>9.3f}{:>12.3f}\n", r.camera, r.matcher,
               r.cpu_ms, 100 * share(r.quality.floor_valid, r.quality.floor),
               100 * share(r.quality.bad, r.quality.valid), rms_px(r.quality), r.locking_px);
}

void run(const Options& options) {
  cv::setNumThreads(1);
  std::vector<Result> results;
  for (const Contest& contest : contests()) compete(contest, options, results);
  print(results, options.json);
}

}  // namespace

void add_stereo_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "stereo", "Rectifying and matching rendered pairs of a textured floor, beside OpenCV's plain calls");
  const auto o = std::make_shared<Options>();
  command->add_option("--scenes", o->scenes, "Pairs")->check(CLI::Range(1, 1000))->capture_default_str();
  command->add_option("--repeats", o->repeats, "Of each, for the time")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--seed", o->seed, "Of scenes and noise")->capture_default_str();
  command->add_flag("--full", o->full, "The other matchers too");
  command->add_flag("--json", o->json, "Print one line of JSON");
  command->callback([o] { run(*o); });
}

}  // namespace floornav
