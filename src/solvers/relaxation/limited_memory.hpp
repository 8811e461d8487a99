// The approximation of K⁻¹ by BFGS with limited memory, from the last steps [Nocedal, "Updating quasi-Newton matrices
// with limited storage", Math. Comp. 35 (1980)].
//
//   p = H Q,  H the two-loop recursion over the last pairs  s,  y = Q − Q⁺ = K s,  on  H_0 = (s·y/y·M⁻¹y) M⁻¹
//
// A pair with s·y ≤ 0, no positive stiffness along s, is left out.
#pragma once

#include <stillpoint/mass.hpp>
#include <stillpoint/state_archive.hpp>
#include <stillpoint/vector.hpp>

#include <cstddef>
#include <vector>

namespace stillpoint {

class LimitedMemory {
 public:
  /// most: the number of pairs that are kept. The mass has to outlive this object.
  LimitedMemory(const VectorSpace& vectors, const Mass& mass, std::size_t most);

  void forget() { kept_ = 0; }
  bool empty() const { return kept_ == 0; }
  /// Adds the pair of the step s = alpha p, over which Q went from `before` to `after`; all (n).
  void remember(double alpha, const Vector& p, const Vector& before, const Vector& after);
  /// Replaces q by H q, (n).
  void apply(Vector& q);

  void archive(const StateArchive& state);

 private:
  std::size_t slot(std::size_t age) const { return (newest_ + s_.size() - age) % s_.size(); }

  const Mass& mass_;
  std::vector<Vector> s_, y_;   // rings of `most` vectors (n)
  std::vector<double> sy_, a_;  // s·y; the factors that the first loop finds
  Vector z_;                    // M⁻¹y
  double scale_ = 1;            // s·y/y·M⁻¹y of the newest pair
  std::size_t newest_ = 0, kept_ = 0;
};

}  // namespace stillpoint
