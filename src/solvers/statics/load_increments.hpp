// The division of the load by a static solver: the increment from one load factor s to the next is halved when it fails
// and doubled after one that was easy.
#pragma once

#include <stillpoint/state_archive.hpp>

#include <algorithm>

namespace stillpoint {

class LoadIncrements {
 public:
  struct Sizes {
    double first, largest, smallest;  // shares of the load
  };
  explicit LoadIncrements(const Sizes& sizes) : sizes_(sizes), size_(first()) {}

  double from() const { return from_; }  // load factor of the last equilibrium
  double to() const { return size_ < 0.999 * (1 - from_) ? from_ + size_ : 1; }
  bool at_end() const { return from_ >= 1; }
  double size() const { return size_; }
  bool is_divided() const { return size_ < sizes_.first || from_ > 0; }

  void reached(bool easily) {
    from_ = to();
    if (easily) size_ = std::min(2 * size_, sizes_.largest);
  }
  /// Halves an increment that failed. False if the half is smaller than the smallest increment.
  bool halve() {
    size_ = (to() - from_) / 2;
    return size_ >= sizes_.smallest;
  }
  /// Makes the next increment as long as the first one was.
  void begin_anew() { size_ = first(); }
  void start_over() { *this = LoadIncrements(sizes_); }

  void archive(const StateArchive& state) {
    state("load_factor", from_);
    state("load_increment", size_);
  }

 private:
  double first() const { return std::min(sizes_.first, sizes_.largest); }

  Sizes sizes_;
  double from_ = 0, size_;
};

}  // namespace stillpoint
