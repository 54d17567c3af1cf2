#pragma once

#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace floornav {

/// A whole file, mapped to be read.
class MappedFile {
 public:
  /// Throws std::runtime_error for a file that is not there or has fewer bytes than `least`.
  MappedFile(const char* path, std::size_t least) {
    const int file = ::open(path, O_RDONLY | O_CLOEXEC);
    struct stat status {};
    if (file < 0 || ::fstat(file, &status) != 0)
      throw std::runtime_error(std::string(path) + ": no scene file");
    bytes_ = static_cast<std::size_t>(status.st_size);
    memory_ = bytes_ < least ? MAP_FAILED : ::mmap(nullptr, bytes_, PROT_READ, MAP_SHARED, file, 0);
    ::close(file);
    if (memory_ == MAP_FAILED) throw std::runtime_error(std::string(path) + ": not a scene file");
  }
  ~MappedFile() { ::munmap(memory_, bytes_); }
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  [[nodiscard]] std::span<const std::byte> bytes() const {
    return {static_cast<const std::byte*>(memory_), bytes_};
  }

 private:
  void* memory_ = nullptr;
  std::size_t bytes_ = 0;
};

}  // namespace floornav
