// A sum of doubles that does not depend on the order in which they are added, nor on how they are divided among threads
// [after Demmel and Nguyen, Parallel Reproducible Summation, IEEE Trans. Computers 64(7), 2015].
//
// The number line is cut at fixed places, 2^32k, so that a double is a sum of digits, whole numbers between two cuts,
// which are added exactly. Of all digits the three are kept that the largest term needs:
//
//     Σ t ≈ (s₀ 2⁶⁴ + s₁ 2³² + s₂) Q,   Q = 2^{32(b−3)},   |t| < 2^{32b−1} for all terms
//
// which is the sum of the terms, each rounded to a multiple of Q, that is to 2⁻⁶⁴ of the largest of them or better.
// With another b, as some of the terms alone have, digits s₀ and s₁ mean the same: a sum can go on with a larger term.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace stillpoint {

class ExactSum {
 public:
  /// Adds term(begin), term(begin + 1) … before end; no more than 2^31 in all.
  template <class Term>
  void add(std::size_t begin, std::size_t end, const Term& term) {
    constexpr std::size_t piece = 512;  // digits of 31 bits and a sign, whose sum in a double is exact
    if (bin_ == lowest && begin < end) hold(std::abs(term(begin)));  // most likely they all are of its kind
    for (std::size_t first = begin; first < end; first += piece)
      add_piece(first, end - first < piece ? end - first : piece, term);
  }

  void add(const ExactSum& other) {
    if (other.bin_ > bin_) raise(other.bin_);
    const auto lower = static_cast<std::size_t>(bin_ - other.bin_);
    for (std::size_t k = lower; k < digits; ++k) sums_[k] += other.sums_[k - lower];
    beside_ += other.beside_;
  }

  /// The sum, rounded once; NaN or infinite if a term is.
  double value() const {
    __extension__ using Whole = __int128;
    Whole all = 0;
    for (const std::int64_t sum : sums_) all = all * (Whole{1} << bits) + sum;
    const double sum = std::ldexp(static_cast<double>(all), bits * (bin_ - 3));
    return beside_ == 0 ? sum : beside_ + sum;  // a NaN is not 0
  }

 private:
  static constexpr std::size_t lanes = 8, digits = 3;
  static constexpr int bits = 32, lowest = -28, highest = 31;  // bins in which no cut is infinite or subnormal

  // 2^exponent, of a normal number
  static constexpr double power(int exponent) {
    return std::bit_cast<double>(static_cast<std::int64_t>(1023 + exponent) << 52);
  }
  static constexpr double end_of(int bin) { return power(bits * bin - 1); }
  // The unit of digit k in this bin.
  static constexpr double unit(int bin, int k, int exponent = 1) { return power(exponent * bits * (bin - 1 - k)); }
  // A number of this size has no binary places behind that unit, so that adding it and taking it away again rounds to
  // the unit.
  static constexpr double cut(int bin, int k) { return 0x1.8p52 * unit(bin, k); }

  template <class Term>
  void add_piece(std::size_t first, std::size_t count, const Term& term) {
    std::array<double, lanes> s0{}, s1{}, s2{}, largest{};
    const double end = end_of(bin_), cut0 = cut(bin_, 0), cut1 = cut(bin_, 1), cut2 = cut(bin_, 2);
    const auto add_to = [&](std::size_t lane, double t) {
      const double size = std::abs(t);
      largest[lane] = size > largest[lane] ? size : largest[lane];
      const double digit0 = (t + cut0) - cut0, rest = t - digit0;
      const double digit1 = (rest + cut1) - cut1;
      s0[lane] += digit0;
      s1[lane] += digit1;
      s2[lane] += ((rest - digit1) + cut2) - cut2;
    };
    const std::size_t whole = count / lanes * lanes;
    for (std::size_t i = 0; i < whole; i += lanes) {
#pragma omp simd
      for (std::size_t lane = 0; lane < lanes; ++lane) add_to(lane, term(first + i + lane));
    }
    for (std::size_t i = whole; i < count; ++i) add_to(i - whole, term(first + i));

    double of_all = 0;
    std::array<double, digits> sum{};
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      of_all = largest[lane] > of_all ? largest[lane] : of_all;
      sum[0] += s0[lane];
      sum[1] += s1[lane];
      sum[2] += s2[lane];
    }
    const bool finite = sum[2] - sum[2] == 0;  // what no number has been compared with is not known to be larger
    if (finite && of_all < end) {
      for (std::size_t k = 0; k < digits; ++k)
        sums_[k] += static_cast<std::int64_t>(sum[k] * unit(bin_, static_cast<int>(k), -1));
    } else if (finite && hold(of_all)) {
      add_piece(first, count, term);
    } else {
      for (std::size_t i = first; i < first + count; ++i) add_one(term(i));
    }
  }
  void add_one(double t) {
    if (hold(std::abs(t))) {
      add_piece(0, 1, [t](std::size_t /*i*/) { return t; });
    } else {
      beside_ += t;
    }
  }

  // Whether there is a bin for terms of this size, which is then taken if it is above the present one.
  bool hold(double size) {
    if (!(size < end_of(highest))) return false;
    if (size >= end_of(bin_)) {
      const int above = std::ilogb(size) + 2;  // size < 2^{above−1}
      raise(above > 0 ? (above + bits - 1) / bits : -(-above / bits));
    }
    return true;
  }
  void raise(int bin) {
    const auto by = static_cast<std::size_t>(bin - bin_);
    for (std::size_t k = digits; k-- > 0;) sums_[k] = k >= by ? sums_[k - by] : 0;
    bin_ = bin;
  }

  int bin_ = lowest;                         // b
  std::array<std::int64_t, digits> sums_{};  // s
  double beside_ = 0;                        // the sum of terms that are no numbers, or too large for a bin
};

}  // namespace stillpoint
