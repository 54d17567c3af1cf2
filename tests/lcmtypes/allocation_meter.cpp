#include "allocation_meter.hpp"

#include <atomic>
#include <cstdlib>
#include <new>
#include <utility>

namespace {
std::atomic<std::size_t> allocated_bytes{0};
}

std::size_t floornav::take_allocated_bytes() {
  return allocated_bytes.exchange(0);
}

// Replaces the program's allocation by one that counts.
void* operator new(std::size_t size) {
  allocated_bytes += size;
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
