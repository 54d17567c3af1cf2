#include "drivers/kinect/node/capture_loop.hpp"

#include <thread>
#include <utility>

#include <sched.h>

#include "drivers/kinect/node/host_time.hpp"

namespace floornav {
namespace {

using namespace std::chrono_literals;

constexpr auto kFrameWait = 50ms;
constexpr auto kIdle = 20ms;

std::int64_t monotonic_us() {
  return std::chrono::duration_cast<std::chrono::microseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// True where the calling thread now runs before all ordinary ones. What the library starts does not inherit
/// it.
bool claim_priority() {
  constexpr int kCapture = 50;
  sched_param param{};
  param.sched_priority = kCapture;
  return ::sched_setscheduler(0, SCHED_FIFO | SCHED_RESET_ON_FORK, &param) == 0;
}

const char* name_of(FrameFlaw flaw) {
  switch (flaw) {
    case FrameFlaw::kWrongSize:
      return "frame of a wrong size";
    case FrameFlaw::kCutShort:
      return "frame cut short";
    default:
      return "frame of impossible depths";
  }
}

}  // namespace

Connection::Periods periods_of(const KinectSettings& settings) {
  constexpr std::int64_t kPerMs = 1000;
  return {settings.silence_ms * kPerMs, settings.first_frame_ms * kPerMs, settings.retry_ms * kPerMs};
}

/// Marks a call into the library, so that one that does not come back can be told of.
template <class Call>
auto CaptureLoop::timed(const char* doing, Call call) {
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

CaptureLoop::CaptureLoop(std::unique_ptr<DepthDevice> device, Connection::Periods periods,
                         std::function<void(const std::string&)> tell)
    : device_(std::move(device)), connection_(periods), tell_(std::move(tell)) {}

void CaptureLoop::run() {
  if (!claim_priority()) {
    const std::scoped_lock lock(mutex_);
    if (tell_)
      tell_(
          "frames may be lost on a busy machine: real-time priority is not allowed here (LimitRTPRIO=50 in "
          "the "
          "unit, or rtprio in /etc/security/limits.conf)");
  }
  while (goes_on()) turn();
  timed("closing the device", [this] { device_->close(); });
  const std::scoped_lock lock(mutex_);
  ended_ = true;
  end_.notify_all();
}

bool CaptureLoop::goes_on() const {
  const std::scoped_lock lock(mutex_);
  return !stopping_;
}

bool CaptureLoop::stop(std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  stopping_ = true;
  tell_ = {};
  arrived_ = {};
  return end_.wait_for(lock, patience, [this] { return ended_; });
}

void CaptureLoop::turn() {
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

void CaptureLoop::open() {
  try {
    stream_ =
        std::make_shared<const DepthStream>(timed("opening the device", [this] { return device_->open(); }));
    lens_.emplace(stream_->camera, stream_->distortion);
    connection_.opened(monotonic_us());
    const std::scoped_lock lock(mutex_);
    ++status_.opened;
  } catch (const DeviceError& e) {
    connection_.failed(monotonic_us());
    say(e.what());
  }
}

void CaptureLoop::restart() {
  try {
    timed("starting OpenNI2 again", [this] { device_->restart(); });
    if (!device_->listed()) say(device_->absence());
  } catch (const DeviceError& e) {
    connection_.failed(monotonic_us());
    say(e.what());
  }
}

void CaptureLoop::receive() {
  switch (timed("waiting for a frame", [this] { return device_->wait(kFrameWait); })) {
    case DepthDevice::Event::kGone:
      unplugged_ = true;
      return connection_.gone();
    case DepthDevice::Event::kNothing:
      return;
    case DepthDevice::Event::kFrame:
      break;
  }
  connection_.frame(monotonic_us());
  const DeviceFrame frame = device_->frame();
  const FrameFlaw flaw = copy_depths(frame, stream_->shape, filling_.pixels);
  if (flaw != FrameFlaw::kNone) return drop(name_of(flaw));
  lens_->undistort(filling_.pixels);
  filling_.stream = stream_;
  filling_.number = frame.number;
  filling_.stamp = frame.stamp;
  filling_.arrival = device_->arrival();
  if (!device_->take_color(filling_.color)) filling_.color.rgb.clear();
  say("");
  hand_over();
}

void CaptureLoop::hand_over() {
  const std::scoped_lock lock(mutex_);
  if (waiting_count_ == waiting_.size()) drop_oldest();
  filling_.dropped_before = std::exchange(dropped_, 0);
  std::swap(waiting_[(first_waiting_ + waiting_count_) % waiting_.size()], filling_);
  ++waiting_count_;
  if (arrived_) arrived_();
}

void CaptureLoop::drop_oldest() {
  const std::int64_t dropped = waiting_[first_waiting_].dropped_before + 1;
  first_waiting_ = (first_waiting_ + 1) % waiting_.size();
  --waiting_count_;
  waiting_[first_waiting_].dropped_before += dropped;
  ++status_.drops["frame superseded"];
}

void CaptureLoop::notify(std::function<void()> arrived) {
  const std::scoped_lock lock(mutex_);
  arrived_ = std::move(arrived);
}

bool CaptureLoop::take(CapturedFrame& frame) {
  const std::scoped_lock lock(mutex_);
  if (waiting_count_ == 0) return false;
  std::swap(frame, waiting_[first_waiting_]);
  first_waiting_ = (first_waiting_ + 1) % waiting_.size();
  --waiting_count_;
  return true;
}

CaptureStatus CaptureLoop::status() const {
  const std::scoped_lock lock(mutex_);
  CaptureStatus status = status_;
  if (status.doing != nullptr) status.doing_us = monotonic_us() - doing_since_us_;
  return status;
}

void CaptureLoop::drop(const char* cause) {
  const std::scoped_lock lock(mutex_);
  ++status_.drops[cause];
  ++dropped_;
}

/// Tells a person what has changed; nothing: frames come.
void CaptureLoop::say(const std::string& trouble) {
  const std::scoped_lock lock(mutex_);
  if (status_.trouble == trouble) return;
  status_.trouble = trouble;
  if (tell_) tell_(trouble.empty() ? "frames come from " + stream_->device : trouble);
}

}  // namespace floornav
