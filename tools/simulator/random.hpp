#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>

namespace floornav {

/// A key for one stream of random numbers out of what identifies it (seed, frame, row, purpose).
std::uint64_t random_key(std::initializer_list<std::uint64_t> parts);

/// Number `index` of the stream `key`: 64 random bits, whatever was asked before.
std::uint64_t random_bits(std::uint64_t key, std::uint64_t index);

/// Fills `out` with independent numbers of the standard normal distribution: the same bits on every machine.
void fill_normals(std::uint64_t key, std::span<float> out);

/// Fills `out` with independent numbers uniform in [0, 1).
void fill_uniforms(std::uint64_t key, std::span<float> out);

/// One number after the other, for what is drawn once in a while.
class RandomStream {
 public:
  explicit RandomStream(std::uint64_t key) : key_(key) {}
  /// In [0, 1).
  double uniform();
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// In [0, count).
  int below(int count) { return static_cast<int>(uniform() * count); }
  double normal();

 private:
  std::uint64_t key_;
  std::uint64_t next_ = 0;
};

}  // namespace floornav
