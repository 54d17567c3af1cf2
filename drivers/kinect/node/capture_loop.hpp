#pragma once

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "drivers/kinect/connection.hpp"
#include "drivers/kinect/node/depth_device.hpp"
#include "drivers/kinect/node/frame_source.hpp"
#include "drivers/kinect/settings.hpp"

namespace floornav {

/// When a device is given up and tried again.
Connection::Periods periods_of(const KinectSettings& settings);

/// Opens a device, waits for its frames, closes it when they cease and opens it again. Holds the newest
/// frames until they are taken: enough for whoever takes them to be late by a tenth of a second.
class CaptureLoop {
 public:
  /// `tell` is called with a line for a person when the device comes or goes.
  CaptureLoop(std::unique_ptr<DepthDevice> device, Connection::Periods periods,
              std::function<void(const std::string&)> tell);

  /// On a thread of its own: until stop(), then closes the device. The thread takes a real-time priority
  /// where that is allowed: OpenNI2 keeps one frame, which is lost where it is not fetched before the next
  /// one.
  void run();

  // What follows may be called from another thread.
  /// Ends run() as soon as the device's current call is over. False where it is not within `patience`.
  bool stop(std::chrono::milliseconds patience);
  bool take(CapturedFrame& frame);
  [[nodiscard]] CaptureStatus status() const;
  void notify(std::function<void()> arrived);

 private:
  [[nodiscard]] bool goes_on() const;
  void turn();
  void open();
  void restart();
  void receive();
  void hand_over();
  void drop(const char* cause);
  void drop_oldest();
  void say(const std::string& trouble);
  template <class Call>
  auto timed(const char* doing, Call call);

  std::unique_ptr<DepthDevice> device_;
  Connection connection_;
  std::shared_ptr<const DepthStream> stream_;
  std::optional<Lens> lens_;
  CapturedFrame filling_;
  bool unplugged_ = false;  ///< the library said so

  mutable std::mutex mutex_;  ///< of what follows
  std::function<void(const std::string&)> tell_;
  std::function<void()> arrived_;
  std::array<CapturedFrame, 4> waiting_;  ///< a ring; no frame's memory is given back
  std::size_t first_waiting_ = 0;
  std::size_t waiting_count_ = 0;
  std::int64_t dropped_ = 0;  ///< since the last frame that was handed over
  CaptureStatus status_;
  std::int64_t doing_since_us_ = 0;
  bool stopping_ = false;
  bool ended_ = false;
  std::condition_variable end_;
};

}  // namespace floornav
