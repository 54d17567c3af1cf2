#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "runtime/process/transport.hpp"

namespace floornav {

class HubTransport;

/// A bus within the test's process.
class Hub {
 public:
  void join(HubTransport& endpoint);
  void leave(HubTransport& endpoint);
  void publish(const EncodedMessage& message);

 private:
  std::mutex mutex_;
  std::set<HubTransport*> endpoints_;
};

class HubTransport final : public Transport {
 public:
  explicit HubTransport(Hub& hub) : hub_(hub) { hub_.join(*this); }
  ~HubTransport() override { hub_.leave(*this); }
  HubTransport(const HubTransport&) = delete;
  HubTransport& operator=(const HubTransport&) = delete;

  void subscribe(const std::string& channel) override {
    const std::lock_guard lock(mutex_);
    channels_.insert(channel);
  }
  bool publish(const EncodedMessage& message) override {
    hub_.publish(message);
    return true;
  }
  void receive(std::chrono::milliseconds timeout, const Receiver& receiver) override {
    std::deque<EncodedMessage> messages;
    listening_ = true;
    {
      std::unique_lock lock(mutex_);
      arrived_.wait_for(lock, timeout, [this] { return !queue_.empty(); });
      messages.swap(queue_);
    }
    for (const EncodedMessage& message : messages) receiver(message.channel, message.bytes);
  }
  /// Returns once somebody is in receive(): nothing that is published from then on is missed.
  void wait_until_listening() const {
    while (!listening_) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  void put(const EncodedMessage& message) {
    const std::lock_guard lock(mutex_);
    if (!channels_.contains(message.channel)) return;
    queue_.push_back(message);
    arrived_.notify_one();
  }

 private:
  Hub& hub_;
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::set<std::string> channels_;
  std::deque<EncodedMessage> queue_;
  std::atomic<bool> listening_ = false;
};

inline void Hub::join(HubTransport& endpoint) {
  const std::lock_guard lock(mutex_);
  endpoints_.insert(&endpoint);
}
inline void Hub::leave(HubTransport& endpoint) {
  const std::lock_guard lock(mutex_);
  endpoints_.erase(&endpoint);
}
inline void Hub::publish(const EncodedMessage& message) {
  const std::lock_guard lock(mutex_);
  for (HubTransport* endpoint : endpoints_) endpoint->put(message);
}

/// Listens on some channels and decodes what comes, for as long as a test is ready to wait.
template <class Message>
class Listener {
 public:
  Listener(Hub& hub, const std::string& channel) : transport_(hub) { transport_.subscribe(channel); }

  /// True as soon as a message satisfies `wanted`; all that came are in `all`.
  template <class Predicate>
  bool wait_for(Predicate wanted, std::chrono::seconds patience = std::chrono::seconds(20)) {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (std::chrono::steady_clock::now() < end) {
      for (; looked_ < all.size(); ++looked_) {
        if (wanted(all[looked_])) return ++looked_, true;
      }
      transport_.receive(std::chrono::milliseconds(20),
                         [this](std::string_view, std::span<const std::uint8_t> bytes) {
                           Message message;
                           if (message.decode(bytes.data(), 0, static_cast<int>(bytes.size())) > 0)
                             all.push_back(message);
                         });
    }
    return false;
  }
  bool wait_for_any() {
    return wait_for([](const Message&) { return true; });
  }

  std::vector<Message> all;

 private:
  HubTransport transport_;
  std::size_t looked_ = 0;
};

}  // namespace floornav
