#include "tools/replay/text_file.hpp"

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include <fmt/format.h>

namespace floornav {

namespace {

[[noreturn]] void fail(const std::string& name) {
  throw std::runtime_error(fmt::format("{}: {}", name, std::strerror(errno)));
}

}  // namespace

TextFile::TextFile(const std::filesystem::path& file)
    : name_(file.string()), file_(std::fopen(file.c_str(), "wbe")) {
  if (!file_) fail(name_);
}

void TextFile::write(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) fail(name_);
}

void TextFile::close() {
  if (std::fclose(file_.release()) != 0) fail(name_);
}

}  // namespace floornav
