#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "runtime/process/transport.hpp"

struct _lcm_t;

namespace floornav {

/// One line that says why the bus does not work and what to do about it.
class TransportError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The multicast bus of this host: never leaves it, with room for bursts of large clouds.
inline constexpr const char* kDefaultLcmUrl = "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4194304";

/// `given` where it is not empty, else the environment's LCM_DEFAULT_URL, else kDefaultLcmUrl.
std::string lcm_url(const std::string& given);

/// Where the kernel grants less than the `recv_buf_size` of a udpm URL: one line that says how to allow it.
std::optional<std::string> receive_buffer_warning(const std::string& url);

/// Any LCM bus: udpm://, tcpq:// and, within a process, memq://.
class LcmTransport final : public Transport {
 public:
  /// Throws TransportError for a URL that LCM does not take and for a host without a multicast route.
  explicit LcmTransport(const std::string& url);

  void subscribe(const std::string& channel) override;
  bool publish(const EncodedMessage& message) override;
  void receive(std::chrono::milliseconds timeout, const Receiver& receiver) override;

 private:
  struct Destroyer {
    void operator()(_lcm_t* lcm) const;
  };
  std::unique_ptr<_lcm_t, Destroyer> lcm_;
  const Receiver* receiver_ = nullptr;  ///< during receive()
};

}  // namespace floornav
