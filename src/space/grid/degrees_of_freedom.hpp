// Which unknowns of the grid are free, which are prescribed by supports, and which no material reaches.
#pragma once

#include <vector>

namespace stillpoint {

/// Unknowns of the grid are numbered Dim function + component. Free ones become 0 … n − 1, prescribed ones n, n + 1, …
struct DegreesOfFreedom {
  std::vector<int> free;        // grid number of free unknown k, (n)
  std::vector<int> prescribed;  // grid number of prescribed unknown s
  std::vector<int> number;      // of each grid unknown: k < n free, n + s prescribed, −1 without material

  /// reached: whether any material point gives the function mass, (functions).
  DegreesOfFreedom(const std::vector<char>& reached, int dim, std::vector<int> prescribed_unknowns)
      : prescribed(std::move(prescribed_unknowns)), number(reached.size() * static_cast<std::size_t>(dim), -1) {
    constexpr int held = -2;
    for (const int unknown : prescribed) number[static_cast<std::size_t>(unknown)] = held;
    for (std::size_t unknown = 0; unknown < number.size(); ++unknown) {
      if (!reached[unknown / static_cast<std::size_t>(dim)] || number[unknown] == held) continue;
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

}  // namespace stillpoint
