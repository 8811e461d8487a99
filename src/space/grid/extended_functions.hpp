// Functions that are no unknowns of their own: their coefficients follow from those of others.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace stillpoint {

/// u_e = Σ_k w_ek u_k, in all components alike, so that what is found is a combination of the functions
/// N_k + Σ_e w_ek N_e. None of those that are followed follows another one.
class ExtendedFunctions {
 public:
  struct Source {
    int function;
    double weight;
  };

  /// functions: of the grid.
  explicit ExtendedFunctions(std::size_t functions = 0) : number_(functions, none) {}

  void add(int function, const std::vector<Source>& sources) {
    number_[static_cast<std::size_t>(function)] = static_cast<int>(functions_.size());
    functions_.push_back(function);
    sources_.insert(sources_.end(), sources.begin(), sources.end());
    begin_.push_back(sources_.size());
  }

  bool empty() const { return functions_.empty(); }
  /// In the order in which they were added.
  const std::vector<int>& functions() const { return functions_; }
  bool contains(int function) const { return !empty() && number_[static_cast<std::size_t>(function)] != none; }
  /// What the e-th of functions() follows.
  std::span<const Source> sources(std::size_t e) const {
    return std::span(sources_).subspan(begin_[e], begin_[e + 1] - begin_[e]);
  }
  /// Of a function that is one of them.
  std::span<const Source> sources_of(int function) const {
    return sources(static_cast<std::size_t>(number_[static_cast<std::size_t>(function)]));
  }

 private:
  static constexpr int none = -1;

  std::vector<int> functions_;
  std::vector<std::size_t> begin_{0};
  std::vector<Source> sources_;
  std::vector<int> number_;  // of each function of the grid, or none
};

}  // namespace stillpoint
