#include "perception/roi_cloud.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "perception/pixel_blocks.hpp"

namespace floornav {

namespace {

constexpr int kRowsPerBand = 16;

int band_count(const DepthFrame& frame) {
  return (frame.camera.height + kRowsPerBand - 1) / kRowsPerBand;
}

}  // namespace

PixelCounts RoiClipper::clip(const DepthFrame& frame, const Measurer& measure, const SensorView& view,
                             Parallel& parallel, RoiCloud& cloud) {
  const int bands = band_count(frame);
  bands_.resize(static_cast<std::size_t>(bands));
  section_of_pixel_.resize(frame.pixels.size());
  find_rays(frame.camera);
  const auto rows_of = [&](int band) {
    return std::pair{band * kRowsPerBand, std::min((band + 1) * kRowsPerBand, frame.camera.height)};
  };
  const auto sort = [&](int band, int) {
    const auto [first, end] = rows_of(band);
    sort_band(measure, view, first, end, bands_[static_cast<std::size_t>(band)]);
  };
  parallel.run(bands, std::ref(sort));
  lay_out(cloud);
  const auto fill = [&](int band, int) {
    const auto [first, end] = rows_of(band);
    fill_band(measure, first, end, bands_[static_cast<std::size_t>(band)], cloud);
  };
  parallel.run(bands, std::ref(fill));
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
  ray_x_.resize(static_cast<std::size_t>(camera.width));
  ray_y_.resize(static_cast<std::size_t>(camera.height));
  for (std::size_t u = 0; u < ray_x_.size(); ++u) ray_x_[u] = camera.ray(static_cast<float>(u), 0.0F).x();
  for (std::size_t v = 0; v < ray_y_.size(); ++v) ray_y_[v] = camera.ray(0.0F, static_cast<float>(v)).y();
}

void RoiClipper::sort_band(const Measurer& measure, const SensorView& view, int first_row, int end_row,
                           Band& band) {
  band.counts = {};
  band.next.assign(static_cast<std::size_t>(grid_.count()), 0);
  const Eigen::Matrix3f R = view.T_body_sensor.linear().cast<float>();
  const Eigen::Vector3f origin = view.T_body_sensor.translation().cast<float>();
  const auto z_min = static_cast<float>(settings_.z_min_m);
  const auto z_max = static_cast<float>(settings_.z_max_m);
  const float max_inverse_depth = 1.0F / static_cast<float>(settings_.min_range_m);
  const auto max_sigma_z = static_cast<float>(settings_.max_sigma_z_m);
  const std::size_t width = ray_x_.size();
  for (int row = first_row; row < end_row; ++row) {
    std::size_t pixel = static_cast<std::size_t>(row) * width;
    const Eigen::Vector3f of_row = R.col(1) * ray_y_[static_cast<std::size_t>(row)] + R.col(2);
    for (std::size_t column = 0; column < width; ++column, ++pixel) {
      section_of_pixel_[pixel] = -1;
      const Measurement m = measure(pixel);
      if (!m) {
        ++band.counts.no_measurement;
        continue;
      }
      const float depth = 1.0F / m.inverse_depth;
      if (m.inverse_depth > max_inverse_depth) {
        ++band.counts.too_near;
      } else if (!(depth * depth <= max_sigma_z * m.certainty)) {
        ++band.counts.too_uncertain;
      } else {
        const Eigen::Vector3f p = origin + depth * (R.col(0) * ray_x_[column] + of_row);
        const int section = p.z() >= z_min && p.z() <= z_max ? grid_.at(p.x(), p.y()) : -1;
        section_of_pixel_[pixel] = static_cast<std::int16_t>(section);
        if (section < 0) {
          ++band.counts.outside_roi;
        } else {
          ++band.counts.in_roi;
          ++band.next[static_cast<std::size_t>(section)];
        }
      }
    }
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

void RoiClipper::fill_band(const Measurer& measure, int first_row, int end_row, Band& band,
                           RoiCloud& cloud) const {
  const std::size_t width = ray_x_.size();
  const auto blocks_per_row =
      static_cast<std::int32_t>((width + PixelBlocks::kSide_px - 1) / PixelBlocks::kSide_px);
  for (int row = first_row; row < end_row; ++row) {
    std::size_t pixel = static_cast<std::size_t>(row) * width;
    const float ray_y = ray_y_[static_cast<std::size_t>(row)];
    const std::int32_t first_block = row / PixelBlocks::kSide_px * blocks_per_row;
    for (std::size_t column = 0; column < width; ++column, ++pixel) {
      const int section = section_of_pixel_[pixel];
      if (section < 0) continue;
      const auto i = static_cast<std::size_t>(band.next[static_cast<std::size_t>(section)]++);
      const Measurement m = measure(pixel);
      const float depth = 1.0F / m.inverse_depth;
      cloud.x[i] = ray_x_[column] * depth;
      cloud.y[i] = ray_y * depth;
      cloud.z[i] = depth;
      cloud.ray_x[i] = ray_x_[column];
      cloud.ray_y[i] = ray_y;
      cloud.inverse_depth[i] = m.inverse_depth;
      cloud.certainty[i] = m.certainty;
      cloud.pixel[i] = static_cast<std::int32_t>(pixel);
      cloud.block[i] = first_block + static_cast<std::int32_t>(column) / PixelBlocks::kSide_px;
    }
  }
}

}  // namespace floornav
