#pragma once

#include <cstddef>

namespace floornav {

/// What a map message may take at most, so that one lost datagram costs little.
inline constexpr std::size_t kMapMessageBytes = 60'000;

/// Counts the bytes of a message that is filled part by part.
class MessageSize {
 public:
  /// `without_parts`: encoded size of the message without parts and without its sender's name.
  explicit MessageSize(std::size_t without_parts) : empty_(without_parts + kRoomForSource), size_(empty_) {}

  /// Counts one more part; true where it must go into a new message.
  bool needs_new_message(std::size_t part) {
    const bool full = size_ + part > kMapMessageBytes;
    size_ = (full ? empty_ : size_) + part;
    return full;
  }

 private:
  static constexpr std::size_t kRoomForSource = 256;
  std::size_t empty_;
  std::size_t size_;
};

}  // namespace floornav
