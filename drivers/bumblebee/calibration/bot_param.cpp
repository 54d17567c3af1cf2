#include "drivers/bumblebee/calibration/bot_param.hpp"

#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

namespace floornav {
namespace {

constexpr int kDeepest = 32;

class Parser {
 public:
  explicit Parser(const std::string& text) : text_(text) {}

  BotBlock block(int depth) {
    if (depth > kDeepest) fail("blocks nested too deep");
    BotBlock result;
    while (true) {
      const std::string name = word();
      if (name.empty() && depth == 0) return result;
      if (name == "}" && depth > 0) return result;
      if (!is_name(name)) fail(fmt::format("expected a name, found \"{}\"", name));
      const std::string next = word();
      if (next == "{") {
        result.blocks[name] = block(depth + 1);
      } else if (next == "=") {
        result.values[name] = values();
      } else {
        fail(fmt::format("expected = or {{ after \"{}\", found \"{}\"", name, next));
      }
    }
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(fmt::format("line {}: {}", line_, what));
  }

  static bool is_mark(char c) { return std::string("{}[]=;,").find(c) != std::string::npos; }
  static bool is_name(const std::string& word) { return !word.empty() && !is_mark(word.front()); }

  void skip_blanks() {
    for (; at_ < text_.size(); ++at_) {
      if (text_[at_] == '#')
        while (at_ + 1 < text_.size() && text_[at_ + 1] != '\n') ++at_;
      else if (std::isspace(static_cast<unsigned char>(text_[at_])) == 0)
        return;
      if (text_[at_] == '\n') ++line_;
    }
  }

  /// A mark, a quoted string without its quotes, or all up to the next mark or blank; empty at the end.
  std::string word() {
    skip_blanks();
    if (at_ == text_.size()) return {};
    if (is_mark(text_[at_])) return {text_[at_++]};
    if (text_[at_] == '"') return quoted();
    std::string result;
    while (at_ < text_.size() && !is_mark(text_[at_]) && text_[at_] != '#' &&
           std::isspace(static_cast<unsigned char>(text_[at_])) == 0)
      result += text_[at_++];
    return result;
  }

  std::string quoted() {
    const std::size_t end = text_.find('"', at_ + 1);
    if (end == std::string::npos) fail("string without end");
    const std::string result = text_.substr(at_ + 1, end - at_ - 1);
    at_ = end + 1;
    return result;
  }

  std::vector<std::string> values() {
    std::vector<std::string> result;
    std::string next = word();
    if (next != "[") {
      result.push_back(next);
    } else {
      for (next = word(); next != "]"; next = word()) {
        if (next.empty()) fail("list without end");
        if (next != ",") result.push_back(next);
      }
    }
    if (word() != ";") fail("expected ; after a value");
    return result;
  }

  const std::string& text_;
  std::size_t at_ = 0;
  int line_ = 1;
};

}  // namespace

std::vector<double> BotBlock::numbers(const std::string& key, std::size_t count) const {
  const auto found = values.find(key);
  if (found == values.end()) throw std::runtime_error(fmt::format("no {}", key));
  std::vector<double> result;
  for (const std::string& value : found->second) {
    double number = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (error != std::errc{} || end != value.data() + value.size() || !std::isfinite(number))
      throw std::runtime_error(fmt::format("{} is \"{}\", not a number", key, value));
    result.push_back(number);
  }
  if (result.size() != count)
    throw std::runtime_error(fmt::format("{} has {} numbers instead of {}", key, result.size(), count));
  return result;
}

BotBlock parse_bot_param(const std::string& text) {
  return Parser(text).block(0);
}

}  // namespace floornav
