#include "scene/input/key_reader.hpp"

#include <algorithm>

#include "base/text.hpp"
#include "scene/dimensions.hpp"
#include "scene/formula_parts.hpp"
#include "scene/input/toml_source.hpp"

namespace stillpoint {
namespace {

void report_unknown_word(const Value& value, const KeyInfo& key, const std::string& word) {
  const std::string hint = key.hint ? key.hint(word) : "";
  value.problem(hint.empty() ? unknown_word("unknown value", word, key.words_in(value.reading.dim)) : hint);
}

/// A word's number among all words of the key; empty if it is none of those in a scene of this dimension.
std::optional<std::int64_t> number_of(const std::string& word, const KeyInfo& key, int dim) {
  const auto found = std::ranges::find_if(
      key.words, [&](const Word& known) { return known.name == word && (known.dims & dims_of(dim)) != 0; });
  if (found == key.words.end()) return std::nullopt;
  return found - key.words.begin();
}

/// The table or array of tables that a dotted path leads to; null if there is none.
const toml::node* node_at(const toml::table& root, std::string_view path) {
  const toml::node* node = &root;
  for (; !path.empty(); path.remove_prefix(std::min(path.find('.'), path.size() - 1) + 1)) {
    const toml::table* const table = node->as_table();
    node = table ? table->get(path.substr(0, path.find('.'))) : nullptr;
    if (!node) return nullptr;
  }
  return node;
}

}  // namespace

std::vector<std::string> KeyInfo::words_in(int dim) const {
  std::vector<std::string> names;
  for (const Word& word : words)
    if ((word.dims & dims_of(dim)) != 0) names.emplace_back(word.name);
  return names;
}

Range KeyInfo::numbers_in(Dims in) const {
  const auto count = std::ranges::count_if(words, [in](const Word& word) { return word.has_number && word.dims & in; });
  return from(0, static_cast<double>(count) - 1);
}

std::optional<std::int64_t> read_word(const Value& value, const KeyInfo& key) {
  const int dim = value.reading.dim;
  if (key.kind == Kind::whole) {
    const auto* const text = value.node.as_string();
    if (const auto number = text ? number_of(text->get(), key, dim) : std::nullopt) return number;
    if (text && names_in(text->get()) == std::vector{text->get()} && !value.reading.constants.contains(text->get()))
      return report_unknown_word(value, key, text->get()), std::nullopt;
    return read_whole(value, key.numbers_in(dims_of(dim)));
  }
  const auto word = read_text(value);
  const auto number = word ? number_of(*word, key, dim) : std::nullopt;
  if (word && !number) report_unknown_word(value, key, *word);
  return number;
}

bool is_word(const Value& value, const KeyInfo& key) {
  const auto* const text = value.node.as_string();
  if (!text || nearest(text->get(), key.words_in(value.reading.dim)).empty()) return false;
  if (!number_of(text->get(), key, value.reading.dim)) report_unknown_word(value, key, text->get());
  return true;
}

std::optional<std::string> read_string(const Value& value, const KeyInfo& key) {
  auto text = read_text(value);
  if (!text) return std::nullopt;
  if (!key.words.empty() && !number_of(*text, key, value.reading.dim)) {
    report_unknown_word(value, key, *text);
  } else if (text->empty() && !key.may_be_empty) {
    value.problem("must not be empty");
  } else {
    return text;
  }
  return std::nullopt;
}

namespace {

/// The entries of a row; none, and a problem is added, if they are too few or too many.
std::vector<Value> entries_of_row(const Value& value, const KeyInfo& key) {
  const toml::array* const row = value.node.as_array();
  const int found = row ? static_cast<int>(row->size()) : 0;
  std::vector<Value> entries;
  if (!row || found < key.row_lengths[0] || found > key.row_lengths[1]) {
    value.problem(
        fmt::format("expected {}, found {}", key.row, row ? fmt::format("{} values", found) : kind_of(value.node)));
    return entries;
  }
  for (std::size_t k = 0; k < row->size(); ++k)
    entries.push_back({*row->get(k), fmt::format("{}[{}]", value.path, k), value.reading});
  return entries;
}

}  // namespace

template <>
std::optional<GridPiece> read_row(const Value& value, const KeyInfo& key) {
  const std::vector<Value> row = entries_of_row(value, key);
  if (row.empty()) return std::nullopt;
  const auto from = read_number(row[0]), to = read_number(row[1]);
  const auto cells = read_whole(row[2], kCells);
  const auto ratio = row.size() > 3 ? read_number(row[3], kPositive) : std::optional(1.0);
  if (!from || !to || !cells || !ratio) return std::nullopt;
  return GridPiece{.from = *from, .to = *to, .cells = static_cast<int>(*cells), .ratio = *ratio};
}

template <>
std::optional<StrengthRow> read_row(const Value& value, const KeyInfo& key) {
  const std::vector<Value> row = entries_of_row(value, key);
  if (row.empty()) return std::nullopt;
  constexpr Range angle{0, 90, true, false};
  const auto plastic_strain = read_number(row[0], kPositive), c = read_number(row[1], kNotNegative);
  const auto phi = read_number(row[2], angle), psi = read_number(row[3], angle);
  if (!plastic_strain || !c || !phi || !psi) return std::nullopt;
  return StrengthRow{.plastic_strain = *plastic_strain, .c = *c, .phi = *phi, .psi = *psi};
}

std::optional<std::vector<Value>> entries_of(const Value& value, const KeyInfo& key, bool list, bool nested) {
  const toml::array* const array = value.node.as_array();
  const std::size_t found = array ? array->size() : 1;
  const int dim = value.reading.dim;
  const bool of_tensor = key.of_stress && dim > 1;
  const std::size_t coordinates = key.of_turn ? dimension_info(dim).turns.size()
                                              : static_cast<std::size_t>(key.in_plane  ? 2
                                                                         : key.on_face ? dim - 1
                                                                                       : dim);
  const std::size_t count = list ? found : !of_tensor ? coordinates : dim == 2 ? 4 : 6;
  if (!array && (list || nested)) {
    const char* const of = nested                          ? "coordinates"
                           : key.shape == Shape::positions ? "positions"
                           : key.shape == Shape::rows      ? "rows"
                           : key.kind == Kind::number      ? "numbers"
                                                           : "strings";
    value.problem(fmt::format("expected an array of {}, found {}", of, kind_of(value.node)));
    return std::nullopt;
  }
  if (found != count) {
    value.problem(fmt::format("expected {} {}{}{}, found {}", count, nested ? "coordinate" : "value",
                              count == 1 ? "" : "s",
                              key.on_face  ? " (along the face, in the order of the axes)"
                              : !of_tensor ? ""
                              : dim == 2   ? " (xx, yy, zz, xy)"
                                           : " (xx, yy, zz, xy, yz, zx)",
                              found));
    return std::nullopt;
  }
  if (!array) return std::vector<Value>{value};
  std::vector<Value> entries;
  for (std::size_t k = 0; k < found; ++k)
    entries.push_back({*array->get(k), fmt::format("{}[{}]", value.path, k), value.reading});
  return entries;
}

std::string variables_of(const KeyInfo& key, int dim) {
  std::string variables(key.variables);
  if (const auto x = variables.find('x'); x != std::string::npos)
    variables.replace(x, 1, std::string("xyz").substr(0, static_cast<std::size_t>(dim)));
  return variables;
}

std::vector<FoundTable> find_tables(const TableInfo& info, const toml::table& root, Reading& reading) {
  std::vector<FoundTable> found;
  const std::string path(info.path.substr(0, info.path.find(".<")));
  const toml::node* const node = node_at(root, path);
  const auto add = [&](const toml::node& entry, const std::string& of, std::string_view name = {}) {
    if (const toml::table* const table = entry.as_table()) {
      found.push_back({*table, of, std::string(name)});
    } else {
      Value{entry, of, reading}.problem(fmt::format("expected a table, found {}", kind_of(entry)));
    }
  };
  if (!node) {
    if (!info.needed_for.empty())
      reading.problem(location_of(root.source()), path, fmt::format("this table is missing: {}", info.needed_for));
  } else if (info.repeat == Repeat::array || (info.repeat == Repeat::once_or_array && node->is_array())) {
    const toml::array* const array = node->as_array();
    const Value value{*node, path, reading};
    if (!array) {
      value.problem(fmt::format("expected an array of tables, {}, found {}", info.heading(), kind_of(*node)));
    } else if (array->empty() && !info.needed_for.empty()) {
      value.problem(fmt::format("none is given: {}", info.needed_for));
    }
    for (std::size_t k = 0; array && k < array->size(); ++k) add(*array->get(k), fmt::format("{}[{}]", path, k));
  } else if (info.repeat == Repeat::named && node->is_table()) {
    for (auto&& [name, entry] : *node->as_table()) add(entry, path + "." + std::string(name.str()), name.str());
  } else {
    add(*node, path);
  }
  return found;
}

void read_keys(const FoundTable& found, const TableInfo& info, const std::vector<Key>& keys, void* part,
               Reading& reading) {
  const auto path_of = [&](const std::string& name) { return found.path.empty() ? name : found.path + "." + name; };
  for (const Key& key : keys) {
    if (!key.info.is_in(reading.dim)) continue;
    const std::string name(key.info.name);
    if (const toml::node* const node = found.table.get(name)) {
      key.read(part, {*node, path_of(name), reading}, key.info);
    } else if (key.info.required &&
               std::ranges::none_of(key.info.unless, [&](const auto& other) { return found.table.contains(other); })) {
      reading.problem(location_of(found.table.source()), found.path, fmt::format("the key '{}' is missing", name));
    }
  }
  std::vector<std::string> known;
  for (const KeyInfo& key : info.keys)
    if (key.is_in(reading.dim)) known.emplace_back(key.name);
  known.insert(known.end(), info.tables.begin(), info.tables.end());
  for (auto&& [key, node] : found.table) {
    const std::string name(key.str());
    if (std::ranges::find(known, name) == known.end())
      reading.problem(location_of(key.source()), found.path, unknown_word("unknown key", name, known), path_of(name));
  }
}

std::vector<KeyInfo> infos_of(const std::vector<Key>& keys) {
  std::vector<KeyInfo> infos;
  for (const Key& key : keys) infos.push_back(key.info);
  return infos;
}

}  // namespace stillpoint
