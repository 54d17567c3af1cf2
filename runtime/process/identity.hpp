#pragma once

#include <cstdint>
#include <string>

namespace floornav {

/// Who publishes. The executor gives it out: `session` is random live and derived from the name in replay.
struct Identity {
  std::string source;
  std::int64_t session = 0;
};

}  // namespace floornav
