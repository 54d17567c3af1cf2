#include "runtime/process/settings_writer.hpp"

#include <cmath>

namespace floornav {

std::string range_text(Allowed allowed) {
  const bool low = std::isfinite(allowed.min);
  const bool high = std::isfinite(allowed.max);
  if (low && high) return fmt::format("{} .. {}", allowed.min, allowed.max);
  if (low) return fmt::format(">= {}", allowed.min);
  if (high) return fmt::format("<= {}", allowed.max);
  return "any";
}

std::string SettingsWriter::quoted(const std::string& value) {
  std::string text = "\"";
  for (const char c : value) {
    if (c == '"' || c == '\\') text += '\\';
    text += c;
  }
  return text + '"';
}

void SettingsWriter::line(const char* key, const std::string& value, const std::string& comment) {
  std::string text = indent() + key + ": " + value;
  constexpr std::size_t kCommentColumn = 40;
  if (!comment.empty()) {
    text.resize(std::max(text.size() + 2, kCommentColumn), ' ');
    text += "# " + comment;
  }
  text_ += text + "\n";
}

std::int64_t hash_of(const std::string& text) {
  std::uint64_t hash = 0xCBF29CE484222325ULL;
  for (const char c : text) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001B3ULL;
  }
  return static_cast<std::int64_t>(hash);
}

}  // namespace floornav
