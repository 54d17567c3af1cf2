#include "perception/hidden_parts.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "perception/row_bands.hpp"

namespace floornav {

namespace {

constexpr float kNearer_sigmas = 3.3F;     // of one pixel
constexpr float kNearer_m = 0.04F;         // what is rough is not hidden by itself
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

/// Whether a pixel, the one before it and the one above it measured about the same: no outline goes between
/// them.
bool goes_on_smoothly(float here, float before, float above, float certainty) {
  const float most = std::max(std::abs(here - before), std::abs(here - above));
  return before > 0.0F && above > 0.0F && most * certainty <= kNearer_sigmas;
}

/// Whether an outline that was met in the row before goes on in this one.
bool goes_on_above(const std::vector<std::int32_t>& outline_row, std::int32_t column, std::int32_t row) {
  const auto last = std::min(column + kGoesOn_px, static_cast<std::int32_t>(outline_row.size()) - 1);
  for (std::int32_t c = std::max(0, column - kGoesOn_px); c <= last; ++c)
    if (outline_row[static_cast<std::size_t>(c)] == row - 1) return true;
  return false;
}

}  // namespace

HiddenPartFinder::Frame HiddenPartFinder::frame_of(const SensorView& view) {
  const Pose T_sensor_body = view.T_body_sensor.inverse();
  const Eigen::Vector3f up = T_sensor_body.linear().col(2).cast<float>();
  const float height_m = -up.dot(T_sensor_body.translation().cast<float>());
  const float per_ray = height_m > 0.1F ? -1.0F / height_m : 0.0F;
  return {view.T_world_sensor.linear().cast<float>(), view.T_world_sensor.translation(),
          per_ray * up.x() / view.camera.fx, per_ray * up.y() / view.camera.fy};
}

void HiddenPartFinder::find(const MeasuredImage& image, const SensorView& view, const CellWindow& window,
                            Parallel& parallel, std::vector<std::uint8_t>& hidden) {
  const Frame frame = frame_of(view);
  workers_.resize(static_cast<std::size_t>(parallel.workers()));
  for (Worker& worker : workers_) worker.passed.assign(static_cast<std::size_t>(window.count()), 0);
  const RowBands rows{image.height};
  const auto look = [&](int band, int worker) {
    look_at_rows(image, view, window, frame, rows.first(band), rows.end(band),
                 workers_[static_cast<std::size_t>(worker)]);
  };
  parallel.run(rows.count(), std::ref(look));
  hidden.assign(static_cast<std::size_t>(window.count()), 0);
  for (const Worker& worker : workers_)
    for (std::size_t cell = 0; cell < hidden.size(); ++cell) hidden[cell] |= worker.passed[cell];
}

/// The last pixel above one that measured something, as far as outlines are looked for.
HiddenPartFinder::Pixel HiddenPartFinder::last_above(const MeasuredImage& image, std::int32_t row,
                                                     std::int32_t column) {
  for (std::int32_t above = row - 1; above >= std::max(0, row - kMostBetween); --above) {
    const float inverse_depth =
        image.inverse_depth[image.row_begin(above) + static_cast<std::size_t>(column)];
    if (inverse_depth > 0.0F) return {above, inverse_depth};
  }
  return {kNowhere, 0.0F};
}

/// The farther one of two pixels between which an outline goes; null where none does.
const HiddenPartFinder::Pixel* HiddenPartFinder::farther_of(const Pixel& first, const Pixel& second,
                                                            float floor_growth, float clearly) {
  const std::int32_t apart = second.place - first.place;
  if (apart > kMostBetween) return nullptr;
  const float nearer =
      nearer_by(first.inverse_depth, second.inverse_depth, floor_growth * static_cast<float>(apart));
  if (nearer > clearly) return &first;
  return -nearer > clearly ? &second : nullptr;
}

void HiddenPartFinder::look_at_rows(const MeasuredImage& image, const SensorView& view,
                                    const CellWindow& window, const Frame& frame, int first_row, int end_row,
                                    Worker& worker) {
  const auto width = static_cast<std::size_t>(image.width);
  worker.outline_row.assign(width, kNowhere);
  for (int row = first_row; row < end_row; ++row) look_at_row(image, view, window, frame, row, worker);
}

void HiddenPartFinder::look_at_row(const MeasuredImage& image, const SensorView& view,
                                   const CellWindow& window, const Frame& frame, int row, Worker& worker) {
  const float* const depths = image.inverse_depth.data() + image.row_begin(row);
  const float* const row_above = row > 0 ? depths - image.stride : depths;
  const float* const certainties = image.certainty.data() + image.row_begin(row);
  const auto ends_at = [&](std::int32_t column, std::int32_t at_row, float inverse_depth) {
    const Eigen::Vector3f ray = view.camera.ray(static_cast<float>(column), static_cast<float>(at_row));
    const Eigen::Vector3f way = frame.R_world_sensor * ray / inverse_depth;
    const std::int32_t cell = window.at(frame.sensor_m.x() + static_cast<double>(way.x()),
                                        frame.sensor_m.y() + static_cast<double>(way.y()));
    if (cell >= 0) worker.passed[static_cast<std::size_t>(cell)] = 1;
  };
  Pixel before{kNowhere, 0.0F};
  std::int32_t outline_column = kNowhere;
  for (std::int32_t column = 0; column < image.width; ++column) {
    const Pixel here{column, depths[column]};
    if (!(here.inverse_depth > 0.0F)) continue;
    if (row > 0 && column > 0 &&
        goes_on_smoothly(here.inverse_depth, depths[column - 1], row_above[column], certainties[column])) {
      before = here;
      continue;
    }
    const float clearly =
        std::max(kNearer_sigmas / certainties[column], kNearer_m * here.inverse_depth * here.inverse_depth);
    if (const Pixel* const far = farther_of(before, here, frame.per_column, clearly)) {
      if (goes_on_above(worker.outline_row, far->place, row)) ends_at(far->place, row, far->inverse_depth);
      worker.outline_row[static_cast<std::size_t>(far->place)] = row;
    }
    const Pixel above = last_above(image, row, column);
    const Pixel below{row, here.inverse_depth};
    if (const Pixel* const far = farther_of(above, below, frame.per_row, clearly)) {
      if (column - outline_column <= kGoesOn_px) ends_at(column, far->place, far->inverse_depth);
      outline_column = column;
    }
    before = here;
  }
}

}  // namespace floornav
