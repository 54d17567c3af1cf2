#include "perception/roi_cloud.hpp"

#include <algorithm>
#include <utility>

#include "perception/measurement.hpp"

namespace floornav {

namespace {

constexpr int kRowsPerBand = 16;

int band_count(const DepthFrame& frame) {
  return (frame.camera.height + kRowsPerBand - 1) / kRowsPerBand;
}

}  // namespace

PixelCounts RoiClipper::clip(const DepthFrame& frame, const SensorView& view, Parallel& parallel,
                             RoiCloud& cloud) {
  const int bands = band_count(frame);
  bands_.resize(static_cast<std::size_t>(bands));
  section_of_pixel_.resize(frame.pixels.size());
  const auto rows_of = [&](int band) {
    return std::pair{band * kRowsPerBand, std::min((band + 1) * kRowsPerBand, frame.camera.height)};
  };
  parallel.run(bands, [&](int band, int) {
    const auto [first, end] = rows_of(band);
    sort_band(frame, view, first, end, bands_[static_cast<std::size_t>(band)]);
  });
  lay_out(cloud);
  parallel.run(bands, [&](int band, int) {
    const auto [first, end] = rows_of(band);
    fill_band(frame, first, end, bands_[static_cast<std::size_t>(band)], cloud);
  });
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

void RoiClipper::sort_band(const DepthFrame& frame, const SensorView& view, int first_row, int end_row,
                           Band& band) {
  band.counts = {};
  band.next.assign(static_cast<std::size_t>(grid_.count()), 0);
  const Eigen::Matrix3f R = view.T_body_sensor.linear().cast<float>();
  const Eigen::Vector3f origin = view.T_body_sensor.translation().cast<float>();
  const auto z_min = static_cast<float>(settings_.z_min_m);
  const auto z_max = static_cast<float>(settings_.z_max_m);
  const float max_inverse_depth = 1.0F / static_cast<float>(settings_.min_range_m);
  const auto max_sigma_z = static_cast<float>(settings_.max_sigma_z_m);
  for (int row = first_row; row < end_row; ++row) {
    std::size_t pixel = static_cast<std::size_t>(row) * static_cast<std::size_t>(frame.camera.width);
    for (int column = 0; column < frame.camera.width; ++column, ++pixel) {
      section_of_pixel_[pixel] = -1;
      const Measurement m = measure(frame, pixel, static_cast<float>(settings_.roughness_m));
      const float depth = 1.0F / m.inverse_depth;
      if (!m) {
        ++band.counts.no_measurement;
      } else if (m.inverse_depth > max_inverse_depth) {
        ++band.counts.too_near;
      } else if (!(depth * depth <= max_sigma_z * m.certainty)) {
        ++band.counts.too_uncertain;
      } else {
        const Eigen::Vector3f p =
            origin + depth * (R * frame.camera.ray(static_cast<float>(column), static_cast<float>(row)));
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
}

void RoiClipper::fill_band(const DepthFrame& frame, int first_row, int end_row, Band& band,
                           RoiCloud& cloud) const {
  for (int row = first_row; row < end_row; ++row) {
    std::size_t pixel = static_cast<std::size_t>(row) * static_cast<std::size_t>(frame.camera.width);
    for (int column = 0; column < frame.camera.width; ++column, ++pixel) {
      const int section = section_of_pixel_[pixel];
      if (section < 0) continue;
      const auto i = static_cast<std::size_t>(band.next[static_cast<std::size_t>(section)]++);
      const Measurement m = measure(frame, pixel, static_cast<float>(settings_.roughness_m));
      const Eigen::Vector3f ray = frame.camera.ray(static_cast<float>(column), static_cast<float>(row));
      const float depth = 1.0F / m.inverse_depth;
      cloud.x[i] = ray.x() * depth;
      cloud.y[i] = ray.y() * depth;
      cloud.z[i] = depth;
      cloud.ray_x[i] = ray.x();
      cloud.ray_y[i] = ray.y();
      cloud.inverse_depth[i] = m.inverse_depth;
      cloud.certainty[i] = m.certainty;
      cloud.pixel[i] = static_cast<std::int32_t>(pixel);
    }
  }
}

}  // namespace floornav
