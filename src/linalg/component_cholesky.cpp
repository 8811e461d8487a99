#include "linalg/component_cholesky.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/parallel_loop.hpp"

namespace stillpoint {
namespace {

constexpr std::size_t largest_dense = 64;  // unknowns: a factor of 16 kB, and no more work than a sparse one's indices

using Entries = std::span<const Eigen::Triplet<double>>;

// Sets of places that are united, each known by its first.
class UnitedPlaces {
 public:
  explicit UnitedPlaces(std::size_t count) : towards_(count) { std::iota(towards_.begin(), towards_.end(), 0UL); }

  std::size_t first_of(std::size_t place) {
    while (towards_[place] != place) place = towards_[place] = towards_[towards_[place]];
    return place;
  }
  void unite(std::size_t a, std::size_t b) {
    a = first_of(a), b = first_of(b);
    towards_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> towards_;
};

}  // namespace

ComponentCholesky::ComponentCholesky(Entries entries, std::size_t unknowns) {
  // The place of each unknown, first among those that have entries, in ascending order, and then in unknowns_.
  std::vector<std::size_t> place(unknowns, 0);
  for (const auto& entry : entries) place[static_cast<std::size_t>(entry.row())] = 1;
  std::vector<int> numbers;
  for (std::size_t k = 0; k < unknowns; ++k) {
    if (place[k] == 0) continue;
    place[k] = numbers.size();
    numbers.push_back(static_cast<int>(k));
  }
  const std::vector<std::size_t> ordered = order_by_components(entries, numbers, place);
  for (const int number : numbers)
    place[static_cast<std::size_t>(number)] = ordered[place[static_cast<std::size_t>(number)]];
  std::vector<const Component*> component_at(wide_);
  for (const Component& component : small_)
    std::fill_n(component_at.begin() + static_cast<std::ptrdiff_t>(component.first), component.size, &component);

  std::vector<Eigen::Triplet<double>> widely_coupled;
  for (const auto& entry : entries) {
    const std::size_t row = place[static_cast<std::size_t>(entry.row())],
                      column = place[static_cast<std::size_t>(entry.col())];
    if (row >= wide_) {
      widely_coupled.emplace_back(static_cast<int>(row - wide_), static_cast<int>(column - wide_), entry.value());
    } else if (row >= column) {
      const auto& [first, size, factor] = *component_at[row];
      factors_[factor + (row - first) * size + column - first] += entry.value();
    }
  }
  for (const Component& component : small_) positive_definite_ = factorise(component) && positive_definite_;
  if (wide_ == unknowns_.size()) return;
  const auto n = static_cast<Eigen::Index>(unknowns_.size() - wide_);
  SparseMatrix A(n, n);
  A.setFromTriplets(widely_coupled.begin(), widely_coupled.end());
  sparse_.emplace(A);
  positive_definite_ = positive_definite_ && sparse_->positive_definite();
}

// Takes the unknowns of these ascending numbers; returns where each of them is in unknowns_. place: of a number among
// them.
std::vector<std::size_t> ComponentCholesky::order_by_components(Entries entries, const std::vector<int>& numbers,
                                                                const std::vector<std::size_t>& place) {
  UnitedPlaces united(numbers.size());
  for (const auto& entry : entries)
    united.unite(place[static_cast<std::size_t>(entry.row())], place[static_cast<std::size_t>(entry.col())]);
  std::vector<std::size_t> component(numbers.size()), size(numbers.size(), 0), next(numbers.size());
  for (std::size_t k = 0; k < numbers.size(); ++k) ++size[component[k] = united.first_of(k)];
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (component[k] != k || size[k] > largest_dense) continue;
    small_.push_back({wide_, size[k], factors_.size()});
    factors_.resize(factors_.size() + size[k] * size[k]);
    next[k] = wide_;
    wide_ += size[k];
  }
  std::size_t next_wide = wide_;
  std::vector<std::size_t> places(numbers.size());
  unknowns_.resize(numbers.size());
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    places[k] = size[component[k]] > largest_dense ? next_wide++ : next[component[k]]++;
    unknowns_[places[k]] = numbers[k];
  }
  return places;
}

// L_ij = (A_ij − Σ_{k<j} L_ik L_jk)/L_jj,  L_ii² = A_ii − Σ_{k<i} L_ik²
bool ComponentCholesky::factorise(const Component& component) {
  const std::size_t n = component.size;
  double* const L = factors_.data() + component.factor;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double left = L[i * n + j];
      const double entry = left;
      for (std::size_t k = 0; k < j; ++k) left -= L[i * n + k] * L[j * n + k];
      if (j < i) {
        L[i * n + j] = left * L[j * n + j];  // whose diagonal is 1/L_jj
        continue;
      }
      if (!(left > std::numeric_limits<double>::epsilon() * entry)) return false;  // nothing but rounding is left
      L[i * n + i] = 1 / std::sqrt(left);
    }
  }
  return true;
}

void ComponentCholesky::solve(ConstVec b, Vec x) const {
  for_each_block(small_.size(), [=, this](std::size_t c) {
    const auto [first, n, factor] = small_[c];
    const double* const L = factors_.data() + factor;
    for (std::size_t i = 0; i < n; ++i) {  // L y = b
      double left = b[first + i];
      for (std::size_t k = 0; k < i; ++k) left -= L[i * n + k] * x[first + k];
      x[first + i] = left * L[i * n + i];
    }
    for (std::size_t i = n; i-- > 0;) {  // Lᵀ x = y
      const double now = x[first + i] * L[i * n + i];
      x[first + i] = now;
      for (std::size_t k = 0; k < i; ++k) x[first + k] -= L[i * n + k] * now;
    }
  });
  if (sparse_) sparse_->solve(b.subspan(wide_), x.subspan(wide_));
}

}  // namespace stillpoint
