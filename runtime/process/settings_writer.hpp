#pragma once

#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include "runtime/geometry/settings.hpp"

namespace floornav {

/// "0.1 .. 20", or one-sided, or "any".
std::string range_text(Allowed allowed);

/// The visitor that writes a settings struct as YAML, with what is allowed as a comment on each line.
class SettingsWriter {
 public:
  explicit SettingsWriter(int depth = 0) : depth_(depth) {}

  template <class Number>
  requires std::is_arithmetic_v<Number>
  void operator()(const char* key, Number& value, Allowed allowed = {}) {
    line(key, fmt::format("{}", value), std::same_as<Number, bool> ? "true or false" : range_text(allowed));
  }
  void operator()(const char* key, std::string& value) { line(key, quoted(value), ""); }
  void operator()(const char* key, std::string& value, std::initializer_list<const char*> allowed) {
    line(key, quoted(value), fmt::format("{}", fmt::join(allowed, ", ")));
  }

  template <class Struct>
  requires std::is_class_v<Struct>
  void operator()(const char* key, Struct& value) {
    SettingsWriter nested(depth_ + 1);
    visit_settings(nested, value);
    text_ += indent() + key + ":\n" + nested.text_;
  }

  template <class Item, class... Rest>
  void operator()(const char* key, std::vector<Item>& value, Rest...) {
    if constexpr (std::is_arithmetic_v<Item>) {
      line(key, fmt::format("[{}]", fmt::join(value, ", ")), "");
    } else if (value.empty()) {
      line(key, "[]", "");
    } else {
      text_ += indent() + key + ":\n";
      for (Item& item : value) {
        SettingsWriter nested(depth_ + 2);
        visit_settings(nested, item);
        text_ += indent() + "  -\n" + nested.text_;
      }
    }
  }

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  [[nodiscard]] std::string indent() const { return std::string(static_cast<std::size_t>(2 * depth_), ' '); }
  static std::string quoted(const std::string& value);
  void line(const char* key, const std::string& value, const std::string& comment);

  int depth_;
  std::string text_;
};

/// The settings as YAML that read_settings() takes back.
template <class Struct>
std::string settings_text(Struct settings) {
  SettingsWriter writer;
  visit_settings(writer, settings);
  return writer.text();
}

/// FNV-1a, 64 bits.
std::int64_t hash_of(const std::string& text);

/// Identifies the values in force, however they came about; the same on every machine.
template <class Struct>
std::int64_t settings_hash(const Struct& settings) {
  return hash_of(settings_text(settings));
}

}  // namespace floornav
