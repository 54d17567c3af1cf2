#pragma once

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "runtime/geometry/settings.hpp"

namespace floornav {

/// One line that names file, line, key, value and what is allowed.
class SettingsError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The visitor that fills a settings struct from one YAML map. A key that is absent keeps its default; one
/// that nothing asked for is an error.
class SettingsReader {
 public:
  /// `path` is the map's own key, empty at the top of the file. Throws SettingsError for what is no map and
  /// for a key that stands twice.
  SettingsReader(std::string file, std::string path, YAML::Node map);

  void operator()(const char* key, double& value, Allowed allowed = {});
  void operator()(const char* key, float& value, Allowed allowed = {});
  void operator()(const char* key, bool& value);
  void operator()(const char* key, std::string& value);
  void operator()(const char* key, std::string& value, std::initializer_list<const char*> allowed);

  template <std::integral Integer>
  requires(!std::same_as<Integer, bool>) void operator()(const char* key, Integer& value,
                                                         Allowed allowed = {}) {
    const double lowest = static_cast<double>(std::numeric_limits<Integer>::min());
    const double highest = static_cast<double>(std::numeric_limits<Integer>::max());
    if (allowed.min < lowest) allowed.min = lowest;
    if (allowed.max > highest) allowed.max = highest;
    if (const YAML::Node node = take(key)) value = static_cast<Integer>(integer(node, path_of(key), allowed));
  }

  /// A nested struct with its own visit_settings.
  template <class Struct>
  requires std::is_class_v<Struct>
  void operator()(const char* key, Struct& value) {
    if (const YAML::Node node = take(key)) read_struct(node, path_of(key), value);
  }

  /// A list replaces the default one as a whole.
  template <class Item, class... Rest>
  void operator()(const char* key, std::vector<Item>& value, Rest... allowed) {
    const YAML::Node node = take(key);
    if (!node) return;
    check_sequence(node, path_of(key));
    value.clear();
    for (std::size_t i = 0; i < node.size(); ++i) {
      const std::string path = path_of(key) + "[" + std::to_string(i) + "]";
      Item item{};
      if constexpr (std::is_arithmetic_v<Item>) {
        item = static_cast<Item>(number(node[i], path, allowed...));
      } else {
        read_struct(node[i], path, item);
      }
      value.push_back(std::move(item));
    }
  }

  /// Keys of the file's top that another program reads.
  void leave_to_others(const std::set<std::string>& keys);
  /// Throws SettingsError for the first key that nothing asked for, with the nearest one that is known.
  void finish() const;

 private:
  YAML::Node take(const char* key);
  [[nodiscard]] std::string path_of(const std::string& key) const;
  [[nodiscard]] double number(const YAML::Node& node, const std::string& path, Allowed allowed = {}) const;
  [[nodiscard]] std::int64_t integer(const YAML::Node& node, const std::string& path, Allowed allowed) const;
  void check_sequence(const YAML::Node& node, const std::string& path) const;
  [[noreturn]] void refuse(const YAML::Node& node, const std::string& path, const std::string& why) const;

  template <class Struct>
  void read_struct(const YAML::Node& node, const std::string& path, Struct& value) const {
    SettingsReader nested(file_, path, node);
    visit_settings(nested, value);
    nested.finish();
  }

  std::string file_;
  std::string path_;
  YAML::Node map_;
  std::set<std::string> known_;
};

/// The one document of a YAML file, a map (or nothing at all). Throws SettingsError.
YAML::Node load_yaml(const std::filesystem::path& file);

/// Fills `settings` from a YAML file. Throws SettingsError; `settings` is then half filled and not to be
/// used.
template <class Struct>
void read_settings(const std::filesystem::path& file, Struct& settings,
                   const std::set<std::string>& others = {}) {
  SettingsReader reader(file.string(), "", load_yaml(file));
  visit_settings(reader, settings);
  reader.leave_to_others(others);
  reader.finish();
}

/// The sections of the one file that describes a robot. A program reads those that it needs.
inline const std::set<std::string> kRobotFileSections = {"robot",   "perception", "mapping",
                                                         "planner", "kinect",     "bumblebee"};

/// Fills a struct of sections (`robot`, `perception`, ...) from a robot's file.
template <class Struct>
void read_robot_file(const std::filesystem::path& file, Struct& settings) {
  read_settings(file, settings, kRobotFileSections);
}

}  // namespace floornav
