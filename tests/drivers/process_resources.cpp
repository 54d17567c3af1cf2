#include "tests/drivers/process_resources.hpp"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <thread>

#include <dirent.h>

namespace floornav {
namespace {

int entries(const char* folder) {
  int count = 0;
  DIR* open = ::opendir(folder);
  while (::readdir(open) != nullptr) ++count;
  ::closedir(open);
  return count;
}

}  // namespace

ProcessResources ProcessResources::now() {
  constexpr long kPage_kb = 4;
  long pages = 0;
  std::ifstream("/proc/self/statm") >> pages >> pages;
  return {pages * kPage_kb, entries("/proc/self/task"), entries("/proc/self/fd")};
}

ProcessResources ProcessResources::settled(const ProcessResources& before) {
  using std::chrono::steady_clock;
  const auto deadline = steady_clock::now() + std::chrono::seconds(5);
  ProcessResources found = now();
  while ((found.threads > before.threads || found.descriptors > before.descriptors) &&
         steady_clock::now() < deadline) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    found = now();
  }
  return found;
}

ProcessResources most_of(const ProcessResources& a, const ProcessResources& b) {
  return {std::max(a.resident_kb, b.resident_kb), std::max(a.threads, b.threads),
          std::max(a.descriptors, b.descriptors)};
}

}  // namespace floornav
