#include "tests/devices/firewire/bus/bus.hpp"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include <arpa/inet.h>
#include <linux/firewire-cdev.h>
#include <linux/firewire-constants.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

namespace floornav {
namespace {

constexpr std::uint64_t kRegisterSpace = 0xFFFFF0000000;
constexpr int kCamera = 1;

int fail(int error) {
  errno = error;
  return -1;
}

bool is_read(std::uint32_t tcode) {
  return tcode == TCODE_READ_QUADLET_REQUEST || tcode == TCODE_READ_BLOCK_REQUEST;
}

}  // namespace

FirewireBus* FirewireBus::of_process() {
  static std::atomic<FirewireBus*> bus = nullptr;  // never destroyed: libdc1394 may be at work until the end
  static thread_local bool making = false;         // what the bus opens itself is libc's
  if (FirewireBus* const made = bus) return made;
  const char* const file = std::getenv(kFirewireVariable);
  if (file == nullptr || making) return nullptr;
  static std::mutex mutex;
  making = true;
  const std::scoped_lock lock(mutex);
  try {
    if (bus == nullptr) bus = new FirewireBus(file);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "virtual FireWire bus: %s\n", error.what());
    std::abort();
  }
  making = false;
  return bus;
}

FirewireBus::FirewireBus(const char* control_file)
    : control_(control_file, SharedBlock<FirewireControl>::How::kOpen) {
  if (control_->unplugged == 0 && control_->no_bus == 0) plug();
  std::thread([this] { watch(); }).detach();
}

int FirewireBus::nodes() const {
  if (control_->no_bus != 0) return 0;
  const std::scoped_lock lock(mutex_);
  return plugged_ ? 2 : 1;
}

int FirewireBus::open(int node) {
  if (node >= nodes()) return fail(ENODEV);
  int pair[2];
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, pair) != 0) return -1;
  const int room = 1 << 20;
  ::setsockopt(pair[1], SOL_SOCKET, SO_SNDBUF, &room, sizeof room);
  auto client = std::make_shared<Client>();
  client->node = node;
  client->peer = pair[1];
  const std::scoped_lock lock(mutex_);
  client->plugged = plugged_;
  if (node == kCamera && !plugged_) client->gone = true;
  clients_[pair[0]] = std::move(client);
  return pair[0];
}

std::shared_ptr<FirewireBus::Client> FirewireBus::client(int descriptor) const {
  const std::scoped_lock lock(mutex_);
  const auto found = clients_.find(descriptor);
  return found == clients_.end() ? nullptr : found->second;
}

bool FirewireBus::owns(int descriptor) const {
  return client(descriptor) != nullptr;
}

bool FirewireBus::gone(int descriptor) const {
  const auto found = client(descriptor);
  return found && found->gone;
}

void FirewireBus::close(int descriptor) {
  const auto closed = client(descriptor);
  if (!closed) return;
  {
    const std::scoped_lock lock(mutex_);
    clients_.erase(descriptor);
  }
  if (closed->receiver) closed->receiver->stop();
  ::close(closed->peer);
}

void FirewireBus::set_memory(int descriptor, std::span<std::uint8_t> memory) {
  const auto found = client(descriptor);
  found->memory = memory;
  if (found->receiver) found->receiver->set_memory(memory);
}

void FirewireBus::send(const Client& client, const void* event, std::size_t bytes) {
  (void)!::send(client.peer, event, bytes, MSG_NOSIGNAL | MSG_DONTWAIT);
}

/// Does what the control block commands.
void FirewireBus::watch() {
  resets_seen_ = control_->bus_resets;
  for (;; std::this_thread::sleep_for(std::chrono::milliseconds(1))) {
    const bool described = control_->origin_us != 0;  // written last
    const bool wanted = described && control_->unplugged == 0 && control_->no_bus == 0;
    if (wanted != (plugged_ != nullptr)) wanted ? plug() : unplug();
    const std::int32_t resets = control_->bus_resets;
    if (resets != resets_seen_) reset();
    resets_seen_ = resets;
  }
}

void FirewireBus::plug() {
  auto plugged = std::make_shared<Plugged>(*control_);
  const std::scoped_lock lock(mutex_);
  plugged_ = std::move(plugged);
}

void FirewireBus::unplug() {
  const std::scoped_lock lock(mutex_);
  plugged_->camera.stop();
  plugged_ = nullptr;
  for (const auto& [descriptor, client] : clients_) {
    if (client->node != kCamera) continue;
    client->gone = true;
    if (client->receiver) client->receiver->abandon();
    ::shutdown(client->peer, SHUT_RDWR);
  }
}

void FirewireBus::reset() {
  if (control_->reset_stops != 0 && plugged_) plugged_->camera.stop();
  fw_cdev_event_bus_reset event{};
  event.type = FW_CDEV_EVENT_BUS_RESET;
  event.generation = ++generation_;
  event.local_node_id = 0xFFC0;
  const std::scoped_lock lock(mutex_);
  for (const auto& [descriptor, client] : clients_) {
    event.node_id = 0xFFC0U | static_cast<std::uint32_t>(client->node);
    send(*client, &event, sizeof event);
  }
}

int FirewireBus::ioctl(int descriptor, unsigned long request, void* argument) {
  const auto found = client(descriptor);
  if (!found) return fail(EBADF);
  if (found->gone) return fail(ENODEV);
  switch (request) {
    case FW_CDEV_IOC_GET_INFO:
      return get_info(*found, argument);
    case FW_CDEV_IOC_SEND_REQUEST:
      return send_request(*found, argument);
    case FW_CDEV_IOC_ALLOCATE_ISO_RESOURCE:
      return allocate(*found, argument);
    case FW_CDEV_IOC_DEALLOCATE_ISO_RESOURCE:
      return deallocate(*found, argument);
    case FW_CDEV_IOC_CREATE_ISO_CONTEXT:
      return create_context(found, argument);
    case FW_CDEV_IOC_QUEUE_ISO:
      return queue(*found, argument);
    case FW_CDEV_IOC_START_ISO:
      if (found->receiver) found->receiver->start();
      return 0;
    case FW_CDEV_IOC_STOP_ISO:
      if (found->receiver) found->receiver->stop();
      return 0;
    case FW_CDEV_IOC_GET_CYCLE_TIMER:
      return cycle_timer(argument);
    default:
      return fail(EINVAL);
  }
}

int FirewireBus::get_info(const Client& client, void* argument) const {
  auto& info = *static_cast<fw_cdev_get_info*>(argument);
  std::vector<std::uint32_t> rom(256, 0);
  const std::vector<std::uint32_t> host = {0x04040000, 0x31333934, 0xE064A002, 0x00001111,
                                           0x22223333, 0x00010000, 0x03000000};
  std::copy(host.begin(), host.end(), rom.begin());
  if (client.node == kCamera) rom = client.plugged->camera.rom();
  if (info.rom != 0)
    std::memcpy(reinterpret_cast<void*>(info.rom), rom.data(), std::min<std::size_t>(info.rom_length, 1024));
  info.rom_length = 1024;
  if (info.bus_reset != 0) {
    fw_cdev_event_bus_reset reset{};
    reset.type = FW_CDEV_EVENT_BUS_RESET;
    reset.node_id = 0xFFC0U | static_cast<std::uint32_t>(client.node);
    reset.local_node_id = 0xFFC0;
    reset.generation = generation_;
    std::memcpy(reinterpret_cast<void*>(info.bus_reset), &reset, sizeof reset);
  }
  info.version = 5;
  info.card = 0;
  return 0;
}

int FirewireBus::send_request(const Client& client, void* argument) {
  const auto& request = *static_cast<fw_cdev_send_request*>(argument);
  while (control_->requests_hang != 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  if (client.node != kCamera) return fail(EINVAL);
  const std::uint32_t quadlets = request.length / 4;
  std::vector<std::uint32_t> answer(quadlets, 0);
  std::uint32_t code = request.generation == generation_ ? RCODE_COMPLETE : RCODE_GENERATION;
  for (std::uint32_t i = 0; i < quadlets && code == RCODE_COMPLETE; ++i) {
    const std::uint64_t offset = request.offset - kRegisterSpace + 4 * i;
    if (is_read(request.tcode)) {
      const auto value = client.plugged->camera.read(offset);
      if (!value) code = RCODE_ADDRESS_ERROR;
      answer[i] = htonl(value.value_or(0));
    } else {
      std::uint32_t value = 0;
      std::memcpy(&value, reinterpret_cast<const char*>(request.data) + 4 * i, 4);
      if (!client.plugged->camera.write(offset, ntohl(value))) code = RCODE_ADDRESS_ERROR;
    }
  }
  constexpr std::size_t kBefore = offsetof(fw_cdev_event_response, data);
  fw_cdev_event_response head{};
  head.closure = request.closure;
  head.type = FW_CDEV_EVENT_RESPONSE;
  head.rcode = code;
  head.length = is_read(request.tcode) && code == RCODE_COMPLETE ? request.length : 0;
  std::vector<std::uint8_t> event(kBefore + head.length);
  std::memcpy(event.data(), &head, kBefore);
  std::memcpy(event.data() + kBefore, answer.data(), head.length);
  send(client, event.data(), event.size());
  return 0;
}

int FirewireBus::allocate(Client& client, void* argument) {
  auto& request = *static_cast<fw_cdev_allocate_iso_resource*>(argument);
  constexpr std::uint32_t kAllBandwidth = 4915;
  request.handle = 0;
  while (client.resources.contains(request.handle)) ++request.handle;
  client.resources[request.handle] = request.closure;
  const bool none = control_->bandwidth_taken != 0 || request.bandwidth > kAllBandwidth;
  fw_cdev_event_iso_resource event{};
  event.closure = request.closure;
  event.type = FW_CDEV_EVENT_ISO_RESOURCE_ALLOCATED;
  event.handle = request.handle;
  event.channel = request.channels == 0 || none ? -1 : __builtin_ctzll(request.channels);
  event.bandwidth = none ? 0 : static_cast<std::int32_t>(request.bandwidth);
  send(client, &event, sizeof event);
  return 0;
}

int FirewireBus::deallocate(Client& client, void* argument) {
  const auto& request = *static_cast<fw_cdev_deallocate*>(argument);
  const auto found = client.resources.find(request.handle);
  if (found == client.resources.end()) return fail(EINVAL);
  fw_cdev_event_iso_resource event{};
  event.closure = found->second;
  event.type = FW_CDEV_EVENT_ISO_RESOURCE_DEALLOCATED;
  event.handle = request.handle;
  send(client, &event, sizeof event);
  client.resources.erase(found);
  return 0;
}

int FirewireBus::create_context(const std::shared_ptr<Client>& client, void* argument) {
  auto& request = *static_cast<fw_cdev_create_iso_context*>(argument);
  if (client->receiver || client->node != kCamera) return fail(EBUSY);
  client->receiver = std::make_unique<IsoReceiver>(
      client->plugged->scene, client->plugged->camera, *control_, static_cast<int>(request.channel),
      static_cast<int>(request.header_size), [peer = client->peer](std::span<const std::uint8_t> event) {
        (void)!::send(peer, event.data(), event.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
      });
  client->receiver->set_memory(client->memory);
  request.handle = 0;
  return 0;
}

int FirewireBus::queue(Client& client, void* argument) {
  const auto& request = *static_cast<fw_cdev_queue_iso*>(argument);
  if (!client.receiver) return fail(EINVAL);
  const auto* packets = reinterpret_cast<const std::uint32_t*>(request.packets);
  client.receiver->queue(request.data, {packets, packets + request.size / sizeof *packets});
  return 0;
}

int FirewireBus::cycle_timer(void* argument) const {
  auto& timer = *static_cast<fw_cdev_get_cycle_timer*>(argument);
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  timer.local_time =
      static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::microseconds>(now).count());
  timer.cycle_timer = cycle_time(bus_monotonic_us(), control_->clock_ppm);
  return 0;
}

}  // namespace floornav
