#include "drivers/bumblebee/node/firewire_camera.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include <dirent.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/mman.h>
#include <unistd.h>

#include "drivers/bumblebee/node/camera_control.hpp"
#include "drivers/camera/node/host_time.hpp"

namespace floornav {
namespace {

/// What goes wrong is told once, by who called, and not by the library as well.
void be_quiet() {
  const auto nothing = [](dc1394log_t, const char*, void*) {};
  dc1394_log_register_handler(DC1394_LOG_ERROR, nothing, nullptr);
  dc1394_log_register_handler(DC1394_LOG_WARNING, nothing, nullptr);
}

bool has_bus() {
  DIR* const devices = ::opendir("/dev");
  bool found = false;
  while (const dirent* entry = devices != nullptr ? ::readdir(devices) : nullptr)
    found = found || std::strncmp(entry->d_name, "fw", 2) == 0;
  if (devices != nullptr) ::closedir(devices);
  return found;
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
  std::string text = CameraControl(*camera_, settings_).stored_calibration();
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

std::string FirewireCamera::open_stream() {
  try {
    open_camera();
    const StereoStream stream = CameraControl(*camera_, settings_).prepare();
    start(stream);
    return stream_->device;
  } catch (const std::exception& error) {
    close();
    throw DeviceError(error.what());
  }
}

void FirewireCamera::start(const StereoStream& stream) {
  clock_ = {};
  number_ = out_of_step_ = 0;
  in_step_ = false;
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
  if (stream_->stamped) {
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
