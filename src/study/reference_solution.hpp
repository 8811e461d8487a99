// The exact discrete equilibrium of a scene, relative to which relaxation is measured.
#pragma once

#include <stillpoint/scene.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "simulation/setup/set_up_store.hpp"

namespace stillpoint {

/// The residual to which a reference is solved.
inline constexpr double reference_residual = 1e-12;

class ReferenceSolution {
 public:
  /// u: the equilibrium u*, (n); mass: M of the norm in which errors are measured.
  ReferenceSolution(std::vector<double> u, Mass mass);
  const std::vector<double>& u() const { return u_; }
  /// The norm ‖u*‖_M.
  double size() const { return size_; }
  /// The relative error ‖u − u*‖_M/‖u*‖_M.
  double error(ConstVec u) const;

 private:
  std::vector<double> u_;
  Mass mass_;
  double size_;
};

/// The reference solution and its origin.
struct Equilibrium {
  ReferenceSolution state;
  std::size_t points = 0;
  std::string method;
  double residual = 0;  // ‖F − R‖/‖F‖
  bool unique = true;   // whether it does not depend on the path: no history, no contact
  std::vector<std::string> notes;
};

/// Finds the equilibrium by Newton's method in one load step, or if that fails by the scene's own relaxation; at
/// stop.time if that is set. Throws SceneError for a scene of several phases, with loads that have no end, or if
/// nothing is displaced.
Equilibrium find_equilibrium(const Scene& scene, int threads, const std::function<bool()>& interrupted,
                             SetUpStore& store);

/// The limit of slow loading: a sequence of equilibria, in 64 load steps. Empty, with a note, if there is none.
std::optional<ReferenceSolution> slow_ramp(const Problem& problem, SetUpStore& store, std::vector<std::string>& notes);

}  // namespace stillpoint
