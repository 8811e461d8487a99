// Extended functions: functions whose coefficients are no unknowns but follow from those of others.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace stillpoint {

/// The relations u_e = Σ_k w_ek u_k, in all components alike, so that the solution is a combination of the functions
/// N_k + Σ_e w_ek N_e. No source of an extended function is extended itself.
class ExtendedFunctions {
 public:
  struct Source {
    int function;
    double weight;
  };

  /// functions: their number in the grid.
  explicit ExtendedFunctions(std::size_t functions = 0) : number_(functions, none) {}

  void add(int function, const std::vector<Source>& sources) {
    number_[static_cast<std::size_t>(function)] = static_cast<int>(functions_.size());
    functions_.push_back(function);
    sources_.insert(sources_.end(), sources.begin(), sources.end());
    begin_.push_back(sources_.size());
  }

  /// Adds all functions of a field by itself; first: its first function in the grid.
  void add(const ExtendedFunctions& of_field, int first) {
    for (std::size_t e = 0; e < of_field.functions().size(); ++e) {
      std::vector<Source> sources;
      for (const auto& [function, weight] : of_field.sources(e)) sources.push_back({first + function, weight});
      add(first + of_field.functions()[e], sources);
    }
  }

  bool empty() const { return functions_.empty(); }
  /// The extended functions in the order in which they were added.
  const std::vector<int>& functions() const { return functions_; }
  bool contains(int function) const { return !empty() && number_[static_cast<std::size_t>(function)] != none; }
  /// The sources of the e-th of functions().
  std::span<const Source> sources(std::size_t e) const {
    return std::span(sources_).subspan(begin_[e], begin_[e + 1] - begin_[e]);
  }
  /// The sources of an extended function, by its number in the grid.
  std::span<const Source> sources_of(int function) const {
    return sources(static_cast<std::size_t>(number_[static_cast<std::size_t>(function)]));
  }

 private:
  static constexpr int none = -1;

  std::vector<int> functions_;
  std::vector<std::size_t> begin_{0};
  std::vector<Source> sources_;
  std::vector<int> number_;  // index in functions_ of each function of the grid, or none
};

}  // namespace stillpoint
