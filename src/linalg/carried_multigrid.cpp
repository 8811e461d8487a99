#include <algorithm>
#include <mutex>
#include <numeric>
#include <utility>
#include <vector>

#include <Eigen/SparseCore>

#include "base/parallel_loop.hpp"
#include "linalg/multigrid.hpp"

namespace stillpoint {
namespace {

constexpr int none = -1;

ConstVec position(const NodalLayout& layout, int node) {
  const auto dim = static_cast<std::size_t>(layout.dim);
  return ConstVec(layout.positions).subspan(static_cast<std::size_t>(node) * dim, dim);
}

// For each unknown of `to`, the unknown of `from` at the same place in the same direction, or none.
std::vector<int> matches(const NodalLayout& from, const NodalLayout& to) {
  const auto before = [](ConstVec a, ConstVec b) { return std::ranges::lexicographical_compare(a, b); };
  const auto place = [&from](int unknown) { return position(from, from.node[static_cast<std::size_t>(unknown)]); };
  std::vector<int> sorted(from.node.size());
  std::iota(sorted.begin(), sorted.end(), 0);
  std::ranges::stable_sort(sorted, before, place);
  std::vector<int> match(to.node.size(), none);
  for (std::size_t k = 0; k < match.size(); ++k) {
    const ConstVec here = position(to, to.node[k]);
    auto other = std::ranges::lower_bound(sorted, here, before, place);
    for (; other != sorted.end() && std::ranges::equal(place(*other), here); ++other) {
      if (from.component[static_cast<std::size_t>(*other)] == to.component[k]) match[k] = *other;
    }
  }
  return match;
}

class Carried final : public Multigrid {
 public:
  Carried(std::shared_ptr<const Multigrid> B, std::size_t old_size, std::vector<int> match, const SparseMatrix& K)
      : B_(std::move(B)), match_(std::move(match)), diagonal_(match_.size()), old_(old_size) {
    for (std::size_t k = 0; k < match_.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      diagonal_[k] = K.coeff(i, i);
    }
  }

  void apply(ConstVec b, Vec x) const override {
    const std::scoped_lock lock(using_);
    for_each_index(old_.size(), [old = old_.data()](std::size_t k) { old[k] = 0; });
    for_each_index(b.size(), [=, match = match_.data(), old = old_.data()](std::size_t k) {
      if (match[k] != none) old[match[k]] = b[k];
    });
    B_->apply(old_, old_);
    for_each_index(x.size(), [=, match = match_.data(), old = old_.data(), d = diagonal_.data()](std::size_t k) {
      x[k] = match[k] == none ? b[k] / d[k] : old[match[k]];
    });
  }
  int levels() const override { return B_->levels(); }
  std::size_t bytes() const override {
    return B_->bytes() + match_.size() * sizeof(int) + (old_.size() + diagonal_.size()) * sizeof(double);
  }

 private:
  std::shared_ptr<const Multigrid> B_;
  std::vector<int> match_;
  std::vector<double> diagonal_;
  mutable std::vector<double> old_;
  mutable std::mutex using_;
};

}  // namespace

std::shared_ptr<const Multigrid> carry(std::shared_ptr<const Multigrid> B, const NodalLayout& from,
                                       const NodalLayout& to, const SparseMatrix& K) {
  return std::make_shared<Carried>(std::move(B), from.node.size(), matches(from, to), K);
}

}  // namespace stillpoint
