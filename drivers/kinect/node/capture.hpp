#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "drivers/kinect/connection.hpp"
#include "drivers/kinect/node/depth_device.hpp"
#include "drivers/kinect/node/frame_source.hpp"
#include "drivers/kinect/settings.hpp"

namespace floornav {

/// When a device is given up and tried again.
Connection::Periods periods_of(const KinectSettings& settings);

/// Runs a device on a thread of its own, since its library may take its time or not come back at all: opens
/// it, waits for frames, closes it when they cease, opens it again. Holds the newest frame until it is taken.
class Capture final : public FrameSource {
 public:
  /// Starts at once. `tell` is called with a line for a person when the device comes or goes.
  Capture(std::unique_ptr<DepthDevice> device, Connection::Periods periods,
          std::function<void(const std::string&)> tell);
  /// Waits for the device's current call.
  ~Capture() override;
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;

  bool take(CapturedFrame& frame) override;
  [[nodiscard]] CaptureStatus status() const override;
  void notify(std::function<void()> arrived) override;

 private:
  void run();
  void turn();
  void open();
  void restart();
  void receive();
  void hand_over();
  void drop(const char* cause);
  void say(const std::string& trouble);
  template <class Call>
  auto timed(const char* doing, Call call);

  std::unique_ptr<DepthDevice> device_;
  Connection connection_;
  std::function<void(const std::string&)> tell_;
  std::shared_ptr<const DepthStream> stream_;
  std::optional<Lens> lens_;
  CapturedFrame filling_;
  bool unplugged_ = false;  ///< the library said so

  mutable std::mutex mutex_;  ///< of what follows
  std::function<void()> arrived_;
  CapturedFrame newest_;
  bool has_newest_ = false;
  CaptureStatus status_;
  std::int64_t doing_since_us_ = 0;

  std::jthread thread_;
};

}  // namespace floornav
