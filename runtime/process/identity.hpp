#pragma once

#include <cstdint>
#include <string>

namespace floornav {

/// Who publishes. The executor gives it out: `session` is random live and derived from the name in replay.
struct Identity {
  std::string source;
  std::int64_t session = 0;
};

/// A session never used before. Never 0.
Identity random_identity(const std::string& source);

/// The same session for the same source every time. Never 0.
Identity fixed_identity(const std::string& source);

}  // namespace floornav
