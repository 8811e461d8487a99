#include "space/kernels/shared_corners.hpp"

#include <algorithm>
#include <numeric>

namespace stillpoint {

SharedCorners::SharedCorners(const Ranks& ranks, const std::vector<int>& function_of_corner, std::size_t functions,
                             const std::vector<CellPlace>& places)
    : ranks_(ranks), corners_(function_of_corner.size()) {
  const auto count = static_cast<std::size_t>(ranks.count());
  std::vector<int>& owner = owner_;
  owner.assign(functions, ranks.count());
  for (const int function : function_of_corner) owner[static_cast<std::size_t>(function)] = ranks.rank();
  ranks.smallest(std::span(owner));
  begin_.assign(count + 1, 0);
  for (std::size_t f = 0; f < functions; ++f)
    if (reach(f)) ++begin_[static_cast<std::size_t>(owner[f]) + 1];
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  functions_.resize(begin_.back());
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t f = 0; f < functions; ++f)
    if (reach(f)) functions_[next[static_cast<std::size_t>(owner[f])]++] = static_cast<int>(f);

  std::vector<std::vector<Other>> to(count);
  sent_.resize(count);
  const std::size_t per_cell = places.empty() ? 0 : function_of_corner.size() / places.size();
  for (std::size_t c = 0; c < function_of_corner.size(); ++c) {
    const int function = function_of_corner[c], rank = owner[static_cast<std::size_t>(function)];
    if (rank == ranks.rank()) continue;
    to[static_cast<std::size_t>(rank)].push_back({function, places[c / per_cell]});
    sent_[static_cast<std::size_t>(rank)].push_back(c);
  }
  std::vector<Bytes> bytes;
  for (const std::vector<Other>& corners : to) bytes.push_back(bytes_of(corners));
  for (const Bytes& from : ranks.deliver(bytes)) {
    received_.push_back(from.size() / sizeof(Other));
    append_from(from, others_);
  }
  is_met_.assign(functions, 0);
  for (const Other& other : others_) is_met_[static_cast<std::size_t>(other.function)] = 1;
  for (std::size_t f = 0; f < functions; ++f)
    if (reach(f) && owner[f] != ranks.rank()) is_met_[f] = 1;
}

void SharedCorners::exchange(double* values, std::size_t components) const {
  to_.clear();
  from_.clear();
  std::size_t size = 0;
  for (const std::vector<std::size_t>& corners : sent_) size += corners.size() * components;
  packed_.resize(std::max(packed_.size(), size));
  double* next = packed_.data();
  double* received = values + corners_ * components;
  for (std::size_t rank = 0; rank < sent_.size(); ++rank) {
    if (const std::vector<std::size_t>& corners = sent_[rank]; !corners.empty()) {
      to_.push_back({static_cast<int>(rank), next, corners.size() * components});
      for (const std::size_t c : corners) next = std::copy_n(values + c * components, components, next);
    }
    if (received_[rank] > 0) from_.push_back({static_cast<int>(rank), received, received_[rank] * components});
    received += received_[rank] * components;
  }
  ranks_.exchange(to_, from_);
}

bool SharedCorners::gather(double* values, std::size_t components, bool is_good) const {
  constexpr std::size_t signals = 1;  // behind the values of each rank
  gathered_.resize(functions_.size() * components + signals * sent_.size());
  const auto mine = static_cast<std::size_t>(ranks_.rank());
  std::vector<std::size_t>& begin = gathered_begin_;
  begin.clear();
  for (std::size_t rank = 0; rank < begin_.size(); ++rank) begin.push_back(begin_[rank] * components + signals * rank);
  const auto of_function = [&](std::size_t k) { return values + static_cast<std::size_t>(functions_[k]) * components; };
  double* own = gathered_.data() + begin[mine];
  for (std::size_t k = begin_[mine]; k < begin_[mine + 1]; ++k) own = std::copy_n(of_function(k), components, own);
  *own = (is_good ? 0 : 1) + (ranks_.wishes_end() ? 2 : 0);
  ranks_.gather(gathered_.data(), begin);
  bool are_good = true;
  for (std::size_t rank = 0; rank < sent_.size(); ++rank) {
    const double* next = gathered_.data() + begin[rank];
    for (std::size_t k = begin_[rank]; k < begin_[rank + 1]; ++k, next += components)
      if (rank != mine) std::copy_n(next, components, of_function(k));
    const auto signal = static_cast<int>(*next);
    are_good = are_good && (signal & 1) == 0;
    if ((signal & 2) != 0) ranks_.hear_of_wish();
  }
  return are_good;
}

}  // namespace stillpoint
