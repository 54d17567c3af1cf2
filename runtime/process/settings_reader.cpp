#include "runtime/process/settings_reader.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "runtime/process/settings_writer.hpp"

namespace floornav {
namespace {

constexpr std::uintmax_t kMaxFileBytes = 1 << 20;

/// Levenshtein's: insertions, removals and replacements from a to b.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

std::string hint(const std::string& unknown, const std::set<std::string>& known) {
  const std::string* nearest = nullptr;
  std::size_t distance = std::max<std::size_t>(2, unknown.size() / 2);
  for (const std::string& key : known) {
    const std::size_t d = edit_distance(unknown, key);
    if (d < distance || (d == distance && nearest == nullptr)) {
      distance = d;
      nearest = &key;
    }
  }
  if (nearest != nullptr) return fmt::format("; did you mean '{}'?", *nearest);
  return fmt::format("; known here: {}", fmt::join(known, ", "));
}

std::string place(const std::string& file, const YAML::Mark& mark) {
  return mark.is_null() ? file : fmt::format("{}:{}", file, mark.line + 1);
}

template <class Number>
bool parse_whole(const std::string& text, Number& number) {
  const char* begin = text.data() + (text.size() > 1 && text[0] == '+' ? 1 : 0);
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(begin, end, number);
  return error == std::errc() && stop == end;
}

std::string one_line(std::string text) {
  constexpr std::size_t kLongest = 60;
  if (text.size() > kLongest) text = text.substr(0, kLongest) + "...";
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '?';
  }
  return text;
}

}  // namespace

SettingsReader::SettingsReader(std::string file, std::string path, YAML::Node map)
    : file_(std::move(file)), path_(std::move(path)), map_(std::move(map)) {
  if (map_.IsNull()) return;
  if (!map_.IsMap()) refuse(map_, path_, "must be a map of keys and values");
  std::set<std::string> seen;
  for (const auto& item : map_) {
    if (!item.first.IsScalar()) refuse(item.first, path_, "has a key that is no word");
    if (!seen.insert(item.first.Scalar()).second)
      refuse(item.first, path_of(one_line(item.first.Scalar())), "stands twice");
  }
}

void SettingsReader::operator()(const char* key, double& value, Allowed allowed) {
  if (const YAML::Node node = take(key)) value = number(node, path_of(key), allowed);
}

void SettingsReader::operator()(const char* key, float& value, Allowed allowed) {
  constexpr double kHighest = std::numeric_limits<float>::max();
  allowed = {std::max(allowed.min, -kHighest), std::min(allowed.max, kHighest)};
  if (const YAML::Node node = take(key)) value = static_cast<float>(number(node, path_of(key), allowed));
}

void SettingsReader::operator()(const char* key, bool& value) {
  const YAML::Node node = take(key);
  if (!node) return;
  const std::string text = node.IsScalar() ? node.Scalar() : "";
  if (text != "true" && text != "false") refuse(node, path_of(key), "must be true or false");
  value = text == "true";
}

void SettingsReader::operator()(const char* key, std::string& value) {
  const YAML::Node node = take(key);
  if (!node) return;
  if (!node.IsScalar()) refuse(node, path_of(key), "must be a word");
  value = node.Scalar();
}

void SettingsReader::operator()(const char* key, std::string& value,
                                std::initializer_list<const char*> allowed) {
  const YAML::Node node = take(key);
  if (!node) return;
  const std::string text = node.IsScalar() ? node.Scalar() : "";
  if (std::find(allowed.begin(), allowed.end(), text) == allowed.end())
    refuse(node, path_of(key), fmt::format("must be one of: {}", fmt::join(allowed, ", ")));
  value = text;
}

void SettingsReader::leave_to_others(const std::set<std::string>& keys) {
  known_.insert(keys.begin(), keys.end());
}

void SettingsReader::finish() const {
  if (map_.IsNull()) return;
  for (const auto& item : map_) {
    const std::string& key = item.first.Scalar();
    if (!known_.contains(key))
      throw SettingsError(fmt::format("{}: {}: unknown key{}", place(file_, item.first.Mark()),
                                      path_of(one_line(key)), hint(key, known_)));
  }
}

YAML::Node SettingsReader::take(const char* key) {
  known_.insert(key);
  if (map_.IsNull()) return YAML::Node(YAML::NodeType::Undefined);
  return std::as_const(map_)[key];
}

std::string SettingsReader::path_of(const std::string& key) const {
  return path_.empty() ? key : path_ + "." + key;
}

double SettingsReader::number(const YAML::Node& node, const std::string& path, Allowed allowed) const {
  double value = 0.0;
  if (!node.IsScalar() || !parse_whole(node.Scalar(), value) || !std::isfinite(value))
    refuse(node, path, fmt::format("must be a number {}", range_text(allowed)));
  if (!(value >= allowed.min && value <= allowed.max))
    refuse(node, path, fmt::format("must be {}", range_text(allowed)));
  return value;
}

std::int64_t SettingsReader::integer(const YAML::Node& node, const std::string& path, Allowed allowed) const {
  std::int64_t value = 0;
  if (!node.IsScalar() || !parse_whole(node.Scalar(), value))
    refuse(node, path, fmt::format("must be a whole number {}", range_text(allowed)));
  const auto exact = static_cast<double>(value);
  if (!(exact >= allowed.min && exact <= allowed.max))
    refuse(node, path, fmt::format("must be {}", range_text(allowed)));
  return value;
}

void SettingsReader::check_sequence(const YAML::Node& node, const std::string& path) const {
  if (!node.IsSequence()) refuse(node, path, "must be a list");
}

void SettingsReader::refuse(const YAML::Node& node, const std::string& path, const std::string& why) const {
  std::string value = "nothing";
  if (node.IsScalar()) value = "'" + one_line(node.Scalar()) + "'";
  if (node.IsMap()) value = "a map";
  if (node.IsSequence()) value = "a list";
  const std::string where = path.empty() ? "the file" : path;
  throw SettingsError(fmt::format("{}: {}: {} (it is {})", place(file_, node.Mark()), where, why, value));
}

YAML::Node load_yaml(const std::filesystem::path& file) {
  const std::string name = file.string();
  std::error_code error;
  if (!std::filesystem::exists(file, error)) throw SettingsError(name + ": no such file");
  if (!std::filesystem::is_regular_file(file, error)) throw SettingsError(name + ": not a file");
  const auto bytes = std::filesystem::file_size(file, error);
  if (error) throw SettingsError(name + ": " + error.message());
  if (bytes > kMaxFileBytes)
    throw SettingsError(name + ": too large for a configuration file (more than 1 MB)");
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (!stream || (bytes > 0 && !(text << stream.rdbuf()))) throw SettingsError(name + ": cannot be read");
  try {
    const std::vector<YAML::Node> documents = YAML::LoadAll(text.str());
    if (documents.empty()) return {};
    if (documents.size() > 1) throw SettingsError(name + ": more than one YAML document");
    return documents.front();
  } catch (const YAML::Exception& e) {
    throw SettingsError(fmt::format("{}: not YAML: {}", place(name, e.mark), one_line(e.msg)));
  }
}

}  // namespace floornav
