// Which unknowns of the grid are free, which are prescribed by supports, and which no material reaches.
#pragma once

#include <vector>

namespace stillpoint {

/// Unknowns of the grid are numbered Dim function + component. Free ones become 0 … n − 1, prescribed ones n, n + 1, …
struct DegreesOfFreedom {
  std::vector<int> free;        // grid number of free unknown k, (n)
  std::vector<int> prescribed;  // grid number of the unknown that support s prescribes, (supports)
  std::vector<int> number;      // of each grid unknown: k < n free, n + s prescribed, −1 without material

  /// reached: whether any material point gives the unknown mass; prescribed: in order of the supports.
  DegreesOfFreedom(const std::vector<bool>& reached, std::vector<int> prescribed_unknowns)
      : prescribed(std::move(prescribed_unknowns)), number(reached.size(), -1) {
    constexpr int held = -2;
    for (const int unknown : prescribed) number[static_cast<std::size_t>(unknown)] = held;
    for (std::size_t unknown = 0; unknown < reached.size(); ++unknown) {
      if (!reached[unknown] || number[unknown] == held) continue;
      number[unknown] = static_cast<int>(free.size());
      free.push_back(static_cast<int>(unknown));
    }
    for (std::size_t s = 0; s < prescribed.size(); ++s) {
      number[static_cast<std::size_t>(prescribed[s])] = static_cast<int>(free.size() + s);
    }
  }
  std::size_t size() const { return free.size(); }
  bool is_free(int dof) const { return dof >= 0 && dof < static_cast<int>(free.size()); }
};

/// A deterministic scatter: forces are summed by cell corner first, and the corners by degree of freedom in a fixed
/// order, so that the bits do not depend on the number of threads.
struct CornerSum {
  std::vector<int> begin;   // (degrees of freedom + 1)
  std::vector<int> corner;  // corners of degree of freedom k at [begin[k], begin[k + 1])

  /// dof_of_corner: number of each corner's degree of freedom, −1 for none; count: free and prescribed together.
  CornerSum(const std::vector<int>& dof_of_corner, std::size_t count) : begin(count + 1, 0) {
    for (const int dof : dof_of_corner) {
      if (dof >= 0) ++begin[static_cast<std::size_t>(dof) + 1];
    }
    for (std::size_t k = 0; k < count; ++k) begin[k + 1] += begin[k];
    corner.resize(static_cast<std::size_t>(begin[count]));
    std::vector<int> next(begin.begin(), begin.end() - 1);
    for (std::size_t c = 0; c < dof_of_corner.size(); ++c) {
      if (dof_of_corner[c] < 0) continue;
      int& place = next[static_cast<std::size_t>(dof_of_corner[c])];
      corner[static_cast<std::size_t>(place++)] = static_cast<int>(c);
    }
  }
  double sum(std::size_t dof, const double* forces) const {
    double total = 0;
    for (int c = begin[dof]; c < begin[dof + 1]; ++c) total += forces[corner[static_cast<std::size_t>(c)]];
    return total;
  }
};

}  // namespace stillpoint
