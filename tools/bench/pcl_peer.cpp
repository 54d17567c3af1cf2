#include "tools/bench/pcl_peer.hpp"

#include <algorithm>

#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/point_types.h>

#include "tools/bench/cpu_clock.hpp"

namespace floornav {
namespace {

pcl::PointCloud<pcl::PointXYZ>::Ptr section_of(const RoiCloud& cloud, int section) {
  const auto points = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  const auto begin = static_cast<std::size_t>(cloud.section_begin(section));
  const auto size = static_cast<std::size_t>(cloud.section_size(section));
  for (std::size_t i = begin; i < begin + size; ++i)
    points->push_back(pcl::PointXYZ(cloud.x[i], cloud.y[i], cloud.z[i]));
  return points;
}

}  // namespace

double PclOutliers::remove(const RoiCloud& cloud, std::span<std::uint8_t> keep) const {
  double spent_ms = 0.0;
  std::fill(keep.begin(), keep.end(), std::uint8_t{0});
  for (int section = 0; section < static_cast<int>(cloud.section_end.size()); ++section) {
    if (cloud.section_size(section) <= neighbors_) continue;
    const auto points = section_of(cloud, section);
    pcl::Indices kept;
    const double began = thread_cpu_ms();
    pcl::StatisticalOutlierRemoval<pcl::PointXYZ> filter;
    filter.setInputCloud(points);
    filter.setMeanK(neighbors_);
    filter.setStddevMulThresh(epsilon_);
    filter.filter(kept);
    spent_ms += thread_cpu_ms() - began;
    for (const auto index : kept)
      keep[static_cast<std::size_t>(cloud.section_begin(section) + index)] = std::uint8_t{1};
  }
  return spent_ms;
}

}  // namespace floornav
