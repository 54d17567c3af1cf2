// The calls of libc that libdc1394 makes to the kernel's FireWire devices. A program that is linked with this
// library, or started with it in LD_PRELOAD, finds the virtual bus there; every other file is libc's.
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <map>
#include <mutex>

#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include "tests/devices/firewire/bus/bus.hpp"

namespace {

using floornav::FirewireBus;

template <class Function>
Function libc(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

/// The node of a path like /dev/fw1; -1 for others.
int node_of(const char* path) {
  constexpr const char* kDevices = "/dev/fw";
  if (path == nullptr || std::strncmp(path, kDevices, 7) != 0) return -1;
  return path[7] >= '0' && path[7] <= '9' && path[8] == '\0' ? path[7] - '0' : -1;
}

/// Folders that list /dev, with the number of nodes that were shown of each.
struct Listings {
  std::mutex mutex;
  std::map<DIR*, int> shown;
};

Listings& listings() {
  static auto* const all = new Listings;
  return *all;
}

int open_node(const char* path) {
  FirewireBus* const bus = FirewireBus::of_process();
  if (bus != nullptr) return bus->open(node_of(path));
  errno = ENOENT;
  return -1;
}

/// The bus, where a descriptor is one of its.
FirewireBus* bus_of(int descriptor) {
  FirewireBus* const bus = descriptor < 0 ? nullptr : FirewireBus::of_process();
  return bus != nullptr && bus->owns(descriptor) ? bus : nullptr;
}

}  // namespace

extern "C" {

DIR* opendir(const char* name) {
  static const auto real = libc<DIR* (*)(const char*)>("opendir");
  DIR* const folder = real(name);
  if (folder != nullptr && std::strcmp(name, "/dev") == 0 && FirewireBus::of_process() != nullptr) {
    const std::scoped_lock lock(listings().mutex);
    listings().shown[folder] = 0;
  }
  return folder;
}

dirent* readdir(DIR* folder) {
  static const auto real = libc<dirent* (*)(DIR*)>("readdir");
  if (dirent* const entry = real(folder)) return entry;
  const std::scoped_lock lock(listings().mutex);
  const auto found = listings().shown.find(folder);
  if (found == listings().shown.end() || found->second >= FirewireBus::of_process()->nodes()) return nullptr;
  static thread_local dirent entry;
  entry = {};
  entry.d_type = DT_CHR;
  std::snprintf(entry.d_name, sizeof entry.d_name, "fw%d", found->second++);
  return &entry;
}

int closedir(DIR* folder) {
  static const auto real = libc<int (*)(DIR*)>("closedir");
  {
    const std::scoped_lock lock(listings().mutex);
    listings().shown.erase(folder);
  }
  return real(folder);
}

int open(const char* path, int flags, ...) {
  if (node_of(path) >= 0) return open_node(path);
  va_list arguments;
  va_start(arguments, flags);
  const auto mode = va_arg(arguments, mode_t);
  va_end(arguments);
  static const auto real = libc<int (*)(const char*, int, ...)>("open");
  return real(path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  if (node_of(path) >= 0) return open_node(path);
  va_list arguments;
  va_start(arguments, flags);
  const auto mode = va_arg(arguments, mode_t);
  va_end(arguments);
  static const auto real = libc<int (*)(const char*, int, ...)>("open64");
  return real(path, flags, mode);
}

int close(int descriptor) {
  static const auto real = libc<int (*)(int)>("close");
  if (FirewireBus* const bus = bus_of(descriptor)) bus->close(descriptor);
  return real(descriptor);
}

int ioctl(int descriptor, unsigned long request, ...) {
  va_list arguments;
  va_start(arguments, request);
  void* const argument = va_arg(arguments, void*);
  va_end(arguments);
  if (FirewireBus* const bus = bus_of(descriptor)) return bus->ioctl(descriptor, request, argument);
  static const auto real = libc<int (*)(int, unsigned long, ...)>("ioctl");
  return real(descriptor, request, argument);
}

ssize_t read(int descriptor, void* buffer, size_t bytes) {
  static const auto real = libc<ssize_t (*)(int, void*, size_t)>("read");
  const ssize_t got = real(descriptor, buffer, bytes);
  if (got != 0) return got;
  FirewireBus* const bus = bus_of(descriptor);
  if (bus == nullptr || !bus->gone(descriptor)) return got;
  errno = ENODEV;
  return -1;
}

void* mmap(void* address, size_t bytes, int protection, int flags, int descriptor, off_t offset) {
  static const auto real = libc<void* (*)(void*, size_t, int, int, int, off_t)>("mmap");
  FirewireBus* const bus = bus_of(descriptor);
  if (bus == nullptr) return real(address, bytes, protection, flags, descriptor, offset);
  void* const memory = real(address, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory != MAP_FAILED) bus->set_memory(descriptor, {static_cast<std::uint8_t*>(memory), bytes});
  return memory;
}

}  // extern "C"
