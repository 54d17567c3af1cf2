#include "runtime/process/identity.hpp"

#include <random>

#include "runtime/process/settings_writer.hpp"

namespace floornav {

Identity random_identity(const std::string& source) {
  std::random_device random;
  std::uniform_int_distribution<std::int64_t> any(1);
  return {source, any(random)};
}

Identity fixed_identity(const std::string& source) {
  const std::int64_t session = hash_of(source);
  return {source, session == 0 ? 1 : session};
}

}  // namespace floornav
