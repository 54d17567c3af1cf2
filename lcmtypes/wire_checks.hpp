#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

/// What the generated messages check before they trust a count or a length; harden.py puts the calls in.
namespace floornav::wire {

/// True where counts[0] x counts[1] x ... elements of at least `least_bytes` each can stand in `bytes_left`.
/// Rows without columns are refused: they take no bytes, so nothing would bound how many rows a message can
/// claim.
constexpr bool array_fits(std::initializer_list<std::int64_t> counts, std::int64_t least_bytes,
                          std::int64_t bytes_left) {
  for (const std::int64_t count : counts)
    if (count < 0) return false;
  if (*counts.begin() == 0) return true;
  std::int64_t room = bytes_left < 0 ? 0 : bytes_left / least_bytes;
  for (const std::int64_t count : counts) {
    if (count == 0 || count > room) return false;
    room /= count;
  }
  return true;
}

/// True where the `length` bytes at `text` lie within `bytes_left` and end with their only NUL.
inline bool is_string(const char* text, std::int64_t length, std::int64_t bytes_left) {
  if (length < 1 || length > bytes_left) return false;
  return std::memchr(text, 0, static_cast<std::size_t>(length)) == text + length - 1;
}

/// True where the vector has `size` elements, each a vector of the next size, and so on.
template <class T, class... Sizes>
bool has_sizes(const std::vector<T>& array, std::int64_t size, Sizes... inner) {
  if (static_cast<std::int64_t>(array.size()) != size) return false;
  if constexpr (sizeof...(inner) > 0)
    for (const T& row : array)
      if (!has_sizes(row, inner...)) return false;
  return true;
}

/// Bytes of a member on the wire, by what it holds whatever its count says.
template <class T>
std::int64_t size_of(const T& member) {
  if constexpr (std::is_arithmetic_v<T>)
    return static_cast<std::int64_t>(sizeof(T));
  else
    return member._getEncodedSizeNoHash();
}
inline std::int64_t size_of(const std::string& text) {
  return static_cast<std::int64_t>(text.size()) + 5;
}
template <class T, std::size_t N>
std::int64_t size_of(const T (&array)[N]);
template <class T>
std::int64_t size_of(const std::vector<T>& array) {
  if constexpr (std::is_arithmetic_v<T>) {
    return static_cast<std::int64_t>(array.size() * sizeof(T));
  } else {
    std::int64_t sum = 0;
    for (const T& element : array) sum += size_of(element);
    return sum;
  }
}
template <class T, std::size_t N>
std::int64_t size_of(const T (&array)[N]) {
  std::int64_t sum = 0;
  for (const T& element : array) sum += size_of(element);
  return sum;
}

/// Bytes of all members, saturating: what is too big for lcm's interface does not encode either. 8 bytes are
/// left for the fingerprint.
template <class... Members>
int total_size(const Members&... members) {
  constexpr std::int64_t kMost = std::numeric_limits<int>::max() - 8;
  return static_cast<int>(std::min(kMost, (size_of(members) + ...)));
}

}  // namespace floornav::wire
