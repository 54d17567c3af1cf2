#pragma once

// Driver/OniDriverAPI.h takes these two from a header that libopenni2-dev does not bring.
#define XN_NEW(Type, ...) new Type(__VA_ARGS__)
#define XN_DELETE(pointer) delete (pointer)
#include <cstring>

#include <Driver/OniDriverAPI.h>

namespace floornav {

/// Answers a getProperty call.
template <class Value>
OniStatus answer(const Value& value, void* data, int* size) {
  if (*size < static_cast<int>(sizeof value)) return ONI_STATUS_BAD_PARAMETER;
  std::memcpy(data, &value, sizeof value);
  *size = sizeof value;
  return ONI_STATUS_OK;
}

/// Takes the value of a setProperty call.
template <class Value>
OniStatus take(Value& value, const void* data, int size) {
  if (size != static_cast<int>(sizeof value)) return ONI_STATUS_BAD_PARAMETER;
  std::memcpy(&value, data, sizeof value);
  return ONI_STATUS_OK;
}

}  // namespace floornav
