// The unknowns of the grid: free ones, those prescribed by supports, those that follow others, and those that no
// material reaches.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "space/grid/extended_functions.hpp"

namespace stillpoint {

/// The degrees of freedom of a grid, whose unknowns are Dim function + component. Free ones have the numbers 0 … n − 1,
/// prescribed ones n … n + s − 1, and those of extended functions that no support prescribes n + s, n + s + 1, …
class DegreesOfFreedom {
 public:
  std::vector<int> free;        // grid number of free unknown k, (n)
  std::vector<int> prescribed;  // grid number of prescribed unknown s
  std::vector<int> extended;    // grid number of extended unknown e
  std::vector<int> number;      // number of each grid unknown, −1 without material

  /// reached: whether any material point gives the function mass, (functions).
  DegreesOfFreedom(const std::vector<char>& reached, int dim, std::vector<int> prescribed_unknowns,
                   const ExtendedFunctions& extension = ExtendedFunctions())
      : prescribed(std::move(prescribed_unknowns)), number(reached.size() * static_cast<std::size_t>(dim), nothing) {
    for (const int unknown : prescribed) number[static_cast<std::size_t>(unknown)] = held;
    for (const int function : extension.functions()) {
      for (int unknown = dim * function; unknown < dim * (function + 1); ++unknown) {
        if (number[static_cast<std::size_t>(unknown)] != held) extended.push_back(unknown);
      }
    }
    for (const int unknown : extended) number[static_cast<std::size_t>(unknown)] = held;
    for (std::size_t unknown = 0; unknown < number.size(); ++unknown) {
      if (!reached[unknown / static_cast<std::size_t>(dim)] || number[unknown] == held) continue;
      number[unknown] = static_cast<int>(free.size());
      free.push_back(static_cast<int>(unknown));
    }
    int next = static_cast<int>(free.size());
    for (const int unknown : prescribed) number[static_cast<std::size_t>(unknown)] = next++;
    for (const int unknown : extended) number[static_cast<std::size_t>(unknown)] = next++;
    for (const int unknown : extended) {
      for (const auto& [function, weight] : extension.sources_of(unknown / dim)) {
        const int source = dim * function + unknown % dim;
        sources_.push_back({source, number[static_cast<std::size_t>(source)], weight});
      }
      begin_.push_back(sources_.size());
    }
  }
  std::size_t size() const { return free.size(); }
  /// The number of all unknowns, including prescribed and extended ones.
  std::size_t with_all_others() const { return free.size() + prescribed.size() + extended.size(); }
  bool is_free(int dof) const { return dof >= 0 && dof < static_cast<int>(free.size()); }
  bool is_extended(int dof) const { return dof >= static_cast<int>(free.size() + prescribed.size()); }

  /// Calls visit(unknown of the grid, its number, weight) for the free or prescribed unknowns that determine an unknown
  /// of the grid: itself, with weight 1, or those that it follows.
  template <class Visit>
  void for_sources(int unknown, const Visit& visit) const {
    const int dof = number[static_cast<std::size_t>(unknown)];
    if (dof < 0) return;
    if (!is_extended(dof)) return visit(unknown, dof, 1.0);
    const auto e = static_cast<std::size_t>(dof) - free.size() - prescribed.size();
    for (std::size_t k = begin_[e]; k < begin_[e + 1]; ++k)
      visit(sources_[k].unknown, sources_[k].dof, sources_[k].weight);
  }

  /// Sets the extended unknowns u_e = Σ_k w_ek u_k of u, over the grid's unknowns, from the free and prescribed ones.
  void extend(double* u) const {
    for (std::size_t e = 0; e < extended.size(); ++e) {
      double sum = 0;
      for (std::size_t k = begin_[e]; k < begin_[e + 1]; ++k) sum += sources_[k].weight * u[sources_[k].unknown];
      u[extended[e]] = sum;
    }
  }
  /// The transpose of extend(): calls give(number, w_ek F_e) for every source; F: forces at the extended unknowns,
  /// (extended).
  template <class Give>
  void give_to_sources(const std::vector<double>& F, const Give& give) const {
    for (std::size_t e = 0; e < extended.size(); ++e) {
      for (std::size_t k = begin_[e]; k < begin_[e + 1]; ++k) give(sources_[k].dof, sources_[k].weight * F[e]);
    }
  }

 private:
  static constexpr int nothing = -1, held = -2;
  struct Source {
    int unknown, dof;
    double weight;
  };

  std::vector<std::size_t> begin_{0};  // first source of each extended unknown
  std::vector<Source> sources_;
};

}  // namespace stillpoint
