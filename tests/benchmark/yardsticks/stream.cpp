// How fast the memory is: arrays that do not fit into any cache, of as many bytes a point as a step has to move. What a
// step reads alone (places and volumes) is a term of a triad a = b + 2 c, what it reads and writes anew (the history)
// is the rest of it, or copied.
#include <vector>

#include "yardstick.hpp"

namespace yardsticks {

namespace {

class Stream final : public Yardstick {
 public:
  // Numbers of a point that are read, and of its history, which is read and written.
  Stream(std::size_t read, std::size_t history)
      : read_(read), history_(history), constants_(read * count, 1.0), from_(history * count, 1.0), to_(from_.size()) {}

  std::size_t points() const override { return count; }
  std::size_t bytes_per_point() const override { return (read_ + 3 * history_) * sizeof(double); }
  void step() override {
    const double *b = from_.data(), *c = constants_.data();
    double* a = to_.data();
    const std::size_t triad = read_ * count, all = history_ * count;
    for (std::size_t i = 0; i < triad; ++i) a[i] = b[i] + 2 * c[i];
    // A loop that a compiler sees as one would write past the caches, which a step's cannot.
    for (std::size_t i = triad; i < all; ++i) a[i] = -b[i];
    from_.swap(to_);
  }
  std::string wrong() override {
    step();  // 1 becomes 3, or −1
    const std::size_t triad = read_ * count;
    return from_[0] == 3 && from_[triad - 1] == 3 && from_[triad] == -1 && from_.back() == -1 ? "" : "it is no triad";
  }

 private:
  static constexpr std::size_t count = std::size_t{1} << 21;  // 200 to 300 MB

  std::size_t read_, history_;
  std::vector<double> constants_, from_, to_;
};

}  // namespace

std::unique_ptr<Yardstick> make_stream_space() { return std::make_unique<Stream>(4, 7); }
std::unique_ptr<Yardstick> make_stream_plane() { return std::make_unique<Stream>(3, 5); }

}  // namespace yardsticks
