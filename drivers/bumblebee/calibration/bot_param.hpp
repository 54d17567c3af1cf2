#pragma once

#include <map>
#include <string>
#include <vector>

namespace floornav {

/// A block of libbot's configuration language: `name { key = value; key = [v, v]; ... }`.
struct BotBlock {
  std::map<std::string, std::vector<std::string>> values;  ///< a single value is a list of one
  std::map<std::string, BotBlock> blocks;

  /// The block's numbers under a key. Throws std::runtime_error where there are not `count` of them.
  [[nodiscard]] std::vector<double> numbers(const std::string& key, std::size_t count) const;
  [[nodiscard]] double number(const std::string& key) const { return numbers(key, 1).front(); }
};

/// Reads a whole file's text. Throws std::runtime_error "line N: what is wrong".
BotBlock parse_bot_param(const std::string& text);

}  // namespace floornav
