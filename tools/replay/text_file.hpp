#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

namespace floornav {

/// A text file that is written line by line.
class TextFile {
 public:
  /// Throws std::runtime_error where it cannot be made.
  explicit TextFile(const std::filesystem::path& file);
  void write(const std::string& text);
  /// Throws std::runtime_error where it did not all reach the disk.
  void close();

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::string name_;
  std::unique_ptr<std::FILE, Closer> file_;
};

}  // namespace floornav
