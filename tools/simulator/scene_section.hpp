#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>
#include <yaml-cpp/yaml.h>

#include "runtime/geometry/settings.hpp"

namespace floornav {

/// A scene file that cannot be used: what() is one line with file, key and reason.
struct SceneError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// One map of a scene file. Every key that is asked for is checked; finish() refuses the ones that nobody
/// asked for.
class SceneSection {
 public:
  /// `where` is the place in the file that messages name, e.g. "objects[3].box". Throws SceneError unless a
  /// map.
  SceneSection(std::string file, std::string where, YAML::Node node);

  /// Whether an optional key is there.
  [[nodiscard]] bool has(const std::string& key);
  double number(const std::string& key, Allowed allowed);
  double number_or(const std::string& key, double otherwise, Allowed allowed);
  int whole_number(const std::string& key, Allowed allowed);
  std::string text(const std::string& key);
  Eigen::Vector2d point(const std::string& key);
  /// `count` numbers, each within `allowed`.
  std::vector<double> numbers(const std::string& key, std::size_t count, Allowed allowed);
  std::vector<Eigen::Vector2d> points(const std::string& key, std::size_t at_least);
  SceneSection section(const std::string& key);
  /// The elements of a list of maps.
  std::vector<SceneSection> sections(const std::string& key);
  /// The only key of a one-key map: what an element of a list is.
  std::string only_key();

  void finish() const;
  /// Throws a SceneError about this key.
  [[noreturn]] void refuse(const std::string& key, std::string_view reason) const;

 private:
  YAML::Node required(const std::string& key);
  double checked_number(const std::string& key, const YAML::Node& node, Allowed allowed) const;

  std::string file_;
  std::string where_;
  YAML::Node node_;
  std::vector<std::string> asked_;
};

}  // namespace floornav
