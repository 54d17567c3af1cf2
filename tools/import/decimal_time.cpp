#include "tools/import/decimal_time.hpp"

#include <algorithm>

namespace floornav {

namespace {

constexpr std::size_t kMaxWholeDigits = 12;  // 30,000 years
constexpr std::size_t kFractionDigits = 6;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

}  // namespace

std::optional<std::int64_t> utime_from_seconds(std::string_view text) {
  const std::size_t point = std::min(text.find('.'), text.size());
  const std::string_view whole = text.substr(0, point);
  const std::string_view fraction = point < text.size() ? text.substr(point + 1) : std::string_view{};
  if (whole.empty() || whole.size() > kMaxWholeDigits) return std::nullopt;
  if (!std::ranges::all_of(whole, is_digit) || !std::ranges::all_of(fraction, is_digit)) return std::nullopt;

  std::int64_t utime_us = 0;
  for (const char digit : whole) utime_us = utime_us * 10 + (digit - '0');
  for (std::size_t i = 0; i < kFractionDigits; ++i)
    utime_us = utime_us * 10 + (i < fraction.size() ? fraction[i] - '0' : 0);
  if (fraction.size() > kFractionDigits && fraction[kFractionDigits] >= '5') ++utime_us;
  return utime_us;
}

}  // namespace floornav
