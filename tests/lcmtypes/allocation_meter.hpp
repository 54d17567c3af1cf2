#pragma once

#include <cstddef>

namespace floornav {

/// The bytes that this program asked operator new for since the last call.
std::size_t take_allocated_bytes();

}  // namespace floornav
