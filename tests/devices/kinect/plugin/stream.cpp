#include "tests/devices/kinect/plugin/stream.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

namespace floornav {
namespace {

using Clock = std::chrono::steady_clock;

std::int64_t monotonic_us() {
  return std::chrono::duration_cast<std::chrono::microseconds>(Clock::now().time_since_epoch()).count();
}

void sleep_until(std::int64_t monotonic_us) {
  std::this_thread::sleep_until(Clock::time_point(std::chrono::microseconds(monotonic_us)));
}

/// True, and one fewer left, where any of a fault is still to happen.
bool use_one(std::atomic<std::int32_t>& left) {
  std::int32_t count = left.load();
  while (count > 0)
    if (left.compare_exchange_weak(count, count - 1)) return true;
  return false;
}

}  // namespace

Stream::Stream(OniSensorType type, int device, const Scene& scene, ControlBlock& control)
    : type_(type), device_(device), scene_(scene), control_(control), mode_(modes_of(type, scene).front()) {}

Stream::~Stream() {
  stop();
}

std::vector<OniVideoMode> Stream::modes_of(OniSensorType type, const Scene& scene) {
  const SceneHeader& h = scene.header();
  const int fps = (1'000'000 + h.period_us / 2) / h.period_us;
  if (type == ONI_SENSOR_COLOR) return {{ONI_PIXEL_FORMAT_RGB888, h.width, h.height, fps}};
  return {{ONI_PIXEL_FORMAT_DEPTH_1_MM, h.width, h.height, fps},
          {ONI_PIXEL_FORMAT_DEPTH_100_UM, h.width, h.height, fps},
          {ONI_PIXEL_FORMAT_DEPTH_1_MM, h.width / 2, h.height / 2, fps},
          {ONI_PIXEL_FORMAT_DEPTH_100_UM, h.width / 2, h.height / 2, fps}};
}

OniStatus Stream::start() {
  if (unplugged()) return ONI_STATUS_NO_DEVICE;
  if (running_.exchange(true)) return ONI_STATUS_OK;
  thread_ = std::thread([this] { play(); });
  return ONI_STATUS_OK;
}

void Stream::stop() {
  running_ = false;
  if (!thread_.joinable()) return;
  thread_.join();
  while (control_.stop_hangs != 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

void Stream::play() {
  const std::int64_t period = scene_.header().period_us;
  const std::int64_t origin = control_.origin_us;
  std::int64_t step = std::max<std::int64_t>(0, (monotonic_us() - origin) / period + 1);
  for (; running_; ++step) {
    const std::int64_t exposure = origin + step * period;
    const std::int64_t late =
        control_.jitter_us > 0
            ? static_cast<std::int64_t>(random_() % static_cast<unsigned>(control_.jitter_us))
            : 0;
    sleep_until(exposure + control_.transfer_us + late);
    if (unplugged() || control_.stalled != 0) continue;
    if (type_ == ONI_SENSOR_DEPTH && use_one(control_.drop)) {
      ++control_.lost;
      if (control_.index_hides_lost == 0) ++index_;
      continue;
    }
    raise(step, exposure);
  }
}

void Stream::raise(std::int64_t step, std::int64_t exposure_us) {
  OniFrame* frame = getServices().acquireFrame();
  if (frame == nullptr) return;
  frame->sensorType = type_;
  frame->videoMode = mode_;
  frame->width = mode_.resolutionX;
  frame->height = mode_.resolutionY;
  frame->stride = frame->width * bytes_per_pixel();
  frame->dataSize = frame->stride * frame->height;
  frame->cropOriginX = frame->cropOriginY = 0;
  frame->croppingEnabled = FALSE;
  frame->frameIndex = ++index_;
  frame->timestamp = clock_at(exposure_us);
  if (type_ == ONI_SENSOR_DEPTH) {
    fill_depth(*frame, step);
    spoil(*frame);
    RaisedFrame& record = control_.records[static_cast<std::size_t>(step) % ControlBlock::kRecords];
    record.exposure_us = exposure_us;
    record.raised_us = monotonic_us();
    ++control_.raised;
    control_.last_raised_us = record.raised_us.load();
  } else {
    fill_color(*frame, step);
  }
  raiseNewFrame(frame);
  getServices().releaseFrame(frame);
}

void Stream::fill_depth(OniFrame& frame, std::int64_t step) {
  if (control_.frozen != 0 && frozen_step_ < 0) frozen_step_ = step;
  if (control_.frozen == 0) frozen_step_ = -1;
  const std::span<const std::uint16_t> seen = scene_.frame_at(frozen_step_ < 0 ? step : frozen_step_);
  const std::int64_t count_um = mode_.pixelFormat == ONI_PIXEL_FORMAT_DEPTH_100_UM ? 100 : 1000;
  const std::int64_t seen_um = control_.black != 0 ? 0 : scene_.header().count_um;
  const bool mirrored = mirrored_ != 0 || control_.only_mirrored != 0;
  std::vector<int> from_columns;
  for (int column = 0; column < frame.width; ++column) from_columns.push_back(seen_column(frame, column));
  auto* out = static_cast<std::uint16_t*>(frame.data);
  for (int row = 0; row < frame.height; ++row) {
    const int from_row = seen_row(frame, row);
    const std::uint16_t* in = seen.data() + std::ptrdiff_t{std::max(0, from_row)} * scene_.header().width;
    for (int column = 0; column < frame.width; ++column) {
      const int from_column = from_columns[static_cast<std::size_t>(column)];
      const std::int64_t depth = from_row < 0 || from_column < 0 ? 0 : in[from_column];
      const std::int64_t counts = (depth * seen_um + count_um / 2) / count_um;
      const int to = mirrored ? frame.width - 1 - column : column;
      out[row * frame.width + to] = static_cast<std::uint16_t>(counts > 65535 ? 0 : counts);
    }
  }
}

namespace {

/// The pixel of the depth camera that the colour camera sees in `at` of `size` pixels, both standing in the
/// same place; -1: none.
int seen_from_color(int at, int size, double wider) {
  const double center = (size - 1) / 2.0;
  const long from = std::lround(center + (at - center) * wider);
  return from >= 0 && from < size ? static_cast<int>(from) : -1;
}

}  // namespace

int Stream::seen_column(const OniFrame& frame, int column) const {
  const int at = column * (scene_.header().width / frame.width);
  return control_.registered == 0 ? at : seen_from_color(at, scene_.header().width, kColorIsWider);
}

int Stream::seen_row(const OniFrame& frame, int row) const {
  const int at = row * (scene_.header().height / frame.height);
  return control_.registered == 0 ? at : seen_from_color(at, scene_.header().height, kColorIsWider);
}

void Stream::fill_color(OniFrame& frame, std::int64_t step) {
  const std::span<const std::uint16_t> seen = scene_.frame_at(step);
  const bool mirrored = mirrored_ != 0 || control_.only_mirrored != 0;
  auto* out = static_cast<OniRGB888Pixel*>(frame.data);
  for (int row = 0; row < frame.height; ++row)
    for (int column = 0; column < frame.width; ++column) {
      const std::uint16_t depth = seen[static_cast<std::size_t>(row * frame.width + column)];
      const auto shade =
          static_cast<std::uint8_t>(255 - std::min(255, depth * scene_.header().count_um / 20000));
      const int to = mirrored ? frame.width - 1 - column : column;
      out[row * frame.width + to] = {shade, static_cast<std::uint8_t>(row),
                                     static_cast<std::uint8_t>(column)};
    }
}

void Stream::spoil(OniFrame& frame) {
  if (use_one(control_.garbage)) {
    auto* bytes = static_cast<std::uint8_t*>(frame.data);
    std::generate(bytes, bytes + frame.dataSize, [this] { return static_cast<std::uint8_t>(random_()); });
  }
  if (use_one(control_.wrong_size)) frame.width += 64;
  if (use_one(control_.cut_short)) frame.dataSize /= 2;
  if (use_one(control_.unplug_in_frame)) {
    frame.dataSize /= 2;
    control_.unplugged |= 1U;
  }
}

bool Stream::unplugged() const {
  return (control_.unplugged >> device_ & 1U) != 0;
}

std::uint64_t Stream::clock_at(std::int64_t monotonic_us) const {
  const std::int64_t drift = monotonic_us / 1000 * control_.clock_ppm / 1000;
  const auto us = static_cast<std::uint64_t>(control_.clock_start_us + monotonic_us + drift);
  return control_.clock_60_mhz != 0 ? us * 60 & 0xFFFFFFFFU : us;
}

float Stream::field_of_view(float of_depth_rad) const {
  if (type_ == ONI_SENSOR_DEPTH) return of_depth_rad;
  return static_cast<float>(2 * std::atan(std::tan(static_cast<double>(of_depth_rad) / 2) * kColorIsWider));
}

OniBool Stream::isPropertySupported(int id) {
  switch (id) {
    case ONI_STREAM_PROPERTY_VIDEO_MODE:
    case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
    case ONI_STREAM_PROPERTY_VERTICAL_FOV:
    case ONI_STREAM_PROPERTY_STRIDE:
    case ONI_STREAM_PROPERTY_CROPPING:
    case ONI_STREAM_PROPERTY_MIRRORING:
      return TRUE;
    case ONI_STREAM_PROPERTY_MIN_VALUE:
    case ONI_STREAM_PROPERTY_MAX_VALUE:
      return type_ == ONI_SENSOR_DEPTH;
    default:
      return FALSE;
  }
}

OniStatus Stream::getProperty(int id, void* data, int* size) {
  if (unplugged()) return ONI_STATUS_NO_DEVICE;
  const bool finer = mode_.pixelFormat == ONI_PIXEL_FORMAT_DEPTH_100_UM;
  switch (id) {
    case ONI_STREAM_PROPERTY_VIDEO_MODE:
      return answer(mode_, data, size);
    case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
      return answer(field_of_view(scene_.header().horizontal_fov_rad), data, size);
    case ONI_STREAM_PROPERTY_VERTICAL_FOV:
      return answer(field_of_view(scene_.header().vertical_fov_rad), data, size);
    case ONI_STREAM_PROPERTY_STRIDE:
      return answer(mode_.resolutionX * bytes_per_pixel(), data, size);
    case ONI_STREAM_PROPERTY_CROPPING:  // without it a recording has no frames
      return answer(OniCropping{FALSE, 0, 0, mode_.resolutionX, mode_.resolutionY}, data, size);
    case ONI_STREAM_PROPERTY_MIRRORING:
      return answer(control_.only_mirrored != 0 ? OniBool{TRUE} : mirrored_.load(), data, size);
    case ONI_STREAM_PROPERTY_MIN_VALUE:
      return answer(int{0}, data, size);
    case ONI_STREAM_PROPERTY_MAX_VALUE:
      return answer(finer ? 65535 : 10000, data, size);
    default:
      return ONI_STATUS_NOT_SUPPORTED;
  }
}

OniStatus Stream::setProperty(int id, const void* data, int size) {
  if (unplugged()) return ONI_STATUS_NO_DEVICE;
  if (id == ONI_STREAM_PROPERTY_VIDEO_MODE) {
    OniVideoMode wanted{};
    if (const OniStatus status = take(wanted, data, size); status != ONI_STATUS_OK) return status;
    const std::vector<OniVideoMode> modes = modes_of(type_, scene_);
    const auto same = [&](const OniVideoMode& mode) { return std::memcmp(&mode, &wanted, sizeof mode) == 0; };
    if (std::none_of(modes.begin(), modes.end(), same)) return ONI_STATUS_NOT_SUPPORTED;
    mode_ = wanted;
    return ONI_STATUS_OK;
  }
  if (id == ONI_STREAM_PROPERTY_MIRRORING && control_.only_mirrored == 0) {
    OniBool wanted = FALSE;
    const OniStatus status = take(wanted, data, size);
    if (status == ONI_STATUS_OK) mirrored_ = wanted;
    return status;
  }
  return ONI_STATUS_NOT_SUPPORTED;
}

OniStatus Stream::convertDepthToColorCoordinates(StreamBase*, int x, int y, OniDepthPixel, int* color_x,
                                                 int* color_y) {
  *color_x = x;
  *color_y = y;
  return ONI_STATUS_OK;
}

}  // namespace floornav
