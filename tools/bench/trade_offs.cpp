#include "tools/bench/trade_offs.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "perception/floor_perception.hpp"
#include "perception/ransac.hpp"
#include "tools/bench/cpu_clock.hpp"
#include "tools/bench/frame_stack.hpp"
#include "tools/simulator/random.hpp"

namespace floornav {
namespace {

constexpr double kVertex_m = 0.1;
constexpr int kNoLimit = 2000;  ///< more than a section's points give planes

/// All that a setting can change.
struct Setting {
  int width = 640;
  PerceptionSettings perception = perception_for(SensorKind::kKinect, SectionSettings{});
  double resolution_m = kVertex_m;
};

struct NamedSetting {
  std::string knob;
  std::string name;
  Setting setting;
};

std::vector<NamedSetting> settings() {
  std::vector<NamedSetting> all;
  const auto add = [&all](const char* knob, std::string name, const auto& change) {
    Setting setting;
    change(setting);
    all.push_back({knob, std::move(name), setting});
  };
  for (const int width : {640, 320, 160})
    add("3-D data", fmt::format("image {} px wide", width), [&](Setting& s) { s.width = width; });
  for (const int hypotheses : {1000, 200, 50, 10})
    add("search space", fmt::format("{} hypotheses a plane", hypotheses),
        [&](Setting& s) { s.perception.planes.max_hypotheses = hypotheses; });
  for (const double resolution_m : {0.05, 0.1, 0.2, 0.3})
    add("floor's resolution", fmt::format("vertices of {} m", resolution_m),
        [&](Setting& s) { s.resolution_m = resolution_m; });
  for (const double tolerance_deg : {60.0, 15.0, 5.0, 1.0})
    add("inclinations", fmt::format("floor within {} deg", tolerance_deg),
        [&](Setting& s) { s.perception.planes.normal_tolerance_deg = tolerance_deg; });
  for (const int planes : {kNoLimit, 12, 3, 1})
    add("inclinations", fmt::format("{} planes a section", planes),
        [&](Setting& s) { s.perception.planes.max_planes = planes; });
  return all;
}

/// One configuration as a Kinect sees it.
class View {
 public:
  View(int width, std::uint64_t key)
      : course_(random_course(kinect(), covered_area(SensorKind::kKinect), key)),
        sensor_(kinect(width), key) {
    const SensorSpec& spec = sensor_.model();
    frame_.camera = spec.camera;
    frame_.scale = static_cast<float>(sensor_.unit());
    frame_.baseline_m = static_cast<float>(spec.baseline_m);
    frame_.disparity_sigma_px = static_cast<float>(spec.noise.sigma_px / spec.decimation);
    frame_.T_body_sensor = spec.T_body_sensor;
    frame_.pixels = sensor_.measure(course_.shapes, course_.T_world_body, 0);
  }

  [[nodiscard]] const ObstacleCourse& course() const { return course_; }
  [[nodiscard]] const DepthSensor& sensor() const { return sensor_; }
  [[nodiscard]] const DepthFrame& frame() const { return frame_; }

 private:
  ObstacleCourse course_;
  DepthSensor sensor_;
  DepthFrame frame_;
};

/// Processor time of a frame whose sections' normals are known from the one before.
double perception_ms(const View& view, const PerceptionSettings& settings) {
  FloorPerception perception(settings, RobotSettings{});
  Serial serial;
  const auto process = [&] {
    return perception.process(view.frame(), view.course().T_world_body, serial,
                              [](std::int64_t) { return true; });
  };
  process();
  const double began = thread_cpu_ms();
  process();
  return thread_cpu_ms() - began;
}

/// Points on planes and all that outlier removal left, of one frame.
double share_on_planes(const View& view, int max_planes) {
  PerceptionSettings settings = perception_for(SensorKind::kKinect, SectionSettings{});
  settings.planes.max_planes = max_planes;
  if (max_planes == kNoLimit) settings.planes.min_points = 3;
  FloorPerception perception(settings, RobotSettings{});
  Serial serial;
  const FloorEvidence evidence =
      perception.process(view.frame(), view.course().T_world_body, serial, [](std::int64_t) { return true; });
  double on_planes = 0;
  for (const Surfel& surfel : evidence.surfels) on_planes += surfel.points;
  return on_planes / static_cast<double>(evidence.pixels.in_roi - evidence.pixels.outliers);
}

/// The dominant plane of every section, on all points of the ROI.
struct Search {
  const char* way;
  SectionSettings sections;
  bool seeded;
};
constexpr Search kSearches[] = {{"seeded, 4 x 3 sections", {4, 3}, true},
                                {"unseeded, 4 x 3 sections", {4, 3}, false},
                                {"seeded, the whole cloud", {1, 1}, true},
                                {"unseeded, the whole cloud", {1, 1}, false}};

PlanePool pool_of(const RoiCloud& cloud, int section) {
  PlanePool pool;
  pool.resize(static_cast<std::size_t>(cloud.section_size(section)));
  for (std::size_t k = 0; k < pool.size(); ++k) {
    const auto i = static_cast<std::size_t>(cloud.section_begin(section)) + k;
    pool.ray_x[k] = cloud.ray_x[i];
    pool.ray_y[k] = cloud.ray_y[i];
    pool.inverse_depth[k] = cloud.inverse_depth[i];
    pool.certainty[k] = cloud.certainty[i];
    pool.point[k] = static_cast<std::int32_t>(i);
  }
  return pool;
}

std::pair<double, double> hypotheses_and_ms(const View& view, const Search& search) {
  const PerceptionSettings settings = perception_for(SensorKind::kKinect, search.sections);
  const SensorView sensor(view.frame(), view.course().T_world_body);
  RoiCloud cloud;
  Serial serial;
  RoiClipper(settings.roi, SectionGrid(settings.roi, search.sections))
      .clip(view.frame(), sensor, serial, cloud);
  PlaneQuery query;
  query.threshold_sigmas = static_cast<float>(settings.planes.threshold_sigmas);
  query.max_hypotheses = settings.planes.max_hypotheses;
  if (search.seeded) {
    query.expected_normal =
        (sensor.T_world_sensor.linear().transpose() * Eigen::Vector3d::UnitZ()).cast<float>();
    query.cos_tolerance =
        static_cast<float>(std::cos(settings.planes.normal_tolerance_deg * std::numbers::pi / 180.0));
  }
  RansacScratch scratch;
  double ms = 0;
  for (int section = 0; section < static_cast<int>(cloud.section_end.size()); ++section) {
    const PlanePool pool = pool_of(cloud, section);
    Random random(static_cast<std::uint64_t>(section) + 1);
    const double began = thread_cpu_ms();
    find_plane(pool, query, random, serial, scratch);
    ms += thread_cpu_ms() - began;
  }
  return {static_cast<double>(scratch.hypotheses), ms};
}

}  // namespace

std::vector<TradeOff> measure_trade_offs(int configurations, std::uint64_t seed,
                                         const std::function<void(const std::string&)>& progress) {
  std::vector<TradeOff> all;
  progress(fmt::format("trade-offs: {} configurations a setting", configurations));
  for (const auto& [knob, name, setting] : settings()) {
    TradeOff& result = all.emplace_back();
    result.knob = knob;
    result.setting = name;
    std::vector<double> times_ms;
    for (int number = 0; number < configurations; ++number) {
      const View view(setting.width, random_key({seed, static_cast<std::uint64_t>(number)}));
      times_ms.push_back(perception_ms(view, setting.perception));
      MappingSettings mapping;
      mapping.resolution_m = setting.resolution_m;
      FrameStack stack(setting.perception, mapping, RobotSettings{});
      stack.see(view.sensor(), view.frame().pixels, view.course().T_world_body);
      judge(view.course(), stack.published(), result.errors);
    }
    result.perception_ms = quantile_of(times_ms, 0.5);
  }
  return all;
}

MethodClaims measure_claims(int configurations, std::uint64_t seed) {
  MethodClaims claims;
  std::vector<std::vector<double>> times_ms(std::size(kSearches));
  for (const Search& search : kSearches) claims.searches.push_back({search.way});
  const double share = 1.0 / configurations;
  for (int number = 0; number < configurations; ++number) {
    const View view(640, random_key({seed, static_cast<std::uint64_t>(number)}));
    for (std::size_t i = 0; i < std::size(kSearches); ++i) {
      const auto [hypotheses, ms] = hypotheses_and_ms(view, kSearches[i]);
      claims.searches[i].hypotheses += share * hypotheses;
      times_ms[i].push_back(ms);
    }
    claims.share_on_planes += share * share_on_planes(view, kNoLimit);
    claims.share_by_default += share * share_on_planes(view, PlaneSettings{}.max_planes);
    FrameStack stack(perception_for(SensorKind::kKinect, SectionSettings{}), MappingSettings{},
                     RobotSettings{});
    stack.see(view.sensor(), view.frame().pixels, view.course().T_world_body);
    claims.float_bytes += share * static_cast<double>(view.frame().pixels.size() * 3 * sizeof(float));
    claims.cloud_bytes += share * static_cast<double>(stack.cloud_bytes());
    claims.surfel_bytes += share * static_cast<double>(stack.surfel_bytes());
  }
  for (std::size_t i = 0; i < std::size(kSearches); ++i)
    claims.searches[i].ms = quantile_of(times_ms[i], 0.5);
  return claims;
}

}  // namespace floornav
