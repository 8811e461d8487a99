// A value that may be left open.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string_view>
#include <utility>

namespace stillpoint {

template <class T>
concept Array = requires(const T& value) {
  value.begin(), value.size(), value[0];
};
template <class T>
struct EntryOf {
  using type = T;
};
template <Array T>
struct EntryOf<T> {
  using type = typename T::value_type;
};

/// A value that is asked for once it is assigned, and then stays. Otherwise it is a default, in whose place resolve()
/// may take another value, with a word why. It reads like its value.
template <class T>
class Choice {
 public:
  static constexpr std::string_view by_default = "by default";

  Choice() = default;
  Choice(T asked) : value_(asked), asked_(std::move(asked)) {}
  Choice(std::initializer_list<typename EntryOf<T>::type> asked) requires Array<T> : Choice(T(asked)) {}
  static Choice open(T fallback) {
    Choice choice;
    choice.value_ = std::move(fallback);
    return choice;
  }

  operator const T&() const { return value_; }
  const T& value() const { return value_; }
  /// As it was assigned; empty: nobody asked.
  const std::optional<T>& asked() const { return asked_; }
  bool is_asked() const { return asked_.has_value(); }
  std::string_view why() const { return is_asked() ? "asked for" : why_; }

  /// Takes this value, unless another one is asked for. why: outlives it.
  void take(T value, std::string_view why = by_default) {
    value_ = asked_ ? *asked_ : std::move(value);
    why_ = why;
  }
  /// Takes what comes of the value that is asked for, or of the default: a box that is cut to what lies in it.
  void become(T value) { value_ = std::move(value); }

  auto operator[](std::size_t k) const requires Array<T> { return value_[k]; }
  auto begin() const requires Array<T> { return value_.begin(); }
  auto end() const requires Array<T> { return value_.end(); }
  std::size_t size() const requires Array<T> { return value_.size(); }
  bool empty() const requires Array<T> { return value_.empty(); }
  friend bool operator==(const Choice& choice, const T& value) requires Array<T> { return choice.value_ == value; }

 private:
  T value_{};
  std::optional<T> asked_;
  std::string_view why_ = by_default;
};

}  // namespace stillpoint
