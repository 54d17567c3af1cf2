#pragma once

#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace floornav {

/// A struct in a file that processes share by mapping it. A new file is all zero.
template <class Block>
class SharedBlock {
 public:
  enum class How { kMake, kOpen };

  /// Throws std::runtime_error where there is no such file.
  SharedBlock(std::filesystem::path file, How how) : file_(std::move(file)) {
    const int flags = how == How::kMake ? O_RDWR | O_CREAT | O_CLOEXEC : O_RDWR | O_CLOEXEC;
    const int descriptor = ::open(file_.c_str(), flags, 0600);
    if (descriptor < 0 || (how == How::kMake && ::ftruncate(descriptor, sizeof(Block)) != 0))
      throw std::runtime_error(file_.string() + ": no control file");
    void* memory = ::mmap(nullptr, sizeof(Block), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
    ::close(descriptor);
    if (memory == MAP_FAILED) throw std::runtime_error(file_.string() + ": cannot be mapped");
    if (how == How::kMake) std::memset(memory, 0, sizeof(Block));  // who has it mapped keeps it
    block_ = static_cast<Block*>(memory);
  }
  ~SharedBlock() { ::munmap(block_, sizeof(Block)); }
  SharedBlock(const SharedBlock&) = delete;
  SharedBlock& operator=(const SharedBlock&) = delete;

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  Block* operator->() const { return block_; }
  Block& operator*() const { return *block_; }

 private:
  std::filesystem::path file_;
  Block* block_ = nullptr;
};

/// Puts an absolute path into a block's array of characters. Throws std::runtime_error where it is too long.
template <std::size_t kLength>
void store_path(const std::filesystem::path& path, char (&place)[kLength]) {
  const std::string text = std::filesystem::absolute(path).string();
  if (text.size() >= kLength) throw std::runtime_error(text + ": path too long");
  text.copy(place, text.size());
}

}  // namespace floornav
