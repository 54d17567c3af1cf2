#pragma once

#include <cstdint>
#include <span>

namespace floornav {

/// Looks whether an image can be a measurement at all.
class FrameContent {
 public:
  enum class Verdict {
    kGood,
    kSparse,  ///< few pixels measure anything
    kEmpty,   ///< no pixel does
    kStuck,   ///< the same image again and again: a camera's noise never repeats
  };

  /// `least_valid`: share of pixels under which a frame is sparse. `stuck_after`: so many equal images in a
  /// row are stuck, from the last of them on; 0: never.
  FrameContent(double least_valid, int stuck_after) : least_valid_(least_valid), stuck_after_(stuck_after) {}

  /// Pixels of 0 measure nothing.
  Verdict look_at(std::span<const std::uint16_t> pixels);

 private:
  double least_valid_;
  int stuck_after_;
  std::uint64_t last_fingerprint_ = 0;
  int equal_ = 0;  ///< images in a row that equal the last one, itself included
};

}  // namespace floornav
