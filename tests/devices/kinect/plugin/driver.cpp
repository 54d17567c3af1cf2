#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <map>
#include <string>
#include <thread>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include "tests/devices/kinect/control_block.hpp"
#include "tests/devices/kinect/plugin/device.hpp"

namespace floornav {

/// The OpenNI2 driver of the virtual Kinects. Tells OpenNI2 of devices that are plugged and unplugged, or,
/// where the control block says so, behaves as OpenNI2-FreenectDriver does: only what is there at the start
/// is known, and what was closed cannot be opened again.
class VirtualKinectDriver final : public oni::driver::DriverBase {
 public:
  explicit VirtualKinectDriver(OniDriverServices* services) : DriverBase(services) {}
  ~VirtualKinectDriver() override { shutdown(); }

  OniStatus initialize(oni::driver::DeviceConnectedCallback connected,
                       oni::driver::DeviceDisconnectedCallback disconnected,
                       oni::driver::DeviceStateChangedCallback changed, void* cookie) override {
    DriverBase::initialize(connected, disconnected, changed, cookie);
    if (!map_control_block()) return ONI_STATUS_OK;
    look_at_the_plugs();
    if (control_->without_hotplug == 0) watcher_ = std::thread([this] { watch(); });
    return ONI_STATUS_OK;
  }

  oni::driver::DeviceBase* deviceOpen(const char* uri, const char*) override {
    const int number = number_of(uri);
    if (number < 0 || (known_ >> number & 1U) == 0 || is_unplugged(number)) return nullptr;
    while (control_->open_hangs != 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    try {
      auto* device = new Device(number, *control_);
      open_[device] = number;
      ++control_->opened;
      return device;
    } catch (const std::exception& error) {
      getServices().errorLoggerAppend("%s", error.what());
      return nullptr;
    }
  }

  void deviceClose(oni::driver::DeviceBase* device) override {
    if (control_->without_hotplug != 0) known_ &= ~(1U << open_[device]);
    open_.erase(device);
    delete device;
  }

  void shutdown() override {
    stopping_ = true;
    if (watcher_.joinable()) watcher_.join();
    if (control_ != nullptr) ::munmap(control_, sizeof(ControlBlock));
    control_ = nullptr;
  }

 private:
  bool map_control_block() {
    const char* path = std::getenv(kControlVariable);
    const int file = path == nullptr ? -1 : ::open(path, O_RDWR | O_CLOEXEC);
    if (file < 0) return false;
    void* memory = ::mmap(nullptr, sizeof(ControlBlock), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    ::close(file);
    if (memory == MAP_FAILED) return false;
    control_ = static_cast<ControlBlock*>(memory);
    return true;
  }

  void watch() {
    while (!stopping_) {
      look_at_the_plugs();
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }

  void look_at_the_plugs() {
    for (int number = 0; number <= control_->devices; ++number) {
      const OniDeviceInfo info = info_of(number);
      const std::uint32_t bit = 1U << number;
      if (!is_unplugged(number) && (known_.fetch_or(bit) & bit) == 0) deviceConnected(&info);
      if (is_unplugged(number) && (known_.fetch_and(~bit) & bit) != 0) deviceDisconnected(&info);
    }
  }

  [[nodiscard]] bool is_unplugged(int number) const { return (control_->unplugged >> number & 1U) != 0; }

  static OniDeviceInfo info_of(int number) {
    OniDeviceInfo info{};
    std::snprintf(info.uri, sizeof info.uri, "virtual-kinect://%d", number);
    std::snprintf(info.vendor, sizeof info.vendor, "Virtual");
    std::snprintf(info.name, sizeof info.name, "Kinect");
    info.usbVendorId = 0x045e;
    info.usbProductId = 0x02ae;
    return info;
  }

  int number_of(const std::string& uri) const {
    for (int number = 0; control_ != nullptr && number <= control_->devices; ++number)
      if (uri == info_of(number).uri) return number;
    return -1;
  }

  ControlBlock* control_ = nullptr;
  std::atomic<std::uint32_t> known_{0};  ///< devices that OpenNI2 was told of, as a mask
  std::map<oni::driver::DeviceBase*, int> open_;
  std::atomic<bool> stopping_{false};
  std::thread watcher_;
};

}  // namespace floornav

ONI_EXPORT_DRIVER(floornav::VirtualKinectDriver)
