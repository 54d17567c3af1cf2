#include "tools/simulator/scene_section.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace floornav {
namespace {

constexpr Allowed kCoordinate{-1000.0, 1000.0};

std::string text_of(Allowed allowed) {
  std::ostringstream out;
  out << allowed.min << " to " << allowed.max;
  return out.str();
}

}  // namespace

SceneSection::SceneSection(std::string file, std::string where, YAML::Node node)
    : file_(std::move(file)), where_(std::move(where)), node_(std::move(node)) {
  if (!node_.IsMap()) refuse("", "must be a map of keys and values");
}

void SceneSection::refuse(const std::string& key, std::string_view reason) const {
  std::string name = where_;
  if (!key.empty()) name += (name.empty() ? "" : ".") + key;
  YAML::Mark mark = node_.Mark();
  if (node_.IsMap() && !key.empty())
    for (const auto& entry : node_)
      if (entry.first.IsScalar() && entry.first.Scalar() == key) mark = entry.first.Mark();
  const std::string line = mark.is_null() ? "" : ":" + std::to_string(mark.line + 1);
  throw SceneError(file_ + line + ": " + (name.empty() ? "scene" : name) + ": " + std::string(reason));
}

bool SceneSection::has(const std::string& key) {
  if (std::ranges::find(asked_, key) == asked_.end()) asked_.push_back(key);
  return std::as_const(node_)[key].IsDefined();
}

YAML::Node SceneSection::required(const std::string& key) {
  if (!has(key)) refuse("", "key '" + key + "' is missing");
  return std::as_const(node_)[key];
}

double SceneSection::checked_number(const std::string& key, const YAML::Node& node, Allowed allowed) const {
  double value = 0;
  if (!node.IsScalar() || !YAML::convert<double>::decode(node, value) || !std::isfinite(value))
    refuse(key, "must be a number");
  if (value < allowed.min || value > allowed.max)
    refuse(key, "is " + node.Scalar() + ", allowed is " + text_of(allowed));
  return value;
}

double SceneSection::number(const std::string& key, Allowed allowed) {
  return checked_number(key, required(key), allowed);
}

double SceneSection::number_or(const std::string& key, double otherwise, Allowed allowed) {
  return has(key) ? checked_number(key, std::as_const(node_)[key], allowed) : otherwise;
}

int SceneSection::whole_number(const std::string& key, Allowed allowed) {
  const double value = number(key, allowed);
  if (value != std::floor(value)) refuse(key, "must be a whole number");
  return static_cast<int>(value);
}

std::string SceneSection::text(const std::string& key) {
  const YAML::Node node = required(key);
  if (!node.IsScalar() || node.Scalar().empty()) refuse(key, "must be a text");
  return node.Scalar();
}

std::vector<double> SceneSection::numbers(const std::string& key, std::size_t count, Allowed allowed) {
  const YAML::Node node = required(key);
  if (!node.IsSequence() || node.size() != count)
    refuse(key, "must be a list of " + std::to_string(count) + " numbers");
  std::vector<double> values;
  for (const YAML::Node& element : node) values.push_back(checked_number(key, element, allowed));
  return values;
}

Eigen::Vector2d SceneSection::point(const std::string& key) {
  const std::vector<double> xy = numbers(key, 2, kCoordinate);
  return {xy[0], xy[1]};
}

std::vector<Eigen::Vector2d> SceneSection::points(const std::string& key, std::size_t at_least) {
  const YAML::Node node = required(key);
  if (!node.IsSequence() || node.size() < at_least)
    refuse(key, "must be a list of " + std::to_string(at_least) + " or more points");
  std::vector<Eigen::Vector2d> result;
  for (const YAML::Node& element : node) {
    if (!element.IsSequence() || element.size() != 2) refuse(key, "must be a list of points, each [x, y]");
    result.emplace_back(checked_number(key, element[0], kCoordinate),
                        checked_number(key, element[1], kCoordinate));
  }
  return result;
}

SceneSection SceneSection::section(const std::string& key) {
  return {file_, where_.empty() ? key : where_ + "." + key, required(key)};
}

std::vector<SceneSection> SceneSection::sections(const std::string& key) {
  const YAML::Node node = required(key);
  if (!node.IsSequence()) refuse(key, "must be a list");
  std::vector<SceneSection> result;
  for (std::size_t i = 0; i < node.size(); ++i)
    result.emplace_back(file_, key + "[" + std::to_string(i) + "]", node[i]);
  return result;
}

std::string SceneSection::only_key() {
  if (node_.size() != 1 || !node_.begin()->first.IsScalar())
    refuse("", "must have one key, the kind of thing it is");
  return node_.begin()->first.Scalar();
}

void SceneSection::finish() const {
  std::vector<std::string> seen;
  for (const auto& entry : node_) {
    const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "?";
    if (std::ranges::find(asked_, key) == asked_.end()) {
      std::string allowed;
      for (const std::string& name : asked_) allowed += (allowed.empty() ? "" : ", ") + name;
      refuse(key, "unknown key, allowed are: " + allowed);
    }
    if (std::ranges::find(seen, key) != seen.end()) refuse(key, "is given twice");
    seen.push_back(key);
  }
}

}  // namespace floornav
