#include "drivers/bumblebee/node/firewire_camera.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include <dirent.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/mman.h>
#include <unistd.h>

#include "drivers/bumblebee/calibration/calibration_files.hpp"
#include "drivers/bumblebee/calibration/stored_calibration.hpp"
#include "drivers/camera/node/host_time.hpp"

namespace floornav {
namespace {

constexpr auto kMode = DC1394_VIDEO_MODE_FORMAT7_3;

void check(dc1394error_t error, const std::string& what) {
  if (error != DC1394_SUCCESS) throw DeviceError(fmt::format("{}: {}", what, dc1394_error_get_string(error)));
}

/// What goes wrong is told once, by who called, and not by the library as well.
void be_quiet() {
  const auto nothing = [](dc1394log_t, const char*, void*) {};
  dc1394_log_register_handler(DC1394_LOG_ERROR, nothing, nullptr);
  dc1394_log_register_handler(DC1394_LOG_WARNING, nothing, nullptr);
}

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

bool has_bus() {
  DIR* const devices = ::opendir("/dev");
  bool found = false;
  while (const dirent* entry = devices != nullptr ? ::readdir(devices) : nullptr)
    found = found || std::strncmp(entry->d_name, "fw", 2) == 0;
  if (devices != nullptr) ::closedir(devices);
  return found;
}

double usual_rate(const FrameLayout& layout) {
  return layout.width <= 640 ? 15.0 : 7.5;
}

}  // namespace

FirewireCamera::FirewireCamera(const BumblebeeSettings& settings) : settings_(settings) {
  be_quiet();
  library_.reset(dc1394_new());
}

FirewireCamera::~FirewireCamera() {
  close();
}

void FirewireCamera::restart() {
  library_.reset();
  library_.reset(dc1394_new());
  looked_ = {};
}

std::vector<std::uint64_t> FirewireCamera::guids() {
  std::vector<std::uint64_t> found;
  dc1394camera_list_t* list = nullptr;
  if (!library_ || dc1394_camera_enumerate(library_.get(), &list) != DC1394_SUCCESS) return found;
  for (std::uint32_t i = 0; i < list->num; ++i) found.push_back(list->ids[i].guid);
  dc1394_camera_free_list(list);
  return found;
}

bool FirewireCamera::listed() {
  constexpr std::chrono::milliseconds kLook(100);
  const auto now = std::chrono::steady_clock::now();
  if (now - looked_ < kLook) return listed_;
  looked_ = now;
  const std::vector<std::uint64_t> found = guids();
  const auto wanted = [this](std::uint64_t guid) {
    return settings_.camera.empty() || fmt::format("{:016x}", guid) == settings_.camera;
  };
  listed_ = std::any_of(found.begin(), found.end(), wanted);
  return listed_;
}

std::string FirewireCamera::absence() {
  if (!library_ || !has_bus())
    return "there is no /dev/fw*: is a FireWire card in, its module firewire_ohci loaded?";
  const std::vector<std::uint64_t> found = guids();
  if (found.empty()) return "no camera is on the bus, or its /dev/fw* may not be read (group video)";
  std::string all;
  for (const std::uint64_t guid : found) all += fmt::format("{}{:016x}", all.empty() ? "" : ", ", guid);
  return fmt::format("no camera has the GUID \"{}\"; there is {}", settings_.camera, all);
}

std::vector<std::string> FirewireCamera::list() {
  std::vector<std::string> lines;
  for (const std::uint64_t guid : guids()) {
    const std::unique_ptr<dc1394camera_t, CloseCamera> camera(dc1394_camera_new(library_.get(), guid));
    if (camera) lines.push_back(fmt::format("{:016x}  {}  {}", guid, camera->vendor, camera->model));
  }
  return lines;
}

std::string FirewireCamera::stored_calibration() {
  open_camera();
  std::string text = read_calibration();
  camera_.reset();
  return text;
}

void FirewireCamera::open_camera() {
  for (const std::uint64_t guid : guids()) {
    if (!settings_.camera.empty() && fmt::format("{:016x}", guid) != settings_.camera) continue;
    camera_.reset(dc1394_camera_new(library_.get(), guid));
    if (camera_) return;
  }
  throw DeviceError(absence());
}

std::uint32_t FirewireCamera::read(std::uint32_t address, const char* what) const {
  std::uint32_t value = 0;
  check(dc1394_get_control_register(camera_.get(), address, &value), what);
  return value;
}

void FirewireCamera::write(std::uint32_t address, std::uint32_t value, const char* what) const {
  check(dc1394_set_control_register(camera_.get(), address, value), what);
}

std::string FirewireCamera::read_calibration() const {
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

FrameLayout FirewireCamera::choose_layout() const {
  const std::uint32_t kind = read(camera_register::kSensorType, "it does not tell its sensor: no Bumblebee");
  const auto sensor = sensor_type_of(kind);
  if (!sensor) throw DeviceError(fmt::format("{}: sensor {:#x} is no Bumblebee's", camera_->model, kind));
  FrameLayout layout{sensor->width, sensor->height, settings_.pair == "both" ? 3 : 2, ""};
  if (sensor->color) layout.bayer = bayer_pattern_of(read(camera_register::kBayerPattern, "Bayer pattern"));
  const bool three_eyes = camera_->bmode_capable == DC1394_TRUE;
  if (!three_eyes && settings_.pair != "wide")
    throw DeviceError(fmt::format("{} has one pair of eyes: pair must be wide", camera_->model));
  return layout;
}

void FirewireCamera::add_pairs(StereoStream& stream) const {
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
  const StoredCalibration stored = parse_stored_calibration(read_calibration());
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

int FirewireCamera::choose_speed() const {
  const bool fast = camera_->bmode_capable == DC1394_TRUE;
  const int mbps = settings_.iso_speed_mbps != 0 ? settings_.iso_speed_mbps : fast ? 800 : 400;
  const dc1394speed_t speed = speed_of(mbps);
  if (mbps == 800) {
    if (!fast) throw DeviceError("iso_speed_mbps 800: the camera has no 1394b");
    check(dc1394_video_set_operation_mode(camera_.get(), DC1394_OPERATION_MODE_1394B), "1394b");
  }
  check(dc1394_video_set_iso_speed(camera_.get(), speed), "bus speed");
  return mbps;
}

void FirewireCamera::choose_format(const FrameLayout& layout, int packet_bytes) const {
  check(dc1394_video_set_mode(camera_.get(), kMode), "Format_7 mode 3");
  if (camera_->bmode_capable == DC1394_TRUE)
    write(camera_register::kPan, settings_.pair == "narrow" ? kNarrowPair : kWidePair, "choice of eyes");
  check(dc1394_format7_set_roi(camera_.get(), kMode, coding_of(layout), packet_bytes, 0, 0,
                               static_cast<int>(layout.width), static_cast<int>(layout.height)),
        fmt::format("frames of {} x {}, {} eyes, packets of {} bytes", layout.width, layout.height,
                    layout.eyes, packet_bytes));
}

void FirewireCamera::choose_exposure() const {
  const auto mode = settings_.auto_exposure ? DC1394_FEATURE_MODE_AUTO : DC1394_FEATURE_MODE_MANUAL;
  for (const auto feature : {DC1394_FEATURE_SHUTTER, DC1394_FEATURE_GAIN})
    check(dc1394_feature_set_mode(camera_.get(), feature, mode), "exposure mode");
  if (settings_.auto_exposure) {
    check(dc1394_feature_set_mode(camera_.get(), DC1394_FEATURE_EXPOSURE, mode), "automatic exposure");
    return;
  }
  const auto set = [this](dc1394feature_t feature, double value, const char* what) {
    check(dc1394_feature_set_absolute_control(camera_.get(), feature, DC1394_ON), what);
    check(dc1394_feature_set_absolute_value(camera_.get(), feature, static_cast<float>(value)), what);
  };
  set(DC1394_FEATURE_SHUTTER, settings_.shutter_ms * 1e-3, "shutter_ms");
  set(DC1394_FEATURE_GAIN, settings_.gain_db, "gain_db");
}

void FirewireCamera::start_embedding() {
  constexpr std::uint32_t kPresent = 0x80000000;
  std::uint32_t offered = 0;
  stamped_ =
      dc1394_get_control_register(camera_.get(), camera_register::kFrameInfo, &offered) == DC1394_SUCCESS &&
      (offered & kPresent) != 0;
  if (stamped_) write(camera_register::kFrameInfo, kStampAndCounter, "frame information");
  clock_ = {};
  number_ = out_of_step_ = 0;
  in_step_ = false;
}

std::int64_t FirewireCamera::exposure_us() const {
  constexpr std::int64_t kUsual_us = 10'000;
  float seconds = 0;
  if (dc1394_feature_get_absolute_value(camera_.get(), DC1394_FEATURE_SHUTTER, &seconds) != DC1394_SUCCESS ||
      !(seconds > 0 && seconds < 1))
    return kUsual_us;
  return static_cast<std::int64_t>(seconds * 1e6F);
}

std::string FirewireCamera::open_stream() {
  try {
    open_camera();
    dc1394_video_set_transmission(camera_.get(), DC1394_OFF);  // a driver that died may have left it on
    check(dc1394_memory_load(camera_.get(), 0), "camera's default settings");
    StereoStream stream;
    stream.layout = choose_layout();
    write(camera_register::kByteOrder, kRightEyeFirst, "order of the eyes");
    start_embedding();
    const int mbps = choose_speed();
    const double rate =
        settings_.frames_per_second > 0 ? settings_.frames_per_second : usual_rate(stream.layout);
    const int packet_bytes = settings_.packet_bytes > 0 ? settings_.packet_bytes / 4 * 4
                                                        : packet_bytes_for(rate, stream.layout.bytes(), mbps);
    choose_format(stream.layout, packet_bytes);
    choose_exposure();
    add_pairs(stream);
    const std::int64_t on_bus_us = transfer_us(stream.layout.bytes(), packet_bytes);
    stream.period_us = on_bus_us;
    stream.shortest_way_us = settings_.exposure_to_arrival_ms > 0
                                 ? static_cast<std::int64_t>(settings_.exposure_to_arrival_ms * 1e3)
                                 : on_bus_us + exposure_us() / 2;
    stream.device = fmt::format("{} {:016x}, {} x {}, {} eyes, {}, {:.1f} Hz, {} Mbit/s", camera_->model,
                                camera_->guid, stream.layout.width, stream.layout.height, stream.layout.eyes,
                                stream.layout.bayer.empty() ? "mono" : stream.layout.bayer,
                                1e6 / static_cast<double>(stream.period_us), mbps);
    start(stream);
    return stream_->device;
  } catch (const std::exception& error) {
    close();
    throw DeviceError(error.what());
  }
}

void FirewireCamera::start(const StereoStream& stream) {
  check(dc1394_capture_setup(camera_.get(), static_cast<std::uint32_t>(settings_.buffers),
                             DC1394_CAPTURE_FLAGS_DEFAULT),
        "capture (is the bus's bandwidth taken?)");
  ring_fd_ = dc1394_capture_get_fileno(camera_.get());
  stream_ = std::make_shared<const StereoStream>(stream);
  check(dc1394_video_set_transmission(camera_.get(), DC1394_ON), "start of the transmission");
}

DeviceEvent FirewireCamera::wait(std::chrono::milliseconds timeout) {
  constexpr int kOutOfStep = 3;  // packets were lost: only a new start finds the frames' beginning again
  if (out_of_step_ >= kOutOfStep) return DeviceEvent::kGone;
  pollfd ready{ring_fd_, POLLIN, 0};
  if (::poll(&ready, 1, static_cast<int>(timeout.count())) <= 0) return DeviceEvent::kNothing;
  if ((ready.revents & (POLLHUP | POLLERR | POLLNVAL)) != 0 || !dequeue_newest()) return DeviceEvent::kGone;
  return newest_ != nullptr ? DeviceEvent::kFrame : DeviceEvent::kNothing;
}

/// The ring's older frames go back to the bus. False where the camera is gone.
bool FirewireCamera::dequeue_newest() {
  while (true) {
    dc1394video_frame_t* frame = nullptr;
    if (dc1394_capture_dequeue(camera_.get(), DC1394_CAPTURE_POLICY_POLL, &frame) != DC1394_SUCCESS)
      return false;
    if (frame == nullptr) return true;
    arrival_ = host_time();
    ring_ = frame->image - static_cast<std::size_t>(frame->id) * frame->total_bytes;
    ring_bytes_ = static_cast<std::size_t>(settings_.buffers) * frame->total_bytes;
    if (newest_ != nullptr) {
      ++passed_over_;
      give_back(newest_);
    }
    newest_ = frame;
  }
}

/// Where this fails the camera is gone, which the next dequeue tells.
void FirewireCamera::give_back(dc1394video_frame_t* frame) {
  dc1394_capture_enqueue(camera_.get(), frame);
}

const char* FirewireCamera::fetch(StereoFrame& frame) {
  constexpr std::int64_t kMostLost = 10'000;
  dc1394video_frame_t* const given = std::exchange(newest_, nullptr);
  const auto wanted = static_cast<std::size_t>(stream_->layout.bytes());
  const bool whole = given->total_bytes >= wanted;
  if (whole) {
    frame.bytes.assign(given->image, given->image + wanted);
    frame.stamp = given->timestamp;
  }
  give_back(given);
  if (!whole) return "frame cut short";
  frame.number = number_ + 1;
  if (stamped_) {
    const FrameStamp stamp = take_stamp(frame.bytes);
    frame.stamp = clock_.us(stamp.cycle_time, arrival_.monotonic_us);
    frame.number = stamp.counter;
    const std::int64_t step = frame.number - number_;
    const bool plausible = !in_step_ || (step > 0 && step < kMostLost);
    out_of_step_ = plausible ? 0 : out_of_step_ + 1;
    if (!plausible) return "frame out of step";
    in_step_ = true;
  }
  number_ = frame.number;
  frame.stream = stream_;
  frame.arrival = arrival_;
  frame.dropped_before = std::exchange(passed_over_, 0);
  return nullptr;
}

void FirewireCamera::close() {
  if (!camera_) return;
  newest_ = nullptr;
  passed_over_ = 0;
  dc1394_video_set_transmission(camera_.get(), DC1394_OFF);
  if (ring_fd_ >= 0 && dc1394_capture_stop(camera_.get()) != DC1394_SUCCESS) release_ring();
  ring_fd_ = -1;
  ring_ = nullptr;
  camera_.reset();
  listed_ = false;
  looked_ = {};
}

/// Of a camera that is gone the library keeps the ring and its descriptor.
void FirewireCamera::release_ring() {
  ::close(ring_fd_);
  if (ring_ != nullptr) ::munmap(ring_, ring_bytes_);
}

}  // namespace floornav
