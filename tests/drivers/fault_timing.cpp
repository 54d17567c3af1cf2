#include "tests/drivers/fault_timing.hpp"

#include <cstdlib>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace floornav {

bool long_form() {
  return std::getenv("FLOORNAV_LONG") != nullptr;
}

double ms_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

void measured(const char* what, double ms, double promised_ms) {
  fmt::print("[ MEASURED ] {}: {:.0f} ms\n", what, ms);
  EXPECT_TRUE(ms < promised_ms || !long_form()) << what << " takes " << ms << " ms";
}

}  // namespace floornav
