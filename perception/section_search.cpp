#include "perception/section_search.hpp"

#include <cmath>
#include <numbers>

namespace floornav {

SectionSearch::SectionSearch(const PerceptionSettings& settings, const RobotSettings& robot, int sections)
    : settings_(settings),
      robot_(robot),
      plane_finder_(settings.planes, robot),
      floor_normal_(static_cast<std::size_t>(sections), Eigen::Vector3d::UnitZ()),
      results_(floor_normal_.size()) {}

void SectionSearch::begin(const RoiCloud& cloud, std::int64_t utime_us, int workers) {
  workers_.resize(static_cast<std::size_t>(workers), Worker{OutlierRemover(settings_.outliers), {}, {}});
  utime_us_ = utime_us;
  for (SectionResult& result : results_) {
    result.done = false;
    result.outliers = 0;
    result.planes.clear();
    result.surfels.clear();
  }
  keep_.resize(cloud.size());
  label_.assign(cloud.size(), kOutlier);
  floor_agreement_.clear();
}

void SectionSearch::search(int section, const RoiCloud& cloud, const SensorView& view, int worker,
                           Parallel& parallel, const StageEnd& end_stage) {
  const auto s = static_cast<std::size_t>(section);
  Worker& scratch = workers_[static_cast<std::size_t>(worker)];
  results_[s].done = true;
  remove_outliers(section, cloud, view, scratch.outliers, parallel);
  if (parallel.workers() == 1) end_stage(PerceptionStage::kOutliers);
  Random seed(static_cast<std::uint64_t>(settings_.planes.seed) ^
              (static_cast<std::uint64_t>(section) << 48) ^ static_cast<std::uint64_t>(utime_us_));
  plane_finder_.find(cloud, section, view, floor_normal_[s], seed.next(), label_, parallel, scratch.planes,
                     results_[s].planes);
  if (parallel.workers() == 1) end_stage(PerceptionStage::kPlanes);
}

void SectionSearch::remove_outliers(int section, const RoiCloud& cloud, const SensorView& view,
                                    OutlierRemover& remover, Parallel& parallel) {
  const auto begin = static_cast<std::size_t>(cloud.section_begin(section));
  const auto size = static_cast<std::size_t>(cloud.section_size(section));
  const auto part = [&](const auto& values) { return std::span(values).subspan(begin, size); };
  const std::span<std::uint8_t> keep = std::span(keep_).subspan(begin, size);
  const ImagePoints points{
      {part(cloud.x), part(cloud.y), part(cloud.z)}, part(cloud.pixel), view.camera, true};
  results_[static_cast<std::size_t>(section)].outliers = remover.remove(points, parallel, keep);
  for (std::size_t i = 0; i < size; ++i) label_[begin + i] = keep[i] ? kNoPlane : kOutlier;
}

void SectionSearch::settle(int first, int end, const RoiCloud& cloud, const SensorView& view,
                           Parallel& parallel, std::vector<Surfel>& surfels) {
  agree_on_floor(first, end);
  const auto make = [&](int index, int worker) {
    SectionResult& result = results_[static_cast<std::size_t>(first + index)];
    make_surfels(cloud, first + index, result.planes, label_, view, robot_,
                 workers_[static_cast<std::size_t>(worker)].sums, result.surfels);
  };
  parallel.run(end - first, std::ref(make));
  for (int section = first; section < end; ++section) {
    SectionResult& result = results_[static_cast<std::size_t>(section)];
    result.first_surfel = static_cast<std::int16_t>(surfels.size());
    surfels.insert(surfels.end(), result.surfels.begin(), result.surfels.end());
  }
}

void SectionSearch::agree_on_floor(int first, int end) {
  const auto floor_of = [&](int section) -> SectionPlane* {
    auto& planes = results_[static_cast<std::size_t>(section)].planes;
    return !planes.empty() && planes.front().dominant ? &planes.front() : nullptr;
  };
  for (int section = first; section < end; ++section)
    if (const SectionPlane* floor = floor_of(section)) floor_agreement_.add(floor->fit);
  for (int section = first; section < end; ++section)
    if (SectionPlane* floor = floor_of(section))
      floor->plane = floor_agreement_.settle(floor->fit, floor->plane);
}

void SectionSearch::remember(const SensorView& view) {
  const double min_upright = std::cos(settings_.planes.max_floor_tilt_deg * std::numbers::pi / 180.0);
  for (std::size_t s = 0; s < results_.size(); ++s) {
    const auto& planes = results_[s].planes;
    if (planes.empty() || !planes.front().dominant) continue;
    const Eigen::Vector3d normal =
        view.T_world_sensor.linear() * planes.front().plane.normal().cast<double>();
    if (normal.z() >= min_upright) floor_normal_[s] = normal.normalized();
  }
}

}  // namespace floornav
