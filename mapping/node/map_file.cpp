#include "mapping/node/map_file.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

namespace floornav {
namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
  throw std::runtime_error(file.string() + ": " + what);
}

/// A file descriptor that is closed at the end.
class OpenFile {
 public:
  OpenFile(const std::filesystem::path& file, int flags)
      : file_(file), descriptor_(::open(file.c_str(), flags | O_CLOEXEC, 0644)) {
    if (descriptor_ < 0) fail(file_, std::strerror(errno));
  }
  ~OpenFile() { ::close(descriptor_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  void write(const std::vector<std::uint8_t>& bytes) {
    for (std::size_t done = 0; done < bytes.size();) {
      const ssize_t written = ::write(descriptor_, bytes.data() + done, bytes.size() - done);
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail(file_, std::strerror(errno));
      done += static_cast<std::size_t>(written);
    }
  }
  void to_disk() {
    if (::fsync(descriptor_) != 0) fail(file_, std::strerror(errno));
  }

 private:
  std::filesystem::path file_;
  int descriptor_;
};

}  // namespace

void save_map(const MapMemory& memory, const std::filesystem::path& file) {
  const std::filesystem::path beside = file.string() + ".new";
  {
    OpenFile out(beside, O_WRONLY | O_CREAT | O_TRUNC);
    out.write(to_bytes(memory));
    out.to_disk();
  }
  std::error_code error;
  std::filesystem::rename(beside, file, error);
  if (error) fail(file, error.message());
  const std::filesystem::path folder =
      file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  OpenFile(folder, O_RDONLY | O_DIRECTORY).to_disk();
}

MapMemory load_map(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file)) fail(file, "cannot be read");
  const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  try {
    return memory_from_bytes(bytes);
  } catch (const std::invalid_argument& error) {
    fail(file, error.what());
  }
}

}  // namespace floornav
