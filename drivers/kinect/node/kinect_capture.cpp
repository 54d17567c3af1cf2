#include "drivers/kinect/node/kinect_capture.hpp"

#include <utility>

namespace floornav {
namespace {

constexpr std::size_t kWaiting = 4;

const char* name_of(FrameFlaw flaw) {
  switch (flaw) {
    case FrameFlaw::kNone:
      return nullptr;
    case FrameFlaw::kWrongSize:
      return "frame of a wrong size";
    case FrameFlaw::kCutShort:
      return "frame cut short";
    case FrameFlaw::kGarbage:
      return "frame of impossible depths";
  }
  return nullptr;
}

/// Checks, turns and undistorts what a depth camera gives.
class CheckedDevice final : public Device<CapturedFrame> {
 public:
  explicit CheckedDevice(std::unique_ptr<DepthDevice> device) : device_(std::move(device)) {}

  bool listed() override { return device_->listed(); }
  std::string open_stream() override {
    stream_ = std::make_shared<const DepthStream>(device_->open());
    lens_.emplace(stream_->camera, stream_->distortion);
    return stream_->device;
  }
  DeviceEvent wait(std::chrono::milliseconds timeout) override { return device_->wait(timeout); }
  const char* fetch(CapturedFrame& frame) override {
    const DeviceFrame given = device_->frame();
    const FrameFlaw flaw = copy_depths(given, stream_->shape, frame.pixels);
    if (flaw != FrameFlaw::kNone) return name_of(flaw);
    lens_->undistort(frame.pixels);
    frame.stream = stream_;
    frame.dropped_before = 0;
    frame.number = given.number;
    frame.stamp = given.stamp;
    frame.arrival = device_->arrival();
    if (!device_->take_color(frame.color)) frame.color.rgb.clear();
    return nullptr;
  }
  void close() override { device_->close(); }
  void restart() override { device_->restart(); }
  std::string absence() override { return device_->absence(); }

 private:
  std::unique_ptr<DepthDevice> device_;
  std::shared_ptr<const DepthStream> stream_;
  std::optional<Lens> lens_;
};

}  // namespace

Connection::Periods periods_of(const KinectSettings& settings) {
  constexpr std::int64_t kPerMs = 1000;
  return {settings.silence_ms * kPerMs, settings.first_frame_ms * kPerMs, settings.retry_ms * kPerMs};
}

KinectCapture::KinectCapture(std::unique_ptr<DepthDevice> device, Connection::Periods periods,
                             std::function<void(const std::string&)> tell)
    : Capture<CapturedFrame>(std::make_unique<CheckedDevice>(std::move(device)), periods, kWaiting,
                             std::move(tell)) {}

}  // namespace floornav
