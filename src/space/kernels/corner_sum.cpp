#include "space/kernels/corner_sum.hpp"

#include <algorithm>

namespace stillpoint {

void CornerSum::rebuild(const std::vector<int>& function_of_corner, std::size_t functions, const Ranks* ranks,
                        const std::vector<CellPlace>& places) {
  ranks_ = ranks;
  shared_.reset();
  if (ranks) shared_ = std::make_unique<SharedCorners>(*ranks, function_of_corner, functions, places);
  begin_.assign(functions + 1, 0);
  corner_.resize(function_of_corner.size() + others());
  for (const int function : function_of_corner) ++begin_[static_cast<std::size_t>(function) + 1];
  for (std::size_t c = 0; c < others(); ++c) ++begin_[static_cast<std::size_t>(shared_->others()[c].function) + 1];
  for (std::size_t f = 0; f < functions; ++f) begin_[f + 1] += begin_[f];
  next_.assign(begin_.begin(), begin_.end() - 1);
  const auto list = [this](int function, std::size_t corner) {
    corner_[static_cast<std::size_t>(next_[static_cast<std::size_t>(function)]++)] = static_cast<int>(corner);
  };
  for (std::size_t c = 0; c < function_of_corner.size(); ++c) list(function_of_corner[c], c);
  for (std::size_t c = 0; c < others(); ++c) list(shared_->others()[c].function, function_of_corner.size() + c);
  if (others() > 0) sort_corners(places, function_of_corner.size() / std::max<std::size_t>(places.size(), 1));
}

void CornerSum::sort_corners(const std::vector<CellPlace>& places, std::size_t per_cell) {
  const std::size_t own = shared_->corners();
  const auto place = [&](int corner) {
    const auto c = static_cast<std::size_t>(corner);
    return c < own ? places[c / per_cell] : shared_->others()[c - own].of;
  };
  for (const SharedCorners::Other& other : shared_->others()) {
    const auto f = static_cast<std::size_t>(other.function);
    const auto begin = corner_.begin() + begin_[f], end = corner_.begin() + begin_[f + 1];
    const auto before = [&](int a, int b) { return place(a) < place(b); };
    if (!std::is_sorted(begin, end, before)) std::stable_sort(begin, end, before);
  }
}

}  // namespace stillpoint
