#include "drivers/kinect/node/openni_device.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <thread>

#include <fmt/format.h>

#include "drivers/camera/node/host_time.hpp"
#include "drivers/kinect/field_of_view.hpp"
#include "drivers/kinect/node/calibration_file.hpp"
#include "drivers/kinect/node/usb_devices.hpp"

namespace floornav {
namespace {

using namespace std::chrono_literals;

constexpr float kByHandSpeed = -1;  // OpenNI2's sign for it

void check(openni::Status status, const std::string& what) {
  if (status == openni::STATUS_OK) return;
  std::string why = openni::OpenNI::getExtendedError();
  for (char& c : why)
    if (c == '\n' || c == '\t') c = ' ';
  while (!why.empty() && why.back() == ' ') why.pop_back();
  throw DeviceError(why.empty() ? fmt::format("{} failed (status {})", what, static_cast<int>(status))
                                : fmt::format("{}: {}", what, why));
}

openni::PixelFormat format_of(int depth_unit_um) {
  return depth_unit_um == 100 ? openni::PIXEL_FORMAT_DEPTH_100_UM : openni::PIXEL_FORMAT_DEPTH_1_MM;
}

std::string name_of(const openni::VideoMode& mode) {
  return fmt::format("{}x{} at {} Hz, {}", mode.getResolutionX(), mode.getResolutionY(), mode.getFps(),
                     mode.getPixelFormat() == openni::PIXEL_FORMAT_DEPTH_100_UM ? "0.1 mm" : "1 mm");
}

bool is_depth(const openni::VideoMode& mode) {
  return mode.getPixelFormat() == openni::PIXEL_FORMAT_DEPTH_1_MM ||
         mode.getPixelFormat() == openni::PIXEL_FORMAT_DEPTH_100_UM;
}

/// Empty where the device has none.
std::string serial_of(const openni::Device& device) {
  std::array<char, 256> serial{};
  int size = static_cast<int>(serial.size()) - 1;
  const bool known =
      device.getProperty(openni::DEVICE_PROPERTY_SERIAL_NUMBER, serial.data(), &size) == openni::STATUS_OK;
  return known ? serial.data() : "";
}

}  // namespace

/// Called on a driver's thread: only sets a flag.
class OpenNiDevice::Disconnected final : public openni::OpenNI::DeviceDisconnectedListener {
 public:
  void watch(const std::string& uri) {
    uri_ = uri;
    gone_ = false;
    check(openni::OpenNI::addDeviceDisconnectedListener(this), "listening for the device's removal");
  }
  void rest() { openni::OpenNI::removeDeviceDisconnectedListener(this); }
  [[nodiscard]] bool gone() const { return gone_; }

 private:
  void onDeviceDisconnected(const openni::DeviceInfo* info) override {
    if (uri_ == info->getUri()) gone_ = true;
  }
  std::string uri_;
  std::atomic<bool> gone_ = false;
};

OpenNiDevice::OpenNiDevice(const KinectSettings& settings, OpenNiOptions options)
    : settings_(settings), options_(std::move(options)), disconnected_(std::make_unique<Disconnected>()) {
  start_library();
}

OpenNiDevice::~OpenNiDevice() {
  close();
  stop_library();
}

void OpenNiDevice::start_library() {
  openni::OpenNI::setLogConsoleOutput(false);
  openni::OpenNI::setLogFileOutput(false);
  const openni::Status status = openni::OpenNI::initialize();
  if (status == openni::STATUS_OK) return;
  stop_library();  // it counts failed starts too
  check(status, "OpenNI2 does not start");
}

void OpenNiDevice::stop_library() {
  openni::OpenNI::shutdown();
}

void OpenNiDevice::restart() {
  close();
  stop_library();
  start_library();
}

bool OpenNiDevice::is_file() const {
  std::error_code error;
  return settings_.device.ends_with(".oni") || std::filesystem::is_regular_file(settings_.device, error);
}

std::vector<std::string> OpenNiDevice::uris() {
  openni::Array<openni::DeviceInfo> infos;
  openni::OpenNI::enumerateDevices(&infos);
  std::vector<std::string> uris;
  uris.reserve(static_cast<std::size_t>(infos.getSize()));
  for (int i = 0; i < infos.getSize(); ++i) uris.emplace_back(infos[i].getUri());
  return uris;
}

std::vector<std::string> OpenNiDevice::list() {
  std::vector<std::string> lines;
  for (const std::string& uri : uris()) {
    openni::Device device;
    if (device.open(uri.c_str()) != openni::STATUS_OK) {
      lines.push_back(uri + "  cannot be opened");
      continue;
    }
    const std::string serial = serial_of(device);
    lines.push_back(fmt::format("{}  {} {}  serial number {}", uri, device.getDeviceInfo().getVendor(),
                                device.getDeviceInfo().getName(), serial.empty() ? "unknown" : serial));
  }
  return lines;
}

bool OpenNiDevice::listed() {
  std::error_code error;
  if (is_file()) return std::filesystem::exists(settings_.device, error);
  return !uris().empty();
}

std::string OpenNiDevice::absence() {
  if (is_file()) return settings_.device + ": no such file";
  const std::string hint = usb_camera_hint(kUsbDevices);
  return hint.empty() ? "no depth camera is plugged in" : hint;
}

DepthStream OpenNiDevice::open() {
  try {
    open_device();
    check(depth_.create(device_, openni::SENSOR_DEPTH), "the device's depth stream cannot be opened");
    if (!device_.isFile()) choose_mode();
    set_registration();
    depth_.setMirroringEnabled(false);  // a file refuses, and some devices: describe() sees what came of it
    DepthStream stream = describe();
    if (device_.isFile()) play_file();
    if (!options_.record.empty()) record();
    check(depth_.start(), "the depth stream does not start");
    if (settings_.color) start_color();
    if (!device_.isFile()) disconnected_->watch(device_.getDeviceInfo().getUri());
    return stream;
  } catch (const DeviceError&) {
    close();
    throw;
  } catch (const std::exception& e) {  // a driver's own exception may come through OpenNI2
    close();
    throw DeviceError(e.what());
  }
}

void OpenNiDevice::open_device() {
  const std::string& wanted = settings_.device;
  if (is_file()) return check(device_.open(wanted.c_str()), wanted + ": not a recording that OpenNI2 reads");
  const std::vector<std::string> found = uris();
  for (const std::string& uri : found)
    if (wanted.empty() || uri == wanted) return check(device_.open(uri.c_str()), uri + " cannot be opened");
  for (const std::string& uri : found)
    if (open_if_serial(uri)) return;
  throw DeviceError(fmt::format("no device has the URI or serial number \"{}\"; there is {}", wanted,
                                found.empty() ? "none" : fmt::format("{}", fmt::join(found, ", "))));
}

bool OpenNiDevice::open_if_serial(const std::string& uri) {
  if (device_.open(uri.c_str()) != openni::STATUS_OK) return false;
  if (serial_of(device_) == settings_.device) return true;
  device_.close();
  return false;
}

void OpenNiDevice::choose_mode() {
  const openni::Array<openni::VideoMode>& modes = depth_.getSensorInfo().getSupportedVideoModes();
  std::vector<std::string> offered;
  for (int i = 0; i < modes.getSize(); ++i) {
    const openni::VideoMode& mode = modes[i];
    if (is_depth(mode)) offered.push_back(name_of(mode));
    if (mode.getResolutionX() == settings_.width && mode.getResolutionY() == settings_.height &&
        mode.getFps() == settings_.frames_per_second &&
        mode.getPixelFormat() == format_of(settings_.depth_unit_um))
      return check(depth_.setVideoMode(mode), name_of(mode) + " is refused");
  }
  throw DeviceError(fmt::format("the device has no depth of {}x{} at {} Hz in {} um; it offers {}",
                                settings_.width, settings_.height, settings_.frames_per_second,
                                settings_.depth_unit_um, fmt::join(offered, "; ")));
}

void OpenNiDevice::start_color() {
  check(color_.create(device_, openni::SENSOR_COLOR), "the device's colour stream cannot be opened");
  if (!device_.isFile()) {
    openni::VideoMode mode;
    mode.setResolution(settings_.width, settings_.height);
    mode.setFps(settings_.frames_per_second);
    mode.setPixelFormat(openni::PIXEL_FORMAT_RGB888);
    check(color_.setVideoMode(mode), "the device has no colour of the size and rate of its depth");
  }
  if (color_.getVideoMode().getPixelFormat() != openni::PIXEL_FORMAT_RGB888)
    throw DeviceError("the colour stream is not RGB");
  color_.setMirroringEnabled(false);
  check(color_.start(), "the colour stream does not start");
}

bool OpenNiDevice::take_color(ColorImage& image) {
  if (!color_.isValid()) return false;
  openni::VideoStream* streams[] = {&color_};
  int ready = 0;
  openni::VideoFrameRef frame;
  if (openni::OpenNI::waitForAnyStream(streams, 1, &ready, 0) != openni::STATUS_OK ||
      color_.readFrame(&frame) != openni::STATUS_OK || !frame.isValid())
    return false;
  const auto row_bytes = std::ptrdiff_t{3} * frame.getWidth();
  if (frame.getStrideInBytes() < row_bytes ||
      frame.getDataSize() < std::ptrdiff_t{frame.getStrideInBytes()} * frame.getHeight())
    return false;
  image.width = frame.getWidth();
  image.height = frame.getHeight();
  image.stamp = frame.getTimestamp();
  image.rgb.resize(static_cast<std::size_t>(row_bytes * image.height));
  const bool mirrored = color_.getMirroringEnabled();
  const auto* from = static_cast<const std::uint8_t*>(frame.getData());
  std::uint8_t* to = image.rgb.data();
  for (int row = 0; row < image.height; ++row, from += frame.getStrideInBytes())
    for (int column = 0; column < image.width; ++column, to += 3)
      std::memcpy(to, from + std::ptrdiff_t{3} * (mirrored ? image.width - 1 - column : column), 3);
  return true;
}

void OpenNiDevice::set_registration() {
  const auto wanted =
      settings_.registration ? openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR : openni::IMAGE_REGISTRATION_OFF;
  if (device_.isFile() || device_.getImageRegistrationMode() == wanted) return;
  if (!device_.isImageRegistrationModeSupported(wanted))
    throw DeviceError(settings_.registration ? "the device cannot register depth to colour"
                                             : "the device cannot switch registration off");
  check(device_.setImageRegistrationMode(wanted), "registration");
}

DepthStream OpenNiDevice::describe() {
  const openni::VideoMode mode = depth_.getVideoMode();
  if (!is_depth(mode)) throw DeviceError("the depth stream is not in millimetres");
  DepthStream stream;
  stream.device = fmt::format("{} ({}), {}", device_.getDeviceInfo().getName(),
                              device_.getDeviceInfo().getUri(), name_of(mode));
  stream.shape.width = mode.getResolutionX();
  stream.shape.height = mode.getResolutionY();
  stream.shape.mirrored = depth_.getMirroringEnabled();
  const int most = depth_.getMaxPixelValue();
  stream.shape.max_count = static_cast<std::uint16_t>(most > 0 && most < 65536 ? most : 65535);
  const Calibration calibration = calibration_of(mode);
  stream.camera = calibration.camera;
  stream.distortion = calibration.distortion;
  stream.count_m = mode.getPixelFormat() == openni::PIXEL_FORMAT_DEPTH_100_UM ? 1e-4F : 1e-3F;
  stream.period_us = 1'000'000 / std::max(1, mode.getFps());
  stream.counts_by_clock = !device_.isFile();
  return stream;
}

Calibration OpenNiDevice::calibration_of(const openni::VideoMode& mode) {
  const int width = mode.getResolutionX();
  const int height = mode.getResolutionY();
  if (!settings_.calibration.empty()) return read_calibration(settings_.calibration, width, height);
  const auto seen_by = [&](const openni::VideoStream& stream) {
    return Calibration{pinhole_of_field_of_view(static_cast<double>(stream.getHorizontalFieldOfView()),
                                                static_cast<double>(stream.getVerticalFieldOfView()), width,
                                                height)};
  };
  if (!settings_.registration || device_.isFile()) return seen_by(depth_);
  openni::VideoStream color;  // registered depth is what the colour camera would see
  check(color.create(device_, openni::SENSOR_COLOR), "registration needs the colour camera's field of view");
  return seen_by(color);
}

void OpenNiDevice::play_file() {
  openni::PlaybackControl& control = *device_.getPlaybackControl();
  frames_left_ = frames_in_file_ = control.getNumberOfFrames(depth_);
  check(control.setRepeatEnabled(true), "playback");  // else the player's thread spins at the file's end
  check(control.setSpeed(options_.playback == Playback::kByHand ? kByHandSpeed : 1.0F), "playback");
}

/// The player's thread walks its list of streams without a lock, while destroying one changes the list. By
/// hand it comes to rest before its next frame.
void OpenNiDevice::rest_player() {
  device_.getPlaybackControl()->setSpeed(kByHandSpeed);
  std::this_thread::sleep_for(50ms);
}

void OpenNiDevice::record() {
  std::filesystem::path file = std::filesystem::absolute(options_.record);
  if (++recordings_ > 1)
    file.replace_filename(
        fmt::format("{}-{}{}", file.stem().string(), recordings_, file.extension().string()));
  check(recorder_.create(file.c_str()), file.string() + " cannot be recorded to");
  check(recorder_.attach(depth_), "recording");
  check(recorder_.start(), "recording");
}

DepthDevice::Event OpenNiDevice::wait(std::chrono::milliseconds timeout) {
  const bool by_hand = device_.isFile() && options_.playback == Playback::kByHand;
  if (disconnected_->gone() || (by_hand && frames_left_-- <= 0)) return Event::kGone;
  const std::int64_t last_number = by_hand && frame_.isValid() ? frame_.getFrameIndex() : -1;
  openni::VideoStream* streams[] = {&depth_};
  int ready = 0;
  const openni::Status status =
      openni::OpenNI::waitForAnyStream(streams, 1, &ready, static_cast<int>(timeout.count()));
  if (status != openni::STATUS_OK) return by_hand || disconnected_->gone() ? Event::kGone : Event::kNothing;
  arrival_ = host_time();
  if (depth_.readFrame(&frame_) != openni::STATUS_OK || !frame_.isValid()) return Event::kNothing;
  const bool began_again = frame_.getFrameIndex() <= last_number;
  return began_again ? Event::kGone : Event::kFrame;
}

DeviceFrame OpenNiDevice::frame() {
  DeviceFrame frame;
  frame.bytes = static_cast<const std::uint8_t*>(frame_.getData());
  frame.size = static_cast<std::size_t>(std::max(0, frame_.getDataSize()));
  frame.width = frame_.getWidth();
  frame.height = frame_.getHeight();
  frame.stride = frame_.getStrideInBytes();
  frame.number = frame_.getFrameIndex();
  frame.stamp = frame_.getTimestamp();
  return frame;
}

void OpenNiDevice::close() {
  disconnected_->rest();
  recorder_.destroy();
  frame_.release();
  if (device_.isValid() && device_.isFile()) rest_player();
  color_.destroy();
  depth_.destroy();
  device_.close();
}

}  // namespace floornav
