// From the C++ type of a member of Scene to the reading of its key.
#pragma once

#include <concepts>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "scene/input/keys.hpp"
#include "scene/input/toml_source.hpp"

namespace stillpoint {

template <class T>
struct Unwrapped {  // T itself, or the type inside an optional, a choice or an array
  using type = T;   // the type of one value
  using value = T;  // the type of all values together
  static constexpr bool is_optional = false;
  static constexpr int depth = 0;
};
template <class T>
struct Unwrapped<std::optional<T>> : Unwrapped<T> {
  static constexpr bool is_optional = true;
};
template <class T>
struct Unwrapped<Choice<T>> : Unwrapped<T> {};
template <class T>
struct Unwrapped<std::vector<T>> {
  using type = typename Unwrapped<T>::type;
  using value = std::vector<T>;
  static constexpr bool is_optional = false;
  static constexpr int depth = 1 + Unwrapped<T>::depth;
};
template <class Row>
struct UnwrappedRow {  // of numbers
  using type = double;
  using value = Row;
  static constexpr bool is_optional = false;
  static constexpr int depth = 1;
};
template <>
struct Unwrapped<GridPiece> : UnwrappedRow<GridPiece> {};
template <>
struct Unwrapped<StrengthRow> : UnwrappedRow<StrengthRow> {};
template <class T>
inline constexpr bool is_row = std::is_base_of_v<UnwrappedRow<T>, Unwrapped<T>>;

/// An option: its word, by number. A whole number may be written as a word too.
std::optional<std::int64_t> read_word(const Value& value, const KeyInfo& key);
/// True if the value of a key that takes a number or a word is the word; a misspelt word is reported, and counts.
bool is_word(const Value& value, const KeyInfo& key);
std::optional<std::string> read_string(const Value& value, const KeyInfo& key);
/// A row of numbers.
template <class Row>
std::optional<Row> read_row(const Value& value, const KeyInfo& key);
/// The entries of an array: as many as there are coordinates, or components of a stress, or any number of them (list).
std::optional<std::vector<Value>> entries_of(const Value& value, const KeyInfo& key, bool list, bool nested);
std::string variables_of(const KeyInfo& key, int dim);

template <class T>
std::optional<T> read_value(const Value& value, const KeyInfo& key, bool nested = false) {
  const auto converted = [](auto&& read) { return read ? std::optional(static_cast<T>(*read)) : std::nullopt; };
  if constexpr (is_row<T>) {
    return read_row<T>(value, key);
  } else if constexpr (Unwrapped<T>::depth > 0) {
    const auto entries = entries_of(value, key, key.list && !nested, nested);
    if (!entries) return std::nullopt;
    T result;
    for (const Value& entry : *entries) {
      auto one = read_value<typename T::value_type>(entry, key, /*nested=*/true);
      if (one) result.push_back(std::move(*one));
      // The entries of one row that stands alone are no rows, for one reason.
      if (!one && is_row<typename T::value_type>) break;
    }
    return result.size() == entries->size() ? std::optional(std::move(result)) : std::nullopt;
  } else if constexpr (std::is_same_v<T, double>) {
    return read_number(value, key.range);
  } else if constexpr (std::is_same_v<T, Expression>) {
    return read_formula(value, variables_of(key, value.reading.dim));
  } else if constexpr (std::is_enum_v<T> || std::is_same_v<T, bool>) {
    if (std::is_same_v<T, bool> && key.words.empty()) return converted(read_truth(value));
    return converted(read_word(value, key));
  } else if constexpr (std::integral<T>) {
    return converted(key.words.empty() ? read_whole(value, key.range) : read_word(value, key));
  } else {
    return converted(read_string(value, key));
  }
}

template <class T>
constexpr Kind kind_of_type() {
  if (std::is_same_v<T, double>) return Kind::number;
  if (std::is_same_v<T, Expression>) return Kind::formula;
  return std::integral<T> && !std::is_same_v<T, bool> ? Kind::whole : Kind::text;
}

/// The default of a key as a scene would write it; empty: none.
template <class T>
std::string told_default(const T& value, const KeyInfo& key) {
  if constexpr (std::is_enum_v<T> || std::is_same_v<T, bool>) {
    if (std::is_same_v<T, bool> && key.words.empty()) return value == T{} ? "false" : "true";
    return std::string(key.words.at(static_cast<std::size_t>(value)).name);
  } else if constexpr (std::is_arithmetic_v<T>) {
    return fmt::format("{}", value);
  } else if constexpr (std::is_same_v<T, std::string>) {
    return value;
  } else {
    return std::is_same_v<T, Expression> ? "0" : "";
  }
}

template <class T>
std::string told_default(const Choice<T>& choice, const KeyInfo& key) {
  return told_default(choice.value(), key);
}

/// A key, and how its value gets into the part of a scene that its table describes, of whatever type that is: the same
/// for all tables, or the compiler would make all that follows anew for each of them.
struct Key {
  KeyInfo info;
  std::function<void(void* part, const Value& value, const KeyInfo& info)> read;
};

/// access: a pointer to the member of a Spec that takes the value, or a function from a Spec to it. on_word: what a
/// number's word does; without it the member becomes empty.
template <class Spec, class Access>
Key key_of(std::string_view name, Access access, std::string_view help, const KeyInfo& about,
           void (*on_word)(Spec&) = nullptr) {
  using Member = std::remove_cvref_t<std::invoke_result_t<Access, Spec&>>;
  using T = std::conditional_t<Unwrapped<Member>::depth == 0, typename Unwrapped<Member>::type,
                               typename Unwrapped<Member>::value>;
  KeyInfo info = about;
  info.name = name;
  info.help = help;
  using Type = typename Unwrapped<Member>::type;
  info.kind = std::is_same_v<Type, bool> && info.words.empty() ? Kind::truth : kind_of_type<Type>();
  info.shape = !info.row.empty()                ? Shape::rows
               : Unwrapped<Member>::depth > 1   ? Shape::positions
               : Unwrapped<Member>::depth == 0  ? Shape::one
               : info.list                      ? Shape::list
               : info.of_stress || info.of_turn ? Shape::components
                                                : Shape::axes;
  if (Spec spec; info.fallback.empty() && !info.required) info.fallback = told_default(std::invoke(access, spec), info);
  return {std::move(info), [access, on_word](void* part, const Value& value, const KeyInfo& key) {
            Spec& spec = *static_cast<Spec*>(part);
            if (std::is_same_v<T, double> && !key.words.empty() && is_word(value, key)) {
              if (on_word) on_word(spec);
            } else if (auto read = read_value<T>(value, key)) {
              std::invoke(access, spec) = std::move(*read);
            }
          }};
}
/// One table that was found in a file.
struct FoundTable {
  const toml::table& table;
  std::string path;  // "support[0]", "material.sand"
  std::string name;  // the name of a named table, "sand"
};
/// Every table of a kind in the file; an entry there that is no table is reported.
std::vector<FoundTable> find_tables(const TableInfo& info, const toml::table& root, Reading& reading);
/// Reads the keys of a table into the part of a scene that they are for; an entry that is neither a key nor a table of
/// it is reported.
void read_keys(const FoundTable& found, const TableInfo& info, const std::vector<Key>& keys, void* part,
               Reading& reading);
std::vector<KeyInfo> infos_of(const std::vector<Key>& keys);

/// The keys of the table added last, in the order of its rows.
template <class Spec>
class Rows {
 public:
  Rows(TableInfo& info, std::shared_ptr<std::vector<Key>> keys) : info_(info), keys_(std::move(keys)) {}

  /// As key_of().
  template <class Access>
  Rows& key(std::string_view name, Access access, std::string_view help, const KeyInfo& about = {},
            void (*on_word)(Spec&) = nullptr) {
    keys_->push_back(key_of<Spec>(name, access, help, about, on_word));
    info_.keys.push_back(keys_->back().info);
    return *this;
  }
  /// The key before this is read in a way of its own.
  Rows& read_by(void (*read)(Spec&, const Value&, const KeyInfo&)) {
    keys_->back().read = [read](void* part, const Value& value, const KeyInfo& key) {
      read(*static_cast<Spec*>(part), value, key);
    };
    return *this;
  }

 private:
  TableInfo& info_;
  std::shared_ptr<std::vector<Key>> keys_;
};

struct Tables {
  std::vector<TableInfo> all;

  /// access: the part of a Scene that the table describes: plain data, an optional of it, or an array, of which each
  /// [[table]] is an entry.
  template <class Access>
  auto add(TableInfo info, Access access) {
    using Part = std::remove_cvref_t<std::invoke_result_t<Access, Scene&>>;
    using Spec = typename Unwrapped<Part>::type;
    const auto keys = std::make_shared<std::vector<Key>>();
    info.read = [access, keys](const TableInfo& self, const toml::table& root, Scene& scene, Reading& reading) {
      for (const FoundTable& found : find_tables(self, root, reading)) {
        Part& part = std::invoke(access, scene);
        if constexpr (std::is_same_v<Part, Spec>) {
          read_keys(found, self, *keys, &part, reading);
        } else if constexpr (Unwrapped<Part>::is_optional) {
          read_keys(found, self, *keys, &part.emplace(), reading);
        } else {
          read_keys(found, self, *keys, &part.emplace_back(), reading);
        }
      }
    };
    return Rows<Spec>(all.emplace_back(std::move(info)), keys);
  }
};

}  // namespace stillpoint
