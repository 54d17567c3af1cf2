#include "runtime/process/lcm_transport.hpp"

#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include <arpa/inet.h>
#include <fmt/format.h>
#include <lcm/lcm.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace floornav {
namespace {

// Enough for the parts of a frame; the bus thread does nothing but empty it.
constexpr int kQueueCapacity = 128;

bool starts_with(const std::string& text, const char* prefix) {
  return text.rfind(prefix, 0) == 0;
}

/// The address of "udpm://ADDRESS:PORT?options"; LCM's own defaults stand for what is left out.
sockaddr_in multicast_address(const std::string& url) {
  std::string place = url.substr(std::strlen("udpm://"));
  place = place.substr(0, place.find('?'));
  const std::size_t colon = place.find(':');
  std::string host = place.substr(0, colon);
  if (host.empty()) host = "239.255.76.67";
  unsigned port = 7667;
  if (colon != std::string::npos) {
    const char* end = place.data() + place.size();
    const auto [stop, error] = std::from_chars(place.data() + colon + 1, end, port);
    if (error != std::errc() || stop != end || port < 1 || port > 65535)
      throw TransportError(fmt::format("{}: the port must be 1 .. 65535", url));
  }
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  if (inet_pton(AF_INET, host.c_str(), &address.sin_addr) != 1 ||
      !IN_MULTICAST(ntohl(address.sin_addr.s_addr)))
    throw TransportError(
        fmt::format("{}: '{}' is not a multicast address (224.0.0.0 .. 239.255.255.255)", url, host));
  return address;
}

void check_multicast(const std::string& url) {
  const sockaddr_in address = multicast_address(url);
  const int descriptor = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (descriptor < 0) throw TransportError(fmt::format("{}: no socket: {}", url, std::strerror(errno)));
  const int result = ::connect(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address);
  const int error = errno;
  ::close(descriptor);
  if (result == 0) return;
  if (error == ENETUNREACH)
    throw TransportError(
        fmt::format("{}: no multicast route; as root: ip link set lo multicast on && "
                    "ip route add 224.0.0.0/4 dev lo",
                    url));
  throw TransportError(fmt::format("{}: {}", url, std::strerror(error)));
}

void check_url(const std::string& url) {
  if (starts_with(url, "udpm://")) return check_multicast(url);
  if (!starts_with(url, "tcpq://") && !starts_with(url, "memq://"))
    throw TransportError(
        fmt::format("'{}' is not an LCM URL: udpm://ADDRESS:PORT?ttl=0, tcpq://HOST:PORT", url));
}

void on_message(const lcm_recv_buf_t* buffer, const char* channel, void* receiver) {
  const auto* const* current = static_cast<const Transport::Receiver* const*>(receiver);
  (**current)(channel, {static_cast<const std::uint8_t*>(buffer->data), buffer->data_size});
}

}  // namespace

std::string lcm_url(const std::string& given) {
  if (!given.empty()) return given;
  const char* environment = std::getenv("LCM_DEFAULT_URL");
  return environment != nullptr && *environment != '\0' ? environment : kDefaultLcmUrl;
}

std::optional<std::string> receive_buffer_warning(const std::string& url) {
  const std::string key = "recv_buf_size=";
  const std::size_t place = url.find(key);
  if (!starts_with(url, "udpm://") || place == std::string::npos) return std::nullopt;
  const long asked = std::strtol(url.c_str() + place + key.size(), nullptr, 10);
  long granted = 0;
  std::ifstream limit("/proc/sys/net/core/rmem_max");
  if (!(limit >> granted) || granted >= asked) return std::nullopt;
  return fmt::format(
      "the kernel allows a receive buffer of {} of the {} bytes asked for, large clouds will be lost; as "
      "root: "
      "sysctl -w net.core.rmem_max={} net.core.rmem_default={}",
      granted, asked, asked, asked);
}

void LcmTransport::Destroyer::operator()(_lcm_t* lcm) const {
  lcm_destroy(lcm);
}

LcmTransport::LcmTransport(const std::string& url) {
  check_url(url);
  lcm_.reset(lcm_create(url.c_str()));
  if (!lcm_) throw TransportError(fmt::format("{}: no LCM bus there", url));
}

void LcmTransport::subscribe(const std::string& channel) {
  lcm_subscription_t* subscription = lcm_subscribe(lcm_.get(), channel.c_str(), on_message, &receiver_);
  if (subscription == nullptr) throw TransportError(fmt::format("cannot subscribe to {}", channel));
  lcm_subscription_set_queue_capacity(subscription, kQueueCapacity);
}

bool LcmTransport::publish(const EncodedMessage& message) {
  const auto size = static_cast<unsigned>(message.bytes.size());
  return lcm_publish(lcm_.get(), message.channel.c_str(), message.bytes.data(), size) == 0;
}

void LcmTransport::receive(std::chrono::milliseconds timeout, const Receiver& receiver) {
  receiver_ = &receiver;
  int handled = lcm_handle_timeout(lcm_.get(), static_cast<int>(timeout.count()));
  while (handled > 0) handled = lcm_handle_timeout(lcm_.get(), 0);
  receiver_ = nullptr;
  if (handled < 0) throw TransportError("the connection to the LCM bus is lost");
}

}  // namespace floornav
