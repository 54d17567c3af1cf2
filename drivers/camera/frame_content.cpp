#include "drivers/camera/frame_content.hpp"

#include <array>
#include <cstring>

namespace floornav {
namespace {

/// FNV-1a on eight words side by side, so that their multiplications overlap.
std::uint64_t fingerprint(std::span<const std::uint16_t> pixels) {
  constexpr std::size_t kLanes = 8;
  constexpr std::uint64_t kPrime = 0x100000001B3;
  std::array<std::uint64_t, kLanes> lanes;
  for (std::size_t lane = 0; lane < kLanes; ++lane) lanes[lane] = 0xCBF29CE484222325 + lane;
  const auto* bytes = reinterpret_cast<const unsigned char*>(pixels.data());
  const std::size_t size = pixels.size_bytes();
  std::size_t at = 0;
  for (; at + sizeof lanes <= size; at += sizeof lanes) {
    std::array<std::uint64_t, kLanes> words;
    std::memcpy(words.data(), bytes + at, sizeof words);
    for (std::size_t lane = 0; lane < kLanes; ++lane) lanes[lane] = (lanes[lane] ^ words[lane]) * kPrime;
  }
  std::uint64_t all = 0;
  for (const std::uint64_t lane : lanes) all = (all ^ lane ^ lane >> 32) * kPrime;
  for (; at < size; ++at) all = (all ^ bytes[at]) * kPrime;
  return all;
}

std::size_t count_valid(std::span<const std::uint16_t> pixels) {
  std::size_t valid = 0;
  for (const std::uint16_t pixel : pixels) valid += pixel != 0 ? 1 : 0;
  return valid;
}

}  // namespace

FrameContent::Verdict FrameContent::look_at(std::span<const std::uint16_t> pixels) {
  const std::size_t valid = count_valid(pixels);
  const std::uint64_t print = fingerprint(pixels);
  equal_ = print == last_fingerprint_ ? equal_ + 1 : 1;
  last_fingerprint_ = print;
  if (valid == 0) return Verdict::kEmpty;
  if (stuck_after_ > 0 && equal_ >= stuck_after_) return Verdict::kStuck;
  const double share = static_cast<double>(valid) / static_cast<double>(pixels.size());
  return share < least_valid_ ? Verdict::kSparse : Verdict::kGood;
}

}  // namespace floornav
