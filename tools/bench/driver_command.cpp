#include "tools/bench/driver_command.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <ctime>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "drivers/kinect/node/cloud_message.hpp"
#include "drivers/kinect/node/kinect_capture.hpp"
#include "drivers/kinect/node/kinect_node.hpp"
#include "drivers/kinect/node/openni_device.hpp"
#include "runtime/process/lcm_transport.hpp"
#include "runtime/process/live_executor.hpp"
#include "tools/bench/strip_cost.hpp"

namespace floornav {
namespace {

struct Options {
  KinectSettings kinect;
  int frames = 300;
  std::string lcm_url = "memq://";
  bool json = false;
};

/// Notes when the frame arrived that the node takes, for the bus that its message then goes to.
class TimedSource final : public FrameSource<CapturedFrame> {
 public:
  explicit TimedSource(std::unique_ptr<FrameSource<CapturedFrame>> source) : source_(std::move(source)) {}

  bool take(CapturedFrame& frame) override {
    const bool taken = source_->take(frame);
    if (taken) arrival_us = frame.arrival.monotonic_us;
    return taken;
  }
  [[nodiscard]] CaptureStatus status() const override { return source_->status(); }
  void notify(std::function<void()> arrived) override { source_->notify(std::move(arrived)); }

  std::int64_t arrival_us = 0;

 private:
  std::unique_ptr<FrameSource<CapturedFrame>> source_;
};

/// Publishes, and notes how long each cloud took from its frame's arrival until the bus had it.
class TimedBus final : public Transport {
 public:
  /// `source` is set before anything is published.
  TimedBus(const std::string& url, const std::string& channel) : bus_(url), channel_(channel) {}

  void subscribe(const std::string&) override {}
  bool publish(const EncodedMessage& message) override {
    const bool sent = bus_.publish(message);
    if (message.channel != channel_) return sent;
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    const std::int64_t us = std::chrono::duration_cast<std::chrono::microseconds>(now).count();
    const std::scoped_lock lock(mutex_);
    latency_ms_.push_back(static_cast<double>(us - source->arrival_us) * 1e-3);
    bytes_ += message.bytes.size();
    return sent;
  }
  void receive(std::chrono::milliseconds timeout, const Receiver&) override {
    std::this_thread::sleep_for(timeout);
  }

  std::vector<double> latency_ms() const {
    const std::scoped_lock lock(mutex_);
    return latency_ms_;
  }
  std::size_t bytes() const {
    const std::scoped_lock lock(mutex_);
    return bytes_;
  }

  const TimedSource* source = nullptr;

 private:
  LcmTransport bus_;
  std::string channel_;
  mutable std::mutex mutex_;
  std::vector<double> latency_ms_;
  std::size_t bytes_ = 0;
};

/// Processor time of this process so far, and of the calling thread.
double cpu_ms(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_nsec) * 1e-6;
}

/// What the library costs by itself: the same frames waited for and thrown away. Some of them are kept in
/// `samples` before.
double library_ms_per_frame(const KinectSettings& settings, int frames, FrameSamples& samples) {
  constexpr std::size_t kSamples = 30;
  OpenNiDevice device(settings);
  const DepthStream stream = device.open();
  samples.cloud = cloud_of(stream, settings);
  while (samples.images.size() < kSamples) {
    if (device.wait(std::chrono::seconds(2)) != DepthDevice::Event::kFrame)
      throw DeviceError("the device sends no frames");
    std::vector<std::uint16_t> pixels;
    if (copy_depths(device.frame(), stream.shape, pixels) == FrameFlaw::kNone)
      samples.images.push_back(pixels);
  }
  const double before = cpu_ms(CLOCK_PROCESS_CPUTIME_ID);
  for (int frame = 0; frame < frames;) switch (device.wait(std::chrono::seconds(2))) {
      case DepthDevice::Event::kFrame:
        ++frame;
        break;
      default:
        throw DeviceError("the device sends no frames");
    }
  const double spent = cpu_ms(CLOCK_PROCESS_CPUTIME_ID) - before;
  device.close();
  return spent / frames;
}

struct DriverCost {
  double cpu_ms_per_frame = 0;      ///< of the whole process, the device's own driver within it
  double library_ms_per_frame = 0;  ///< of which OpenNI2 and the device's driver
  std::vector<double> latency_ms;   ///< sorted
  double bytes_per_frame = 0;
  StripCost strips;
};

DriverCost measure(const Options& options) {
  DriverCost cost;
  FrameSamples samples;
  cost.library_ms_per_frame = library_ms_per_frame(options.kinect, options.frames, samples);
  cost.strips = measure_strips(samples);
  TimedBus bus(options.lcm_url, options.kinect.channel);
  auto source = std::make_unique<TimedSource>(std::make_unique<KinectCapture>(
      std::make_unique<OpenNiDevice>(options.kinect), periods_of(options.kinect), [](const std::string&) {}));
  bus.source = source.get();
  KinectNode node(options.kinect, std::move(source), [] {});
  LiveExecutor executor(node, bus, {});
  std::atomic<bool> stop = false;
  std::jthread worker([&] { executor.run(stop); });
  const auto wait_for = [&](std::size_t frames) {
    auto deadline =
        std::chrono::steady_clock::now() + std::chrono::seconds(10 + static_cast<int>(frames) / 5);
    while (bus.latency_ms().size() < frames && std::chrono::steady_clock::now() < deadline)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    if (bus.latency_ms().size() < frames) {
      stop = true;
      throw DeviceError("the device sends too few frames");
    }
  };
  constexpr std::size_t kWarmUp = 30;
  wait_for(kWarmUp);
  const std::size_t first = bus.latency_ms().size();
  const double before = cpu_ms(CLOCK_PROCESS_CPUTIME_ID);
  wait_for(first + static_cast<std::size_t>(options.frames));
  const double spent = cpu_ms(CLOCK_PROCESS_CPUTIME_ID) - before;
  cost.latency_ms = bus.latency_ms();
  stop = true;
  cost.bytes_per_frame = static_cast<double>(bus.bytes()) / static_cast<double>(cost.latency_ms.size());
  cost.cpu_ms_per_frame = spent / static_cast<double>(cost.latency_ms.size() - first);
  cost.latency_ms.erase(cost.latency_ms.begin(),
                        cost.latency_ms.begin() + static_cast<std::ptrdiff_t>(first));
  std::sort(cost.latency_ms.begin(), cost.latency_ms.end());
  return cost;
}

void print(const DriverCost& cost, bool json) {
  const auto percentile = [&](double share) {
    return cost.latency_ms[static_cast<std::size_t>(share * static_cast<double>(cost.latency_ms.size() - 1))];
  };
  const double own = cost.cpu_ms_per_frame - cost.library_ms_per_frame;
  if (json) {
    const nlohmann::json out = {{"frames", cost.latency_ms.size()},
                                {"cpu_ms", own},
                                {"library_ms", cost.library_ms_per_frame},
                                {"median_ms", percentile(0.5)},
                                {"p99_ms", percentile(0.99)},
                                {"max_ms", percentile(1)},
                                {"bytes", cost.bytes_per_frame},
                                {"strips",
                                 {{"whole_ms", cost.strips.whole_ms},
                                  {"near_ms", cost.strips.near_ms},
                                  {"all_ms", cost.strips.all_ms}}}};
    fmt::print("{}\n", out.dump());
    return;
  }
  fmt::print("{} frames of {:.0f} kB\n", cost.latency_ms.size(), cost.bytes_per_frame / 1000);
  fmt::print("CPU a frame: driver {:.2f} ms, OpenNI2 and the device's own driver beside it {:.2f} ms\n", own,
             cost.library_ms_per_frame);
  fmt::print("frame's arrival to published message: median {:.2f} ms, p99 {:.2f} ms, max {:.2f} ms\n",
             percentile(0.5), percentile(0.99), percentile(1));
  fmt::print(
      "a frame's pixels packed, sent and unpacked again: {:.2f} ms of CPU; in {} strips {:.2f} ms, of which "
      "the "
      "nearest, sent first, {:.2f} ms\n",
      cost.strips.whole_ms, kStrips, cost.strips.all_ms, cost.strips.near_ms);
}

}  // namespace

void add_driver_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "driver",
      "CPU of the Kinect driver and its delay, with whatever device OpenNI2 opens (or an .oni file)");
  const auto o = std::make_shared<Options>();
  command->add_option("--device", o->kinect.device,
                      "URI, serial number or .oni file; default: the first one");
  command->add_option("--frames", o->frames, "Frames to measure")
      ->check(CLI::Range(30, 100'000))
      ->capture_default_str();
  command->add_option("--lcm-url", o->lcm_url, "Bus to publish on")->capture_default_str();
  command->add_flag("--json", o->json, "Print one line of JSON");
  command->callback([o] { print(measure(*o), o->json); });
}

}  // namespace floornav
