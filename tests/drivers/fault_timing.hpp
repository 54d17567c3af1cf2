#pragma once

#include <chrono>

namespace floornav {

/// Whether FLOORNAV_LONG asks for the long forms, on a machine that does nothing else.
bool long_form();

double ms_since(std::chrono::steady_clock::time_point start);

/// Prints what a fault took. In the long form a test fails where that is more than the driver's README
/// promises.
void measured(const char* what, double ms, double promised_ms);

}  // namespace floornav
