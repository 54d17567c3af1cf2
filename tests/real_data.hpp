#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace floornav {

/// A folder of recordings that the project did not make: $FLOORNAV_DATA/name, by default ../shared/data/name
/// from the project's root. It may be absent: the test then says so and is skipped.
inline std::filesystem::path real_data(const std::string& name) {
  const char* const data = std::getenv("FLOORNAV_DATA");
  const std::filesystem::path root = data != nullptr
                                         ? std::filesystem::path(data)
                                         : std::filesystem::path(FLOORNAV_SOURCE_DIR) / "../shared/data";
  return root / name;
}

}  // namespace floornav
