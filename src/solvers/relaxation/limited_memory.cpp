#include "solvers/relaxation/limited_memory.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/parallel_loop.hpp"

namespace stillpoint {

LimitedMemory::LimitedMemory(const VectorSpace& vectors, const Mass& mass, std::size_t most)
    : mass_(mass), sy_(most), a_(most), z_(vectors.make(mass.size())) {
  for (std::size_t k = 0; k < most; ++k) {
    s_.push_back(vectors.make(mass.size()));
    y_.push_back(vectors.make(mass.size()));
  }
}

void LimitedMemory::remember(double alpha, const Vector& p, const Vector& before, const Vector& after) {
  const std::size_t k = (newest_ + 1) % s_.size();
  for_each_index(p.size(), [=, s = s_[k].span().data(), y = y_[k].span().data(), p = p.span().data(),
                            before = before.span().data(), after = after.span().data()](std::size_t i) {
    s[i] = alpha * p[i];
    y[i] = before[i] - after[i];
  });
  sy_[k] = dot(s_[k], y_[k]);
  mass_.solve(y_[k].span(), z_.span());
  const double yMy = dot(y_[k], z_);
  if (!(sy_[k] > 0) || !(yMy > 0)) {
    kept_ = std::min(kept_, s_.size() - 1);  // its slot was that of the oldest pair
    return;
  }
  scale_ = sy_[k] / yMy;
  newest_ = k;
  kept_ = std::min(kept_ + 1, s_.size());
}

void LimitedMemory::apply(Vector& vector) {
  const Vec q = vector.span();
  for (std::size_t age = 0; age < kept_; ++age) {  // the newest first
    const std::size_t k = slot(age);
    a_[age] = dot(s_[k], vector) / sy_[k];
    for_each_index(q.size(), [=, a = a_[age], y = y_[k].span().data()](std::size_t i) { q[i] -= a * y[i]; });
  }
  mass_.solve(q, q);
  for_each_index(q.size(), [=, scale = scale_](std::size_t i) { q[i] *= scale; });
  for (std::size_t age = kept_; age-- > 0;) {
    const std::size_t k = slot(age);
    const double b = dot(y_[k], vector) / sy_[k];
    for_each_index(q.size(), [=, d = a_[age] - b, s = s_[k].span().data()](std::size_t i) { q[i] += d * s[i]; });
  }
}

void LimitedMemory::archive(const StateArchive& state) {
  for (std::size_t k = 0; k < s_.size(); ++k) {
    state(fmt::format("s_{}", k), s_[k].span());
    state(fmt::format("y_{}", k), y_[k].span());
  }
  state("sy", Vec(sy_));
  state("scale", scale_);
  state("newest", newest_);
  state("kept", kept_);
  if (newest_ >= s_.size() || kept_ > s_.size()) throw StateError("its pairs of steps are not in their ring");
}

}  // namespace stillpoint
