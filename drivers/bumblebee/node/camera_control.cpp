#include "drivers/bumblebee/node/camera_control.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "drivers/bumblebee/calibration/calibration_files.hpp"
#include "drivers/bumblebee/calibration/stored_calibration.hpp"
#include "drivers/bumblebee/camera_registers.hpp"
#include "drivers/camera/node/device.hpp"

namespace floornav {
namespace {

constexpr auto kMode = DC1394_VIDEO_MODE_FORMAT7_3;

dc1394speed_t speed_of(int mbps) {
  switch (mbps) {
    case 100:
      return DC1394_ISO_SPEED_100;
    case 200:
      return DC1394_ISO_SPEED_200;
    case 400:
      return DC1394_ISO_SPEED_400;
    case 800:
      return DC1394_ISO_SPEED_800;
    default:
      throw DeviceError(fmt::format("iso_speed_mbps is {}; 100, 200, 400 and 800 are allowed", mbps));
  }
}

dc1394color_coding_t coding_of(const FrameLayout& layout) {
  if (layout.eyes == 3) return DC1394_COLOR_CODING_RGB8;
  return layout.bayer.empty() ? DC1394_COLOR_CODING_MONO16 : DC1394_COLOR_CODING_RAW16;
}

double usual_rate(const FrameLayout& layout) {
  return layout.width <= 640 ? 15.0 : 7.5;
}

}  // namespace

void check(dc1394error_t error, const std::string& what) {
  if (error != DC1394_SUCCESS) throw DeviceError(fmt::format("{}: {}", what, dc1394_error_get_string(error)));
}

std::uint32_t CameraControl::read(std::uint32_t address, const char* what) const {
  std::uint32_t value = 0;
  check(dc1394_get_control_register(&camera_, address, &value), what);
  return value;
}

void CameraControl::write(std::uint32_t address, std::uint32_t value, const char* what) const {
  check(dc1394_set_control_register(&camera_, address, value), what);
}

std::string CameraControl::stored_calibration() const {
  constexpr std::uint32_t kMost = 1U << 20;
  const std::uint32_t bytes = read(camera_register::kCalibrationBytes, "size of the stored calibration");
  if (bytes == 0 || bytes > kMost)
    throw DeviceError(fmt::format("it stores a calibration of {} bytes", bytes));
  std::string text;
  for (std::uint32_t at = 0; at < bytes; at += 4) {
    const std::uint32_t four = read(camera_register::kCalibration + at, "stored calibration");
    for (int shift = 24; shift >= 0; shift -= 8) text += static_cast<char>(four >> shift & 0xFFU);
  }
  text.resize(bytes);
  return text;
}

FrameLayout CameraControl::choose_layout() const {
  const std::uint32_t kind = read(camera_register::kSensorType, "it does not tell its sensor: no Bumblebee");
  const auto sensor = sensor_type_of(kind);
  if (!sensor) throw DeviceError(fmt::format("{}: sensor {:#x} is no Bumblebee's", camera_.model, kind));
  FrameLayout layout{sensor->width, sensor->height, settings_.pair == "both" ? 3 : 2, ""};
  if (sensor->color) layout.bayer = bayer_pattern_of(read(camera_register::kBayerPattern, "Bayer pattern"));
  const bool three_eyes = camera_.bmode_capable == DC1394_TRUE;
  if (!three_eyes && settings_.pair != "wide")
    throw DeviceError(fmt::format("{} has one pair of eyes: pair must be wide", camera_.model));
  return layout;
}

void CameraControl::add_pairs(StereoStream& stream) const {
  const int shrink = settings_.half_size ? 2 : 1;
  const std::size_t last = static_cast<std::size_t>(stream.layout.eyes) - 1;
  if (!settings_.calibration.empty()) {
    if (settings_.pair == "both") throw DeviceError("both pairs need the calibration that the camera stores");
    const StereoCalibration calibration =
        read_stereo_calibration(settings_.calibration, settings_.calibration_block);
    if (calibration.left.size != cv::Size(stream.layout.width, stream.layout.height))
      throw DeviceError(fmt::format("{} is for {} x {} px, the camera has {} x {}", settings_.calibration,
                                    calibration.left.size.width, calibration.left.size.height,
                                    stream.layout.width, stream.layout.height));
    stream.pairs.push_back({last, 0, Rectification(calibration, shrink)});
    return;
  }
  const StoredCalibration stored = parse_stored_calibration(stored_calibration());
  const cv::Size size(stream.layout.width, stream.layout.height);
  const double wide_m = stored.baselines_m.front();
  if (settings_.pair != "narrow")
    stream.pairs.push_back({last, 0, rectification_of(stored, size, false, shrink)});
  if (settings_.pair != "wide") {
    Rectification narrow = rectification_of(stored, size, true, shrink);
    const double shift_m = wide_m - narrow.baseline_m();
    stream.pairs.push_back({1, 0, std::move(narrow), shift_m});
  }
}

int CameraControl::choose_speed() const {
  const bool fast = camera_.bmode_capable == DC1394_TRUE;
  const int mbps = settings_.iso_speed_mbps != 0 ? settings_.iso_speed_mbps : fast ? 800 : 400;
  const dc1394speed_t speed = speed_of(mbps);
  if (mbps == 800) {
    if (!fast) throw DeviceError("iso_speed_mbps 800: the camera has no 1394b");
    check(dc1394_video_set_operation_mode(&camera_, DC1394_OPERATION_MODE_1394B), "1394b");
  }
  check(dc1394_video_set_iso_speed(&camera_, speed), "bus speed");
  return mbps;
}

void CameraControl::choose_format(const FrameLayout& layout, int packet_bytes) const {
  check(dc1394_video_set_mode(&camera_, kMode), "Format_7 mode 3");
  if (camera_.bmode_capable == DC1394_TRUE)
    write(camera_register::kPan, settings_.pair == "narrow" ? kNarrowPair : kWidePair, "choice of eyes");
  check(dc1394_format7_set_roi(&camera_, kMode, coding_of(layout), packet_bytes, 0, 0,
                               static_cast<int>(layout.width), static_cast<int>(layout.height)),
        fmt::format("frames of {} x {}, {} eyes, packets of {} bytes", layout.width, layout.height,
                    layout.eyes, packet_bytes));
}

void CameraControl::choose(dc1394feature_t feature, bool automatic, double value, const char* name) const {
  if (automatic && offers_automatic(feature)) {
    check(dc1394_feature_set_mode(&camera_, feature, DC1394_FEATURE_MODE_AUTO), name);
    return;
  }
  check(dc1394_feature_set_mode(&camera_, feature, DC1394_FEATURE_MODE_MANUAL), name);
  check(dc1394_feature_set_absolute_control(&camera_, feature, DC1394_ON), name);
  check(dc1394_feature_set_absolute_value(&camera_, feature, static_cast<float>(value)), name);
}

bool CameraControl::offers_automatic(dc1394feature_t feature) const {
  dc1394feature_modes_t modes{};
  if (dc1394_feature_get_modes(&camera_, feature, &modes) != DC1394_SUCCESS) return false;
  return std::find(modes.modes, modes.modes + modes.num, DC1394_FEATURE_MODE_AUTO) != modes.modes + modes.num;
}

void CameraControl::choose_exposure() const {
  choose(DC1394_FEATURE_SHUTTER, settings_.auto_exposure, settings_.shutter_ms * 1e-3, "shutter_ms");
  choose(DC1394_FEATURE_GAIN, settings_.auto_gain, settings_.gain_db, "gain_db");
  if (settings_.auto_exposure || settings_.auto_gain)
    check(dc1394_feature_set_mode(&camera_, DC1394_FEATURE_EXPOSURE, DC1394_FEATURE_MODE_AUTO),
          "automatic exposure");
}

bool CameraControl::start_stamps() const {
  constexpr std::uint32_t kPresent = 0x80000000;
  std::uint32_t offered = 0;
  if (dc1394_get_control_register(&camera_, camera_register::kFrameInfo, &offered) != DC1394_SUCCESS ||
      (offered & kPresent) == 0)
    return false;
  write(camera_register::kFrameInfo, kStampAndCounter, "frame information");
  return true;
}

std::int64_t CameraControl::exposure_us() const {
  constexpr std::int64_t kUsual_us = 10'000;
  float seconds = 0;
  if (dc1394_feature_get_absolute_value(&camera_, DC1394_FEATURE_SHUTTER, &seconds) != DC1394_SUCCESS ||
      !(seconds > 0 && seconds < 1))
    return kUsual_us;
  return static_cast<std::int64_t>(seconds * 1e6F);
}

StereoStream CameraControl::prepare() const {
  dc1394_video_set_transmission(&camera_, DC1394_OFF);  // a driver that died may have left it on
  check(dc1394_memory_load(&camera_, 0), "camera's default settings");
  StereoStream stream;
  stream.layout = choose_layout();
  write(camera_register::kByteOrder, kRightEyeFirst, "order of the eyes");
  stream.stamped = start_stamps();
  const int mbps = choose_speed();
  const double rate =
      settings_.frames_per_second > 0 ? settings_.frames_per_second : usual_rate(stream.layout);
  const int packet_bytes = settings_.packet_bytes > 0 ? settings_.packet_bytes / 4 * 4
                                                      : packet_bytes_for(rate, stream.layout.bytes(), mbps);
  choose_format(stream.layout, packet_bytes);
  choose_exposure();
  add_pairs(stream);
  stream.period_us = transfer_us(stream.layout.bytes(), packet_bytes);
  stream.shortest_way_us = settings_.exposure_to_arrival_ms > 0
                               ? static_cast<std::int64_t>(settings_.exposure_to_arrival_ms * 1e3)
                               : stream.period_us + exposure_us() / 2;
  stream.device = fmt::format("{} {:016x}, {} x {}, {} eyes, {}, {:.1f} Hz, {} Mbit/s", camera_.model,
                              camera_.guid, stream.layout.width, stream.layout.height, stream.layout.eyes,
                              stream.layout.bayer.empty() ? "mono" : stream.layout.bayer,
                              1e6 / static_cast<double>(stream.period_us), mbps);
  return stream;
}

}  // namespace floornav
