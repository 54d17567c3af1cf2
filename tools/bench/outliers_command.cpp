#include "tools/bench/outliers_command.hpp"

#include <memory>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "perception/outliers.hpp"
#include "perception/roi_cloud.hpp"
#include "tools/bench/bench_scene.hpp"
#include "tools/bench/cpu_clock.hpp"
#ifdef FLOORNAV_PCL_PEER
#include "tools/bench/pcl_peer.hpp"
#endif
#include "tools/simulator/depth_sensor.hpp"

namespace floornav {
namespace {

struct OutliersOptions {
  std::string sensor = "kinect";
  int neighbors = 8;
  double epsilon = 1.0;
  SectionSettings sections;
  int repeats = 5;
  bool json = false;
};

/// The ROI's points of one simulated frame.
RoiCloud bench_cloud(const OutliersOptions& options, Pinhole& camera) {
  const bool is_kinect = options.sensor == "kinect";
  const SensorSpec spec = is_kinect ? kinect() : bumblebee();
  DepthSensor sensor(spec, 1);
  DepthFrame frame;
  frame.pixels = sensor.measure(bench_scene(), Pose::Identity(), 0);
  camera = frame.camera = spec.camera;
  frame.meaning = is_kinect ? PixelMeaning::kDepth : PixelMeaning::kDisparity;
  frame.scale = static_cast<float>(sensor.unit());
  frame.baseline_m = static_cast<float>(spec.baseline_m);
  frame.disparity_sigma_px = static_cast<float>(spec.noise.sigma_px);
  frame.T_body_sensor = spec.T_body_sensor;
  const RoiSettings roi;
  Serial serial;
  RoiCloud cloud;
  RoiClipper(roi, SectionGrid(roi, options.sections))
      .clip(frame, SensorView(frame, Pose::Identity()), serial, cloud);
  return cloud;
}

/// One search over all sections of a cloud.
class Contestant {
 public:
  Contestant(const OutliersOptions& options, const std::string& search)
      : remover_({options.neighbors, options.epsilon, search}) {}

  void run(const RoiCloud& cloud, const Pinhole& camera) {
    keep_.resize(cloud.size());
    Serial serial;
    const double began = thread_cpu_ms();
    for (int section = 0; section < static_cast<int>(cloud.section_end.size()); ++section) {
      const auto begin = static_cast<std::size_t>(cloud.section_begin(section));
      const auto size = static_cast<std::size_t>(cloud.section_size(section));
      const auto part = [&](const auto& values) { return std::span(values).subspan(begin, size); };
      remover_.remove({{part(cloud.x), part(cloud.y), part(cloud.z)}, part(cloud.pixel), camera}, serial,
                      std::span(keep_).subspan(begin, size));
    }
    times_ms_.push_back(thread_cpu_ms() - began);
  }
  [[nodiscard]] double median_ms() const { return quantile_of(times_ms_, 0.5); }
  [[nodiscard]] const std::vector<std::uint8_t>& keep() const { return keep_; }

 private:
  OutlierRemover remover_;
  std::vector<std::uint8_t> keep_;
  std::vector<double> times_ms_;
};

/// What PCL's filter takes, and how many points it decides otherwise; -1 where it is not built in.
struct PclResult {
  double ms = -1;
  std::size_t different = 0;
};

PclResult run_pcl([[maybe_unused]] const OutliersOptions& options, [[maybe_unused]] const RoiCloud& cloud,
                  [[maybe_unused]] const std::vector<std::uint8_t>& ours) {
  PclResult result;
#ifdef FLOORNAV_PCL_PEER
  const PclOutliers pcl(options.neighbors, options.epsilon);
  std::vector<std::uint8_t> keep(cloud.size());
  std::vector<double> times_ms;
  for (int i = 0; i < options.repeats; ++i) times_ms.push_back(pcl.remove(cloud, keep));
  result.ms = quantile_of(times_ms, 0.5);
  for (std::size_t i = 0; i < cloud.size(); ++i) result.different += keep[i] != ours[i] ? 1U : 0U;
#endif
  return result;
}

void run(const OutliersOptions& options) {
  Pinhole camera;
  const RoiCloud cloud = bench_cloud(options, camera);
  Contestant ours(options, "auto"), nanoflann(options, "nanoflann");
  for (int i = 0; i < options.repeats; ++i) {
    ours.run(cloud, camera);
    nanoflann.run(cloud, camera);
  }
  std::size_t different = 0, removed = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    different += ours.keep()[i] != nanoflann.keep()[i] ? 1U : 0U;
    removed += ours.keep()[i] == 0 ? 1U : 0U;
  }
  const double ratio = nanoflann.median_ms() / ours.median_ms();
  const PclResult pcl = run_pcl(options, cloud, ours.keep());
  if (options.json) {
    const nlohmann::json result{{"sensor", options.sensor},
                                {"points", cloud.size()},
                                {"k", options.neighbors},
                                {"sections", cloud.section_end.size()},
                                {"ours_ms", ours.median_ms()},
                                {"nanoflann_ms", nanoflann.median_ms()},
                                {"ratio", ratio},
                                {"pcl_ms", pcl.ms < 0 ? nlohmann::json() : nlohmann::json(pcl.ms)},
                                {"removed", removed},
                                {"different", different}};
    fmt::print("{}\n", result.dump());
    return;
  }
  fmt::print("{}: {} points in {} sections, K = {}, one thread, CPU time\n", options.sensor, cloud.size(),
             cloud.section_end.size(), options.neighbors);
  fmt::print("image window {:7.1f} ms\nnanoflann    {:7.1f} ms, {:.1f} times as long\n", ours.median_ms(),
             nanoflann.median_ms(), ratio);
  fmt::print("{} points removed, {} decided differently\n", removed, different);
  if (pcl.ms < 0)
    fmt::print("PCL is not built in: cmake -DFLOORNAV_PCL_PEER=ON, with the package libpcl-dev\n");
  else
    fmt::print("PCL          {:7.1f} ms, {:.1f} times as long, {} decided otherwise\n", pcl.ms,
               pcl.ms / ours.median_ms(), pcl.different);
}

}  // namespace

void add_outliers_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "outliers", "Outlier removal in the image window against nanoflann: time, and decisions that differ");
  const auto options = std::make_shared<OutliersOptions>();
  command->add_option("--sensor", options->sensor)
      ->check(CLI::IsMember({"kinect", "bumblebee"}))
      ->capture_default_str();
  command->add_option("-k", options->neighbors, "Neighbours")
      ->check(CLI::Range(1, kMaxNeighbors))
      ->capture_default_str();
  command->add_option("--epsilon", options->epsilon, "Of eq. (6)")->capture_default_str();
  command->add_option("--x-res", options->sections.x_res, "Sections along x")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  command->add_option("--y-res", options->sections.y_res, "Sections along y")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  command->add_option("--repeats", options->repeats)->check(CLI::Range(1, 1000))->capture_default_str();
  command->add_flag("--json", options->json, "For programs");
  command->callback([options] { run(*options); });
}

}  // namespace floornav
