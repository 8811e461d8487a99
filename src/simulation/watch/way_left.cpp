#include "simulation/watch/way_left.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace stillpoint {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();
constexpr double share_at_rest = 0.2;  // share of the small way left that is taken for rest

template <class Values>
double longest_of(const Values& x, std::size_t dim) {
  double largest = 0;
  for (std::size_t k = 0; k + dim <= x.size(); k += dim) {
    double square = 0;
    for (std::size_t i = 0; i < dim; ++i) square += static_cast<double>(x[k + i]) * static_cast<double>(x[k + i]);
    if (std::isnan(square)) return square;
    largest = std::max(largest, square);
  }
  return std::sqrt(largest);
}

}  // namespace

void WayLeft::begin(double t) {
  begun_ = t;
  count_ = 0;
  next_kept_ = 1;
  last_.clear();
  kept_.clear();
  relative_ = exponent_ = endless;
}

void WayLeft::add(double t, std::size_t dim, ConstVec x) {
  dim_ = dim;
  last_.push_back({t, {x.begin(), x.end()}});
  if (last_.size() > 3) last_.pop_front();
  ++count_;
  const double size = longest_of(x, dim);
  if (size == 0) {
    relative_ = last_.size() < 3 ? endless : 0;
  } else {
    const double whole = from_the_whole(size);  // sets the exponent as well
    relative_ = last_.size() < 3 ? endless : std::max(from_last_blocks(size), whole) / size;
  }
  if (count_ >= next_kept_) {
    constexpr double ratio = 1.3;
    kept_.push_back(last_.back());
    next_kept_ = std::max(count_ + 1, static_cast<long>(std::ceil(ratio * static_cast<double>(count_))));
    while (kept_.size() > 1 && kept_[1].t - begun_ < (t - begun_) / 8) kept_.pop_front();
  }
}

double WayLeft::from_last_blocks(double size) const {
  const double d_1 = apart(last_[0], last_[1]), d_2 = apart(last_[1], last_[2]);
  const double v_1 = d_1 / (last_[1].t - last_[0].t), v_2 = d_2 / (last_[2].t - last_[1].t);
  const double tau = (last_[2].t - last_[0].t) / 2 / std::log(v_1 / v_2);
  const double left = v_2 == 0 ? 0 : v_1 > v_2 ? v_2 * tau : endless;
  return std::max(d_1, d_2) <= share_at_rest * small_ * size ? std::min(left, d_2) : left;
}

double WayLeft::from_the_whole(double size) {
  exponent_ = endless;
  const double age = last_.back().t - begun_;
  if (count_ < 4 || kept_.empty()) return 0;
  const Block &B = nearest(begun_ + age / 2), &A = nearest(begun_ + age / 4), &C = last_.back();
  if (!(A.t < B.t && B.t < C.t)) return endless;
  const double d_1 = apart(A, B), d_2 = apart(B, C);
  const double v_1 = d_1 / (B.t - A.t), v_2 = d_2 / (C.t - B.t);
  const double t_1 = (A.t + B.t) / 2 - begun_, t_2 = (B.t + C.t) / 2 - begun_;
  span_ = C.t - B.t;
  way_ = d_2;
  half_way_t_ = B.t;
  const double q = std::log(v_1 / v_2) / std::log(t_2 / t_1);
  const double left = v_2 == 0 ? 0 : q > 1 ? v_2 * std::pow(age / t_2, -q) * age / (q - 1) : endless;
  if (d_2 <= share_at_rest * small_ * size) return std::min(left, d_2);
  if (v_2 > 0) exponent_ = q;
  return left;
}

const WayLeft::Block& WayLeft::nearest(double t) const {
  return *std::ranges::min_element(kept_, {}, [t](const Block& block) { return std::abs(block.t - t); });
}

double WayLeft::apart(const Block& a, const Block& b) const {
  std::vector<float> difference(b.x);
  for (std::size_t i = 0; i < difference.size(); ++i) difference[i] -= a.x[i];
  return longest_of(difference, dim_);
}

std::vector<double> WayLeft::velocities() const {
  std::vector<double> v;
  if (kept_.empty()) return v;
  const Block &B = nearest(half_way_t_), &C = last_.back();
  for (std::size_t i = 0; i < C.x.size(); ++i)
    v.push_back((static_cast<double>(C.x[i]) - static_cast<double>(B.x[i])) / (C.t - B.t));
  return v;
}

void WayLeft::archive(const StateArchive& state) {
  state("begun", begun_, "dim", dim_, "count", count_, "next_kept", next_kept_);
  for (auto& [name, blocks] : {std::pair("last", &last_), std::pair("kept", &kept_)}) {
    std::size_t size = blocks->size();
    state(fmt::format("{}_blocks", name), size);
    constexpr std::size_t largest_count = 100;
    if (size > largest_count) throw StateError(fmt::format("it has {} blocks of creep: it was altered", size));
    blocks->resize(size);
    for (std::size_t k = 0; k < size; ++k) {
      state(fmt::format("{}_{}_t", name, k), (*blocks)[k].t);
      state(fmt::format("{}_{}_x", name, k), (*blocks)[k].x);
    }
  }
  for (const std::deque<Block>* blocks : {&last_, &kept_})
    for (const Block& block : *blocks)
      if (block.x.size() != size_of_block()) throw StateError("blocks of creep are of different sizes: it was altered");
  state("relative", relative_, "exponent", exponent_, "span", span_, "way", way_, "half_way_t", half_way_t_);
}

}  // namespace stillpoint
