#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <span>
#include <string>
#include <thread>

#include "tests/devices/firewire/bus/iidc_camera.hpp"
#include "tests/devices/firewire/bus/iso_receiver.hpp"
#include "tests/devices/shared_block.hpp"

namespace floornav {

/// A FireWire bus as the kernel's character devices show it: /dev/fw0 is the host's own node, /dev/fw1 the
/// camera. What is read of a descriptor comes from a socket, so that poll() and read() need no help.
class FirewireBus {
 public:
  /// The bus of this process; nullptr where the environment names none, and while it is made.
  static FirewireBus* of_process();

  explicit FirewireBus(const char* control_file);

  /// Nodes that /dev shows now.
  [[nodiscard]] int nodes() const;
  /// A new descriptor of a node; -1 with errno set.
  int open(int node);
  [[nodiscard]] bool owns(int descriptor) const;
  /// The camera behind it is gone.
  [[nodiscard]] bool gone(int descriptor) const;
  int ioctl(int descriptor, unsigned long request, void* argument);
  void set_memory(int descriptor, std::span<std::uint8_t> memory);
  /// Before the descriptor itself is closed.
  void close(int descriptor);

 private:
  /// A camera and what it sees. Whatever is plugged in is looked at anew: it may be another one.
  struct Plugged {
    explicit Plugged(FirewireControl& control) : scene(control.scene_path), camera(scene, control) {}
    SeenEyes scene;
    IidcCamera camera;
  };
  /// An open descriptor.
  struct Client {
    int node = 0;
    std::shared_ptr<Plugged> plugged;
    int peer = -1;  ///< the bus's end of the socket
    std::atomic<bool> gone = false;
    std::unique_ptr<IsoReceiver> receiver;
    std::map<std::uint32_t, std::uint64_t> resources;  ///< closure by handle
    std::span<std::uint8_t> memory;
  };

  [[nodiscard]] std::shared_ptr<Client> client(int descriptor) const;
  static void send(const Client& client, const void* event, std::size_t bytes);
  void watch();
  void unplug();
  void reset();
  void plug();
  int get_info(const Client& client, void* argument) const;
  int send_request(const Client& client, void* argument);
  int allocate(Client& client, void* argument);
  int deallocate(Client& client, void* argument);
  int create_context(const std::shared_ptr<Client>& client, void* argument);
  int queue(Client& client, void* argument);
  int cycle_timer(void* argument) const;

  SharedBlock<FirewireControl> control_;
  mutable std::mutex mutex_;          ///< of what follows
  std::shared_ptr<Plugged> plugged_;  ///< nullptr: no camera
  std::map<int, std::shared_ptr<Client>> clients_;
  std::atomic<std::uint32_t> generation_ = 1;
  std::int32_t resets_seen_ = 0;
};

}  // namespace floornav
