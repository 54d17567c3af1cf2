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
    for (int column = 0; column < image_.width; ++column)
      if (sections[column] >= 0) ++band.next[static_cast<std::size_t>(sections[column])];
  }
  band.first_section = grid_.count();
  band.end_section = 0;
  for (int section = 0; section < grid_.count(); ++section) {
    const std::int32_t points = band.next[static_cast<std::size_t>(section)];
    if (points == 0) continue;
    band.counts.in_roi += points;
    band.first_section = std::min(band.first_section, section);
    band.end_section = section + 1;
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
  const RowBands rows{image_.height};
  const auto fill = [&](int band, int) { fill_band(band, first_section, end_section, cloud); };
  parallel.run(rows.count(), std::ref(fill));
}

void RoiClipper::fill_band(int number, int first_section, int end_section, RoiCloud& cloud) {
  const RowBands rows{image_.height};
  Band& band = bands_[static_cast<std::size_t>(number)];
  if (band.end_section <= first_section || band.first_section >= end_section) return;
  const auto width = static_cast<std::size_t>(image_.width);
  const auto blocks_per_row =
      static_cast<std::int32_t>((width + PixelBlocks::kSide_px - 1) / PixelBlocks::kSide_px);
  for (int row = rows.first(number); row < rows.end(number); ++row) {
    const std::size_t first = image_.row_begin(row);
    const float ray_y = ray_y_[static_cast<std::size_t>(row)];
    const std::int32_t first_block = row / PixelBlocks::kSide_px * blocks_per_row;
    const std::int32_t first_pixel = row * image_.width;
    for (std::size_t column = 0; column < width;) {
      const int section = section_of_pixel_[first + column];
      std::size_t end = column + 1;
      while (end < width && section_of_pixel_[first + end] == section) ++end;
      if (section >= first_section && section < end_section) {
        std::int32_t& next = band.next[static_cast<std::size_t>(section)];
        fill_run({first, column, end, ray_y, first_pixel, first_block}, static_cast<std::size_t>(next),
                 cloud);
        next += static_cast<std::int32_t>(end - column);
      }
      column = end;
    }
  }
}

/// Neighbouring pixels of one section: plain loops over arrays, which the compiler turns into vectors.
void RoiClipper::fill_run(const Run& run, std::size_t place, RoiCloud& cloud) const {
  const std::size_t size = run.end - run.column;
  const float* const inverse_depth = image_.inverse_depth.data() + run.row_begin + run.column;
  const float* const certainty = image_.certainty.data() + run.row_begin + run.column;
  const float* const ray_x = ray_x_.data() + run.column;
  for (std::size_t i = 0; i < size; ++i) cloud.z[place + i] = 1.0F / inverse_depth[i];
  for (std::size_t i = 0; i < size; ++i) cloud.x[place + i] = ray_x[i] * cloud.z[place + i];
  for (std::size_t i = 0; i < size; ++i) cloud.y[place + i] = run.ray_y * cloud.z[place + i];
  const auto at = static_cast<std::ptrdiff_t>(place);
  std::copy_n(ray_x, size, cloud.ray_x.begin() + at);
  std::fill_n(cloud.ray_y.begin() + at, size, run.ray_y);
  std::copy_n(inverse_depth, size, cloud.inverse_depth.begin() + at);
  std::copy_n(certainty, size, cloud.certainty.begin() + at);
  const auto column = static_cast<std::int32_t>(run.column);
  for (std::size_t i = 0; i < size; ++i) {
    const std::int32_t u = column + static_cast<std::int32_t>(i);
    cloud.pixel[place + i] = run.first_pixel + u;
    cloud.block[place + i] = run.first_block + u / PixelBlocks::kSide_px;
  }
}

}  // namespace floornav
