#include "perception/roi_cloud.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "perception/pixel_blocks.hpp"
#include "perception/row_bands.hpp"

namespace floornav {

PixelCounts RoiClipper::clip(const DepthFrame& frame, const SensorView& view, Parallel& parallel,
                             RoiCloud& cloud) {
  const RowBands rows{frame.camera.height};
  bands_.resize(static_cast<std::size_t>(rows.count()));
  image_.resize(frame.camera.width, frame.camera.height);
  section_of_pixel_.resize(image_.inverse_depth.size());
  find_rays(frame.camera);
  const auto sort = [&](int band, int) {
    sort_band(frame, view, rows.first(band), rows.end(band), bands_[static_cast<std::size_t>(band)]);
  };
  parallel.run(rows.count(), std::ref(sort));
  lay_out(cloud);
  PixelCounts total;
  for (const Band& band : bands_) {
    total.no_measurement += band.counts.no_measurement;
    total.too_near += band.counts.too_near;
    total.too_uncertain += band.counts.too_uncertain;
    total.outside_roi += band.counts.outside_roi;
    total.in_roi += band.counts.in_roi;
  }
  return total;
}

void RoiClipper::find_rays(const Pinhole& camera) {
  ray_x_.assign(image_.stride, 0.0F);
  ray_y_.resize(static_cast<std::size_t>(camera.height));
  for (std::size_t u = 0; u < static_cast<std::size_t>(camera.width); ++u)
    ray_x_[u] = camera.ray(static_cast<float>(u), 0.0F).x();
  for (std::size_t v = 0; v < ray_y_.size(); ++v) ray_y_[v] = camera.ray(0.0F, static_cast<float>(v)).y();
}

void RoiClipper::sort_band(const DepthFrame& frame, const SensorView& view, int first_row, int end_row,
                           Band& band) {
  band.counts = {};
  band.runs.clear();
  band.next.assign(static_cast<std::size_t>(grid_.count()), 0);
  const Eigen::Matrix3f R = view.T_body_sensor.linear().cast<float>();
  const MeasurementModel model(frame, static_cast<float>(settings_.roughness_m));
  RowRegion region;
  region.ray_x = ray_x_.data();
  region.per_ray_x = R.col(0);
  region.origin = view.T_body_sensor.translation().cast<float>();
  region.max_inverse_depth = 1.0F / static_cast<float>(settings_.min_range_m);
  region.max_sigma_z = static_cast<float>(settings_.max_sigma_z_m);
  region.z_min = static_cast<float>(settings_.z_min_m);
  region.z_max = static_cast<float>(settings_.z_max_m);
  for (int row = first_row; row < end_row; ++row) {
    region.of_row = R.col(1) * ray_y_[static_cast<std::size_t>(row)] + R.col(2);
    std::int16_t* const sections = section_of_pixel_.data() + image_.row_begin(row);
    measure_row(frame, model, row, image_);
    const RowCounts counts = find_sections(image_, row, region, grid_, sections);
    const auto padding = static_cast<std::int64_t>(image_.stride) - image_.width;
    band.counts.no_measurement += counts.no_measurement - padding;
    band.counts.too_near += counts.too_near;
    band.counts.too_uncertain += counts.too_uncertain;
    band.counts.outside_roi += counts.outside_roi;
    add_runs(row, sections, band);
  }
  for (const std::int32_t points : band.next) band.counts.in_roi += points;
}

void RoiClipper::add_runs(int row, const std::int16_t* sections, Band& band) const {
  for (std::int32_t column = 0; column < image_.width;) {
    const std::int16_t section = sections[column];
    std::int32_t end = column + 1;
    while (end < image_.width && sections[end] == section) ++end;
    if (section >= 0) {
      band.runs.push_back({row, column, end, section});
      band.next[static_cast<std::size_t>(section)] += end - column;
    }
    column = end;
  }
}

/// Turns the bands' numbers of points into places: by section, then by band.
void RoiClipper::lay_out(RoiCloud& cloud) {
  std::int32_t place = 0;
  cloud.section_end.resize(static_cast<std::size_t>(grid_.count()));
  for (std::size_t section = 0; section < cloud.section_end.size(); ++section) {
    for (Band& band : bands_) {
      const std::int32_t count = band.next[section];
      band.next[section] = place;
      place += count;
    }
    cloud.section_end[section] = place;
  }
  const auto size = static_cast<std::size_t>(place);
  for (auto* values :
       {&cloud.x, &cloud.y, &cloud.z, &cloud.ray_x, &cloud.ray_y, &cloud.inverse_depth, &cloud.certainty})
    values->resize(size);
  cloud.pixel.resize(size);
  cloud.block.resize(size);
}

void RoiClipper::fill(int first_section, int end_section, Parallel& parallel, RoiCloud& cloud) {
  const auto fill = [&](int band, int) {
    fill_band(first_section, end_section, bands_[static_cast<std::size_t>(band)], cloud);
  };
  parallel.run(static_cast<int>(bands_.size()), std::ref(fill));
}

void RoiClipper::fill_band(int first_section, int end_section, Band& band, RoiCloud& cloud) const {
  for (const Run& run : band.runs) {
    if (run.section < first_section || run.section >= end_section) continue;
    std::int32_t& next = band.next[static_cast<std::size_t>(run.section)];
    fill_run(run, static_cast<std::size_t>(next), cloud);
    next += run.end - run.column;
  }
}

/// Plain loops over arrays, which the compiler turns into vectors.
void RoiClipper::fill_run(const Run& run, std::size_t place, RoiCloud& cloud) const {
  const auto column = static_cast<std::size_t>(run.column);
  const auto size = static_cast<std::size_t>(run.end - run.column);
  const float* const inverse_depth = image_.inverse_depth.data() + image_.row_begin(run.row) + column;
  const float* const certainty = image_.certainty.data() + image_.row_begin(run.row) + column;
  const float* const ray_x = ray_x_.data() + column;
  const float ray_y = ray_y_[static_cast<std::size_t>(run.row)];
  for (std::size_t i = 0; i < size; ++i) cloud.z[place + i] = 1.0F / inverse_depth[i];
  for (std::size_t i = 0; i < size; ++i) cloud.x[place + i] = ray_x[i] * cloud.z[place + i];
  for (std::size_t i = 0; i < size; ++i) cloud.y[place + i] = ray_y * cloud.z[place + i];
  const auto at = static_cast<std::ptrdiff_t>(place);
  std::copy_n(ray_x, size, cloud.ray_x.begin() + at);
  std::fill_n(cloud.ray_y.begin() + at, size, ray_y);
  std::copy_n(inverse_depth, size, cloud.inverse_depth.begin() + at);
  std::copy_n(certainty, size, cloud.certainty.begin() + at);
  constexpr std::int32_t kSide_px = PixelBlocks::kSide_px;
  const std::int32_t first_pixel = run.row * image_.width;
  const std::int32_t first_block = run.row / kSide_px * ((image_.width + kSide_px - 1) / kSide_px);
  for (std::size_t i = 0; i < size; ++i) {
    const std::int32_t u = run.column + static_cast<std::int32_t>(i);
    cloud.pixel[place + i] = first_pixel + u;
    cloud.block[place + i] = first_block + u / kSide_px;
  }
}

}  // namespace floornav
