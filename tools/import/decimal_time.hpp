#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace floornav {

/// Microseconds from decimal seconds such as "1305031229.528784", digit by digit, so that nothing is lost in
/// a double. A seventh digit rounds. Nothing where the text is not such a number or does not fit.
std::optional<std::int64_t> utime_from_seconds(std::string_view text);

}  // namespace floornav
