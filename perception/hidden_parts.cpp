#include "perception/hidden_parts.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "perception/row_bands.hpp"
#include "perception/step_kernel.hpp"

namespace floornav {

namespace {

/// What is rough is not hidden by itself.
constexpr LeastStep kNearer{.sigmas = 3.3F, .depth_m = 0.04F};
constexpr std::int32_t kMostBetween = 40;  // pixels without a measurement
constexpr std::int32_t kGoesOn_px = 2;     // from one row or column to the next; noise does not go on
constexpr std::int32_t kNowhere = -1000;

/// By how much the second of two pixels is nearer (below 0: farther) than both the first and a floor through
/// it would be; 0 where it lies between the two, as a side does.
float nearer_by(float first, float second, float floor_growth) {
  const float difference = second - first;
  const float nearer = difference - std::max(floor_growth, 0.0F);
  const float farther = difference - std::min(floor_growth, 0.0F);
  return nearer > 0.0F ? nearer : std::min(farther, 0.0F);
}

/// Whether an outline that was met in the row before goes on in this one.
bool goes_on_above(const std::vector<std::int32_t>& outline_row, std::int32_t column, std::int32_t row) {
  const auto last = std::min(column + kGoesOn_px, static_cast<std::int32_t>(outline_row.size()) - 1);
  for (std::int32_t c = std::max(0, column - kGoesOn_px); c <= last; ++c)
    if (outline_row[static_cast<std::size_t>(c)] == row - 1) return true;
  return false;
}

/// A pixel that measured something, or that there was none.
struct Pixel {
  std::int32_t place = kNowhere;  ///< column or row
  float inverse_depth = 0.0F;     ///< 1/m
};

/// The last pixel before `place` that measured something, as far as outlines are looked for. `apart`: how far
/// neighbours lie apart in memory.
Pixel last_before(const float* depths, std::int32_t place, std::size_t apart) {
  for (std::int32_t before = place - 1; before >= std::max(0, place - kMostBetween); --before) {
    const float inverse_depth = depths[static_cast<std::size_t>(before) * apart];
    if (inverse_depth > 0.0F) return {before, inverse_depth};
  }
  return {};
}

/// The farther one of two pixels between which an outline goes; null where none does.
const Pixel* farther_of(const Pixel& first, const Pixel& second, float floor_growth, float clearly) {
  const std::int32_t apart = second.place - first.place;
  if (apart > kMostBetween) return nullptr;
  const float nearer =
      nearer_by(first.inverse_depth, second.inverse_depth, floor_growth * static_cast<float>(apart));
  if (nearer > clearly) return &first;
  return -nearer > clearly ? &second : nullptr;
}

}  // namespace

/// A frame: where its rays end, and how a level floor's inverse depth grows from pixel to pixel.
struct HiddenPartFinder::Sight {
  const MeasuredImage& image;
  const SensorView& view;
  const CellWindow& window;
  Eigen::Matrix3f R_world_sensor;
  Eigen::Vector3d sensor_m;
  float per_column, per_row;  ///< 1/m

  Sight(const MeasuredImage& of_image, const SensorView& from, const CellWindow& of_cells)
      : image(of_image),
        view(from),
        window(of_cells),
        R_world_sensor(from.T_world_sensor.linear().cast<float>()),
        sensor_m(from.T_world_sensor.translation()) {
    const Pose T_sensor_body = view.T_body_sensor.inverse();
    const Eigen::Vector3f up = T_sensor_body.linear().col(2).cast<float>();
    const float height_m = -up.dot(T_sensor_body.translation().cast<float>());
    const float per_ray = height_m > 0.1F ? -1.0F / height_m : 0.0F;
    per_column = per_ray * up.x() / view.camera.fx;
    per_row = per_ray * up.y() / view.camera.fy;
  }

  /// Marks the cell in which a ray ends.
  void pass(std::int32_t column, std::int32_t row, float inverse_depth,
            std::vector<std::uint8_t>& passed) const {
    const Eigen::Vector3f ray = view.camera.ray(static_cast<float>(column), static_cast<float>(row));
    const Eigen::Vector3f way = R_world_sensor * ray / inverse_depth;
    const std::int32_t cell =
        window.at(sensor_m.x() + static_cast<double>(way.x()), sensor_m.y() + static_cast<double>(way.y()));
    if (cell >= 0) passed[static_cast<std::size_t>(cell)] = 1;
  }
};

void HiddenPartFinder::find(const MeasuredImage& image, const SensorView& view, const CellWindow& window,
                            Parallel& parallel, std::vector<std::uint8_t>& hidden) {
  const Sight sight(image, view, window);
  workers_.resize(static_cast<std::size_t>(parallel.workers()));
  for (Worker& worker : workers_) worker.passed.assign(static_cast<std::size_t>(window.count()), 0);
  const RowBands rows{image.height};
  const auto look = [&](int band, int worker) {
    look_at_rows(sight, rows.first(band), rows.end(band), workers_[static_cast<std::size_t>(worker)]);
  };
  parallel.run(rows.count(), std::ref(look));
  hidden.assign(static_cast<std::size_t>(window.count()), 0);
  for (const Worker& worker : workers_)
    for (std::size_t cell = 0; cell < hidden.size(); ++cell) hidden[cell] |= worker.passed[cell];
}

void HiddenPartFinder::look_at_rows(const Sight& sight, int first_row, int end_row, Worker& worker) {
  worker.outline_row.assign(static_cast<std::size_t>(sight.image.width), kNowhere);
  worker.steps.resize(sight.image.stride);
  for (int row = first_row; row < end_row; ++row) look_at_row(sight, row, worker);
}

/// Outlines go only where a pixel differs from its neighbours, and those are few.
void HiddenPartFinder::look_at_row(const Sight& sight, int row, Worker& worker) {
  const MeasuredImage& image = sight.image;
  const float* const depths = image.inverse_depth.data() + image.row_begin(row);
  const float* const certainties = image.certainty.data() + image.row_begin(row);
  const auto steps = static_cast<std::size_t>(find_steps(image, row, kNearer, worker.steps.data()));
  std::int32_t outline_column = kNowhere;
  for (std::size_t k = 0; k < steps; ++k) {
    const std::int32_t column = worker.steps[k];
    const float here = depths[column];
    const float clearly = std::max(kNearer.sigmas / certainties[column], kNearer.depth_m * here * here);
    const Pixel before = last_before(depths, column, 1), at_column{column, here};
    if (const Pixel* const far = farther_of(before, at_column, sight.per_column, clearly)) {
      if (goes_on_above(worker.outline_row, far->place, row))
        sight.pass(far->place, row, far->inverse_depth, worker.passed);
      worker.outline_row[static_cast<std::size_t>(far->place)] = row;
    }
    const Pixel above = last_before(image.inverse_depth.data() + column, row, image.stride);
    const Pixel at_row{row, here};
    if (const Pixel* const far = farther_of(above, at_row, sight.per_row, clearly)) {
      if (column - outline_column <= kGoesOn_px)
        sight.pass(column, far->place, far->inverse_depth, worker.passed);
      outline_column = column;
    }
  }
}

}  // namespace floornav
