// Reads one table of a scene key by key. A getter returns an empty optional where the key was not written or its value
// is wrong; the latter is recorded as a problem. At the end, keys that no one asked for are reported.
#pragma once

#include <functional>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "scene/input/toml_value.hpp"

namespace stillpoint {

/// Sets target where a value was read.
template <class T, class U>
void assign(T& target, std::optional<U>&& value) {
  if (value) target = static_cast<T>(std::move(*value));
}

class TableReader {
 public:
  /// table: null where the scene does not have it; then every getter is empty. where: the place of what is missing in
  /// it.
  TableReader(const toml::table* table, std::string path, Location where, Reading& reading);

  bool written() const { return table_ != nullptr; }
  bool has(const std::string& key) const { return table_ && table_->get(key); }
  bool is_array(const std::string& key) const { return has(key) && table_->get(key)->is_array(); }

  /// [key] below this table, not written where absent.
  TableReader table(const std::string& key);
  /// The same, and a problem where absent.
  TableReader required_table(const std::string& key, const std::string& purpose);
  /// [[key]] below this table.
  std::vector<TableReader> tables(const std::string& key);
  /// [key] or every [[key]], at least one; not written and a problem where there is none.
  std::vector<TableReader> one_or_more_tables(const std::string& key, const std::string& purpose);
  /// [key.<name>]: every table below [key], by its name.
  std::vector<std::pair<std::string, TableReader>> named_tables(const std::string& key);

  std::optional<double> number(const std::string& key, const Range& range = kAnyNumber);
  std::optional<std::int64_t> integer(const std::string& key, std::int64_t lower, std::int64_t upper);
  std::optional<Expression> formula(const std::string& key, const std::string& variables);
  std::optional<std::string> text(const std::string& key);
  /// A string that is not empty.
  std::optional<std::string> name(const std::string& key);
  std::optional<std::vector<std::string>> texts(const std::string& key);
  /// Whether the value of a key that takes a number or this word is the word; a misspelt word is reported, and counts.
  bool is_word(const std::string& key, const std::string& word);
  /// One value for each dimension: an array of count, or a plain value where count = 1.
  std::optional<std::vector<double>> numbers(const std::string& key, std::size_t count);
  /// An array of any length.
  std::optional<std::vector<double>> numbers(const std::string& key);
  std::optional<std::vector<int>> integers(const std::string& key, std::size_t count, int lower, int upper);
  /// An array of places, each an array of dim coordinates.
  std::optional<std::vector<std::vector<double>>> places(const std::string& key, std::size_t dim);
  std::optional<std::vector<Expression>> formulas(const std::string& key, std::size_t count,
                                                  const std::string& variables);
  /// A string that is one of names.
  std::optional<std::string> choice(const std::string& key, const std::vector<std::string>& names);
  /// The value that goes with a string.
  template <class T>
  std::optional<T> choice(const std::string& key, const std::vector<std::pair<std::string, T>>& values) {
    std::vector<std::string> names;
    for (const auto& value : values) names.push_back(value.first);
    if (const auto name = choice(key, names))
      for (const auto& value : values)
        if (value.first == *name) return value.second;
    return std::nullopt;
  }

  /// Reports the keys that are missing; nothing of it where the table itself is not written.
  void require(std::initializer_list<const char*> keys);
  /// Reports the value of key (the table where key is not written or empty) as wrong.
  void problem(const std::string& key, const std::string& message);
  /// Reports keys that no getter asked for. The last call.
  void report_unknown_keys();

 private:
  const toml::node* find(const std::string& key);
  std::string path_of(const std::string& key) const {
    return path_.empty() || key.empty() ? path_ + key : path_ + "." + key;
  }
  /// Reads value(node, path) for every entry of an array of count, or for a plain value where count = 1.
  template <class T>
  std::optional<std::vector<T>> list(
      const std::string& key, std::size_t count,
      const std::function<std::optional<T>(const toml::node&, const std::string&)>& value);

  const toml::table* table_;
  std::string path_;
  Location where_;
  Reading& reading_;
  std::vector<std::string> asked_;
};

}  // namespace stillpoint
