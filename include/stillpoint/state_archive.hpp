// Saved states of objects, by name: one function, archive(), saves and restores.
//
//   void archive(const StateArchive& state) {
//     state("t", t_);
//     integrator_->archive(state.part("integrator"));
//   }
#pragma once

#include <stillpoint/types.hpp>

#include <array>
#include <concepts>
#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace stillpoint {

/// Thrown if a state cannot be restored; what() says why.
class StateError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A saved value, and all saved values by their paths "part/name".
using SavedValue = std::variant<std::vector<double>, std::vector<std::int64_t>, std::string>;
using SavedState = std::map<std::string, SavedValue, std::less<>>;

/// Saves into a SavedState or restores from it. Every double comes back with the same bits.
class StateArchive {
 public:
  /// Saves into `to`, which must outlive this object.
  static StateArchive saving(SavedState& to) { return {&to, nullptr}; }
  /// Restores from `from`, which must outlive this object.
  static StateArchive restoring(const SavedState& from) { return {nullptr, &from}; }
  bool restores() const { return from_ != nullptr; }

  /// The archive of a part, whose names cannot clash with those of others.
  StateArchive part(std::string_view name) const { return {to_, from_, path(name) + "/"}; }

  /// Whether something of this part was saved, in an archive that restores.
  bool has_part(std::string_view name) const;
  /// Saves or restores all values of this part, with their paths in it.
  void everything(SavedState& values) const;

  /// Saves or restores a value. Restoring throws StateError if there is no value of that name and kind, or if it is of
  /// another size than its destination.
  template <class T>
  void operator()(std::string_view name, T& value) const {
    if constexpr (std::floating_point<T>) {
      single<double>(name, value);
    } else if constexpr (std::integral<T> || std::is_enum_v<T>) {
      single<std::int64_t>(name, value);
    } else {
      all(name, value);
    }
  }
  /// Does so with several values, each after its name.
  template <class T, class... Others>
  requires(sizeof...(Others) > 0) void operator()(std::string_view name, T& value, Others&&... others) const {
    (*this)(name, value);
    (*this)(std::forward<Others>(others)...);
  }
  /// Saves or restores an array of fixed size.
  void operator()(std::string_view name, Vec values) const;
  /// Saves or restores a vector of n values, or an empty one.
  template <class T>
  void none_or(std::size_t n, std::string_view name, std::vector<T>& values) const {
    all(name, values);
    if (!values.empty()) expect_size(name, values.size(), n);
  }
  /// Saves or restores array_of(item), a std::array of numbers, of all items as one value.
  template <class Items, class ArrayOf>
  void each(std::string_view name, Items& items, const ArrayOf& array_of) const {
    std::vector<double> all;
    for (auto& item : items) all.insert(all.end(), array_of(item).begin(), array_of(item).end());
    (*this)(name, Vec(all));
    auto from = all.begin();
    for (auto& item : items) {
      for (double& number : array_of(item)) number = *from++;
    }
  }

 private:
  StateArchive(SavedState* to, const SavedState* from, std::string prefix = "")
      : to_(to), from_(from), prefix_(std::move(prefix)) {}

  std::string path(std::string_view name) const { return prefix_ + std::string(name); }
  void put(std::string_view name, SavedValue value) const;
  template <class Stored>
  const Stored& get(std::string_view name) const;
  void expect_size(std::string_view name, std::size_t found, std::size_t expected) const;

  template <class Stored, class T>
  void single(std::string_view name, T& value) const {
    if (!restores()) return put(name, std::vector<Stored>{static_cast<Stored>(value)});
    const auto& stored = get<std::vector<Stored>>(name);
    expect_size(name, stored.size(), 1);
    value = static_cast<T>(stored.front());
  }
  template <class T>
  void all(std::string_view name, std::vector<T>& values) const {
    using Stored = std::conditional_t<std::floating_point<T>, double, std::int64_t>;
    if (!restores()) {
      std::vector<Stored> stored(values.size());
      for (std::size_t k = 0; k < values.size(); ++k) stored[k] = static_cast<Stored>(values[k]);
      return put(name, std::move(stored));
    }
    const auto& stored = get<std::vector<Stored>>(name);
    values.resize(stored.size());
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = static_cast<T>(stored[k]);
  }
  template <class T>
  void all(std::string_view name, std::optional<T>& value) const {
    std::vector<T> values;
    if (value) values.push_back(*value);
    all(name, values);
    if (values.empty()) value.reset();
    if (!values.empty()) value = values.front();
  }
  template <class T, std::size_t N>
  void all(std::string_view name, std::array<T, N>& values) const {
    std::vector<T> list(values.begin(), values.end());
    all(name, list);
    expect_size(name, list.size(), N);
    std::copy(list.begin(), list.end(), values.begin());
  }
  void all(std::string_view name, std::string& text) const;
  void all(std::string_view name, std::vector<std::string>& texts) const;

  SavedState* to_;
  const SavedState* from_;
  std::string prefix_;
};

}  // namespace stillpoint
