#include "scene/input/toml_reader.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/text.hpp"
#include "scene/input/toml_source.hpp"

namespace stillpoint {

TableReader::TableReader(const toml::table* table, std::string path, Location where, Reading& reading)
    : table_(table), path_(std::move(path)), where_(std::move(where)), reading_(reading) {}

const toml::node* TableReader::find(const std::string& key) {
  if (std::find(asked_.begin(), asked_.end(), key) == asked_.end()) asked_.push_back(key);
  return table_ ? table_->get(key) : nullptr;
}

TableReader TableReader::table(const std::string& key) {
  const toml::node* const node = find(key);
  if (node && !node->is_table()) problem(key, fmt::format("expected a table, found {}", kind_of(*node)));
  const toml::table* const below = node ? node->as_table() : nullptr;
  return {below, path_of(key), node ? location_of(node->source()) : where_, reading_};
}

TableReader TableReader::required_table(const std::string& key, const std::string& purpose) {
  if (!find(key)) problem(key, fmt::format("this table is missing: {}", purpose));
  return table(key);
}

std::vector<TableReader> TableReader::tables(const std::string& key) {
  std::vector<TableReader> result;
  const toml::node* const node = find(key);
  if (!node) return result;
  const toml::array* const array = node->as_array();
  if (!array) {
    problem(key, fmt::format("expected an array of tables, [[{}]], found {}", path_of(key), kind_of(*node)));
    return result;
  }
  for (std::size_t k = 0; k < array->size(); ++k) {
    const toml::node& entry = *array->get(k);
    const std::string path = fmt::format("{}[{}]", path_of(key), k);
    if (entry.is_table()) {
      result.emplace_back(entry.as_table(), path, location_of(entry.source()), reading_);
    } else {
      reading_.problem(location_of(entry.source()), path, fmt::format("expected a table, found {}", kind_of(entry)));
    }
  }
  return result;
}

std::vector<TableReader> TableReader::one_or_more_tables(const std::string& key, const std::string& purpose) {
  std::vector<TableReader> result;
  if (is_array(key)) result = tables(key);
  if (is_array(key) && find(key)->as_array()->empty()) problem(key, fmt::format("none is given: {}", purpose));
  if (result.empty())
    result.push_back(is_array(key) ? TableReader(nullptr, key, where_, reading_) : required_table(key, purpose));
  return result;
}

std::vector<std::pair<std::string, TableReader>> TableReader::named_tables(const std::string& key) {
  std::vector<std::pair<std::string, TableReader>> result;
  TableReader parent = table(key);
  if (!parent.written()) return result;
  for (auto&& [name, node] : *parent.table_) {
    TableReader below = parent.table(std::string(name.str()));
    if (below.written()) result.emplace_back(name.str(), std::move(below));
  }
  return result;
}

std::optional<double> TableReader::number(const std::string& key, const Range& range) {
  const toml::node* const node = find(key);
  return node ? read_number(*node, path_of(key), range, reading_) : std::nullopt;
}

std::optional<std::int64_t> TableReader::integer(const std::string& key, std::int64_t lower, std::int64_t upper) {
  const toml::node* const node = find(key);
  return node ? read_integer(*node, path_of(key), lower, upper, reading_) : std::nullopt;
}

std::optional<Expression> TableReader::formula(const std::string& key, const std::string& variables) {
  const toml::node* const node = find(key);
  return node ? read_formula(*node, path_of(key), variables, reading_) : std::nullopt;
}

std::optional<std::string> TableReader::text(const std::string& key) {
  const toml::node* const node = find(key);
  return node ? read_text(*node, path_of(key), reading_) : std::nullopt;
}

std::optional<std::string> TableReader::name(const std::string& key) {
  auto word = text(key);
  if (!word || !word->empty()) return word;
  problem(key, "must not be empty");
  return std::nullopt;
}

bool TableReader::is_word(const std::string& key, const std::string& word) {
  const toml::node* const node = find(key);
  const auto* const text = node ? node->as_string() : nullptr;
  if (!text || nearest(text->get(), {word}).empty()) return false;
  if (text->get() != word) problem(key, unknown_word("unknown value", text->get(), {word}));
  return true;
}

std::optional<std::vector<std::string>> TableReader::texts(const std::string& key) {
  const toml::node* const node = find(key);
  if (!node) return std::nullopt;
  if (const toml::array* const array = node->as_array())
    return list<std::string>(key, array->size(), [this](const toml::node& entry, const std::string& path) {
      return read_text(entry, path, reading_);
    });
  problem(key, fmt::format("expected an array of strings, found {}", kind_of(*node)));
  return std::nullopt;
}

std::optional<std::vector<double>> TableReader::numbers(const std::string& key, std::size_t count) {
  return list<double>(key, count, [this](const toml::node& node, const std::string& path) {
    return read_number(node, path, kAnyNumber, reading_);
  });
}

std::optional<std::vector<double>> TableReader::numbers(const std::string& key) {
  if (has(key) && !is_array(key)) {
    problem(key, fmt::format("expected an array of numbers, found {}", kind_of(*find(key))));
    return std::nullopt;
  }
  return numbers(key, is_array(key) ? find(key)->as_array()->size() : 0);
}

std::optional<std::vector<std::vector<double>>> TableReader::places(const std::string& key, std::size_t dim) {
  using Place = std::vector<double>;
  const toml::node* const node = find(key);
  if (!node) return std::nullopt;
  if (!node->is_array()) {
    problem(key, fmt::format("expected an array of places, found {}", kind_of(*node)));
    return std::nullopt;
  }
  const auto place = [&](const toml::node& entry, const std::string& path) -> std::optional<Place> {
    const toml::array* const array = entry.as_array();
    if (!array || array->size() != dim) {
      const std::string found = array ? fmt::format("{}", array->size()) : kind_of(entry);
      reading_.problem(location_of(entry.source()), path,
                       fmt::format("expected an array of {} coordinates, found {}", dim, found));
      return std::nullopt;
    }
    Place result;
    for (std::size_t d = 0; d < dim; ++d)
      if (const auto x = read_number(*array->get(d), fmt::format("{}[{}]", path, d), kAnyNumber, reading_))
        result.push_back(*x);
    return result.size() == dim ? std::optional(result) : std::nullopt;
  };
  return list<Place>(key, node->as_array()->size(), place);
}

std::optional<std::vector<int>> TableReader::integers(const std::string& key, std::size_t count, int lower, int upper) {
  return list<int>(key, count, [&](const toml::node& node, const std::string& path) -> std::optional<int> {
    const auto value = read_integer(node, path, lower, upper, reading_);
    return value ? std::optional(static_cast<int>(*value)) : std::nullopt;
  });
}

std::optional<std::vector<Expression>> TableReader::formulas(const std::string& key, std::size_t count,
                                                             const std::string& variables) {
  return list<Expression>(key, count, [&](const toml::node& node, const std::string& path) {
    return read_formula(node, path, variables, reading_);
  });
}

template <class T>
std::optional<std::vector<T>> TableReader::list(
    const std::string& key, std::size_t count,
    const std::function<std::optional<T>(const toml::node&, const std::string&)>& value) {
  const toml::node* const node = find(key);
  if (!node) return std::nullopt;
  const toml::array* const array = node->as_array();
  const std::size_t found = array ? array->size() : 1;
  if (found != count) {
    problem(key, fmt::format("expected {} value{}, found {}", count, count == 1 ? "" : "s", found));
    return std::nullopt;
  }
  std::vector<T> result;
  if (!array) {
    if (auto entry = value(*node, path_of(key))) result.push_back(std::move(*entry));
  } else {
    for (std::size_t k = 0; k < found; ++k)
      if (auto entry = value(*array->get(k), fmt::format("{}[{}]", path_of(key), k)))
        result.push_back(std::move(*entry));
  }
  return result.size() == count ? std::optional(std::move(result)) : std::nullopt;
}

std::optional<std::string> TableReader::choice(const std::string& key, const std::vector<std::string>& names) {
  auto word = text(key);
  if (!word || std::find(names.begin(), names.end(), *word) != names.end()) return word;
  problem(key, unknown_word("unknown value", *word, names));
  return std::nullopt;
}

void TableReader::require(std::initializer_list<const char*> keys) {
  if (!written()) return;
  for (const std::string key : keys)
    if (!find(key)) reading_.problem(where_, path_, fmt::format("the key '{}' is missing", key));
}

void TableReader::problem(const std::string& key, const std::string& message) {
  const toml::node* const node = key.empty() ? nullptr : find(key);
  reading_.problem(node ? location_of(node->source()) : where_, path_of(key), message);
}

void TableReader::report_unknown_keys() {
  if (!table_) return;
  for (auto&& [key, node] : *table_) {
    const std::string name(key.str());
    if (std::find(asked_.begin(), asked_.end(), name) != asked_.end()) continue;
    reading_.problem(location_of(key.source()), path_, unknown_word("unknown key", name, asked_));
  }
}

}  // namespace stillpoint
