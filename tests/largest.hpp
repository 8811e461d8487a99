// Largest and smallest values that a NaN cannot hide from. std::max(x, NaN) is x, so that a largest error taken by it
// is 0 if every error is NaN; here it is NaN, which no CHECK(error < …) lets pass. The largest of no values is NaN too:
// a test that has compared nothing has shown nothing.
#pragma once

#include <cmath>
#include <iterator>
#include <limits>

/// The largest of the values taken so far.
class Largest {
 public:
  void take(double value) {
    if (none_ || std::isnan(value) || value > value_) value_ = value;  // nothing is > NaN: it stays
    none_ = false;
  }
  void take_magnitude(double value) { take(std::abs(value)); }
  double value() const { return value_; }

 private:
  double value_ = std::numeric_limits<double>::quiet_NaN();
  bool none_ = true;
};

/// The smallest of the values taken so far.
class Smallest {
 public:
  void take(double value) { largest_.take(-value); }
  double value() const { return -largest_.value(); }

 private:
  Largest largest_;
};

/// max_i |a_i|
template <class Range>
double largest_magnitude(const Range& a) {
  Largest largest;
  for (const double value : a) largest.take_magnitude(value);
  return largest.value();
}

/// max_i |a_i − b_i|; NaN if there are not as many of both.
template <class Range, class OtherRange>
double largest_difference(const Range& a, const OtherRange& b) {
  if (std::size(a) != std::size(b)) return std::numeric_limits<double>::quiet_NaN();
  Largest largest;
  auto other = std::begin(b);
  for (const double value : a) largest.take_magnitude(value - *other++);
  return largest.value();
}

/// max_i a_i and min_i a_i
template <class Range>
double largest_value(const Range& a) {
  Largest largest;
  for (const double value : a) largest.take(value);
  return largest.value();
}
template <class Range>
double smallest_value(const Range& a) {
  Smallest smallest;
  for (const double value : a) smallest.take(value);
  return smallest.value();
}
