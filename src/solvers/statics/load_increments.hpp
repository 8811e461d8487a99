// The division of the load by a static solver: the increment from one load factor s to the next is halved when it fails
// and doubled after one that was easy. Where contact with friction closes within an increment, the way to it counts as
// slip: there the first one is small, and each of the next twice as long up to the usual length.
#pragma once

#include <stillpoint/state_archive.hpp>

#include <algorithm>

namespace stillpoint {

class LoadIncrements {
 public:
  static constexpr double small = 1.0 / 256;  // of the usual length
  struct Sizes {
    double first, largest, smallest;  // shares of the load
    bool sets_out_small = false;
  };
  explicit LoadIncrements(const Sizes& sizes)
      : sizes_(sizes),
        size_(sizes.sets_out_small ? std::max(small * first(), std::min(2 * sizes.smallest, first())) : first()),
        sets_out_(sizes.sets_out_small) {}

  double from() const { return from_; }  // load factor of the last equilibrium
  double to() const { return size_ < 0.999 * (1 - from_) ? from_ + size_ : 1; }
  bool at_end() const { return from_ >= 1; }
  double size() const { return size_; }
  bool is_divided() const { return size_ < sizes_.first || from_ > 0; }

  void reached(bool easily) {
    from_ = to();
    sets_out_ = sets_out_ && size_ < first();
    if (easily || sets_out_) size_ = std::min(2 * size_, sizes_.largest);
  }
  /// Halves an increment that failed. False if the half is smaller than the smallest increment.
  bool halve() {
    sets_out_ = false;
    size_ = (to() - from_) / 2;
    return size_ >= sizes_.smallest;
  }
  /// Makes the next increment as long as the first one was.
  void begin_anew() {
    size_ = first();
    sets_out_ = false;
  }
  void start_over() { *this = LoadIncrements(sizes_); }

  void archive(const StateArchive& state) {
    state("load_factor", from_);
    state("load_increment", size_);
    state("load_sets_out", sets_out_);
  }

 private:
  double first() const { return std::min(sizes_.first, sizes_.largest); }

  Sizes sizes_;
  double from_ = 0, size_;
  bool sets_out_;  // whether increments still grow to the usual length
};

}  // namespace stillpoint
