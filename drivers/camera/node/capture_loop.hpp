#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "drivers/camera/connection.hpp"
#include "drivers/camera/node/capture_thread.hpp"
#include "drivers/camera/node/device.hpp"
#include "drivers/camera/node/frame_source.hpp"

namespace floornav {

/// Opens a device, waits for its frames, closes it when they cease and opens it again. Holds the newest
/// frames until they are taken.
template <class Frame>
class CaptureLoop {
 public:
  /// `waiting`: so many frames are held. `tell` is called with a line for a person when the device comes or
  /// goes.
  CaptureLoop(std::unique_ptr<Device<Frame>> device, Connection::Periods periods, std::size_t waiting,
              std::function<void(const std::string&)> tell)
      : device_(std::move(device)), connection_(periods), tell_(std::move(tell)), waiting_(waiting) {}

  /// On a thread of its own: until stop(), then closes the device. The thread takes a real-time priority
  /// where that is allowed: a library keeps few frames, which are lost where they are not fetched in time.
  void run();

  // What follows may be called from another thread.
  /// Ends run() as soon as the device's current call is over. False where it is not within `patience`.
  bool stop(std::chrono::milliseconds patience);
  bool take(Frame& frame);
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

  std::unique_ptr<Device<Frame>> device_;
  Connection connection_;
  std::string name_;  ///< of the open device
  Frame filling_;
  bool unplugged_ = false;  ///< the library said so

  mutable std::mutex mutex_;  ///< of what follows
  std::function<void(const std::string&)> tell_;
  std::function<void()> arrived_;
  std::vector<Frame> waiting_;  ///< a ring; no frame's memory is given back
  std::size_t first_waiting_ = 0;
  std::size_t waiting_count_ = 0;
  std::int64_t dropped_ = 0;  ///< since the last frame that was handed over
  CaptureStatus status_;
  std::int64_t doing_since_us_ = 0;
  bool stopping_ = false;
  bool ended_ = false;
  std::condition_variable end_;
};

/// Marks a call into the library, so that one that does not come back can be told of.
template <class Frame>
template <class Call>
auto CaptureLoop<Frame>::timed(const char* doing, Call call) {
  const auto mark = [this](const char* what) {
    const std::scoped_lock lock(mutex_);
    status_.doing = what;
    doing_since_us_ = monotonic_us();
  };
  struct Unmark {
    const decltype(mark)& mark_it;
    ~Unmark() { mark_it(nullptr); }
  };
  mark(doing);
  const Unmark unmark{mark};
  return call();
}

template <class Frame>
void CaptureLoop<Frame>::run() {
  if (!claim_capture_priority()) {
    const std::scoped_lock lock(mutex_);
    if (tell_) tell_(kNoPriority);
  }
  while (goes_on()) turn();
  timed("closing the device", [this] { device_->close(); });
  const std::scoped_lock lock(mutex_);
  ended_ = true;
  end_.notify_all();
}

template <class Frame>
bool CaptureLoop<Frame>::goes_on() const {
  const std::scoped_lock lock(mutex_);
  return !stopping_;
}

template <class Frame>
bool CaptureLoop<Frame>::stop(std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  stopping_ = true;
  tell_ = {};
  arrived_ = {};
  return end_.wait_for(lock, patience, [this] { return ended_; });
}

template <class Frame>
void CaptureLoop<Frame>::turn() {
  constexpr std::chrono::milliseconds kIdle(20);
  if (connection_.is_open()) receive();
  const bool was_streaming = connection_.is_streaming();
  switch (connection_.next(monotonic_us(), connection_.is_open() || device_->listed())) {
    case Connection::Action::kOpen:
      return open();
    case Connection::Action::kClose:
      say(std::exchange(unplugged_, false) ? "the device is gone"
          : was_streaming                  ? "the device has fallen silent"
                                           : "the device is open but sends nothing");
      return timed("closing the device", [this] { device_->close(); });
    case Connection::Action::kRestart:
      return restart();
    case Connection::Action::kNothing:
      if (!connection_.is_open()) std::this_thread::sleep_for(kIdle);
  }
}

template <class Frame>
void CaptureLoop<Frame>::open() {
  try {
    name_ = timed("opening the device", [this] { return device_->open_stream(); });
    connection_.opened(monotonic_us());
    const std::scoped_lock lock(mutex_);
    ++status_.opened;
  } catch (const DeviceError& e) {
    connection_.failed(monotonic_us());
    say(e.what());
  }
}

template <class Frame>
void CaptureLoop<Frame>::restart() {
  try {
    timed("starting again", [this] { device_->restart(); });
    if (!device_->listed()) say(device_->absence());
  } catch (const DeviceError& e) {
    connection_.failed(monotonic_us());
    say(e.what());
  }
}

template <class Frame>
void CaptureLoop<Frame>::receive() {
  constexpr std::chrono::milliseconds kFrameWait(50);
  switch (timed("waiting for a frame", [this] { return device_->wait(kFrameWait); })) {
    case DeviceEvent::kGone:
      unplugged_ = true;
      return connection_.gone();
    case DeviceEvent::kNothing:
      return;
    case DeviceEvent::kFrame:
      break;
  }
  connection_.frame(monotonic_us());
  if (const char* flaw = device_->fetch(filling_)) return drop(flaw);
  say("");
  hand_over();
}

template <class Frame>
void CaptureLoop<Frame>::hand_over() {
  const std::scoped_lock lock(mutex_);
  if (waiting_count_ == waiting_.size()) drop_oldest();
  if (filling_.dropped_before > 0) status_.drops["frame superseded"] += filling_.dropped_before;
  filling_.dropped_before += std::exchange(dropped_, 0);
  std::swap(waiting_[(first_waiting_ + waiting_count_) % waiting_.size()], filling_);
  ++waiting_count_;
  if (arrived_) arrived_();
}

template <class Frame>
void CaptureLoop<Frame>::drop_oldest() {
  const std::int64_t dropped = waiting_[first_waiting_].dropped_before + 1;
  first_waiting_ = (first_waiting_ + 1) % waiting_.size();
  --waiting_count_;
  if (waiting_count_ > 0)
    waiting_[first_waiting_].dropped_before += dropped;
  else
    dropped_ += dropped;
  ++status_.drops["frame superseded"];
}

template <class Frame>
void CaptureLoop<Frame>::notify(std::function<void()> arrived) {
  const std::scoped_lock lock(mutex_);
  arrived_ = std::move(arrived);
}

template <class Frame>
bool CaptureLoop<Frame>::take(Frame& frame) {
  const std::scoped_lock lock(mutex_);
  if (waiting_count_ == 0) return false;
  std::swap(frame, waiting_[first_waiting_]);
  first_waiting_ = (first_waiting_ + 1) % waiting_.size();
  --waiting_count_;
  return true;
}

template <class Frame>
CaptureStatus CaptureLoop<Frame>::status() const {
  const std::scoped_lock lock(mutex_);
  CaptureStatus status = status_;
  if (status.doing != nullptr) status.doing_us = monotonic_us() - doing_since_us_;
  return status;
}

template <class Frame>
void CaptureLoop<Frame>::drop(const char* cause) {
  const std::scoped_lock lock(mutex_);
  ++status_.drops[cause];
  ++dropped_;
}

/// Tells a person what has changed; nothing: frames come.
template <class Frame>
void CaptureLoop<Frame>::say(const std::string& trouble) {
  const std::scoped_lock lock(mutex_);
  if (status_.trouble == trouble) return;
  status_.trouble = trouble;
  if (tell_) tell_(trouble.empty() ? "frames come from " + name_ : trouble);
}

}  // namespace floornav
