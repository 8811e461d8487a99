// What a scene may choose from by name, with the properties that decide what goes with what: plain data. Each row
// stands beside the code that it names (a law, a damping, a relaxation, an integrator, an exact solution).
#pragma once

#include <stillpoint/scene_options.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stillpoint {

struct Problem;

/// A number that a law or an exact solution takes; allowed if lower < value < upper, and at lower itself if
/// lower_allowed.
struct ParameterInfo {
  std::string_view name, unit, meaning;
  double lower, upper;
  bool lower_allowed;
  bool required;
  double fallback;                // if not required
  std::string_view same_as = {};  // an earlier parameter, whose value is the fallback then; empty: none
};

/// A word that one takes.
struct ChoiceInfo {
  std::string_view name, meaning;
  std::vector<std::string_view> values;
  std::string_view fallback;
};

/// A law of material.<name>.law.
struct LawInfo {
  std::string_view name, equation, source;
  std::vector<StressState> states;
  std::vector<ParameterInfo> parameters;
  std::vector<ChoiceInfo> choices{};
  bool history_dependent = false;  // its stress depends on more than the deformation
  bool finite_strain = true;
};

/// A name that damping.strategy takes: a damping, which is a force, or a relaxation, which is an iteration to rest.
struct StrategyInfo {
  std::string_view name, equation, source;
  std::vector<std::string_view> keys{};  // of [damping] that it uses: "c", "alpha", "peak", "quotient"
  /// The integrators that it goes with, by the beginning of their names; empty: all.
  std::vector<std::string_view> integrators{};
  bool damps = true;                // takes energy out of the motion
  bool is_identity = false;         // C = c I, which is no multiple of M
  bool is_relaxation = false;       // with leapfrog it takes the place of the integrator's step
  bool has_own_step = false;        // integrator.step and step_fraction have no part in it
  bool resets_velocity = false;     // of all unknowns, also of those that a wall drives
  bool is_local = false;            // a damping whose force is discontinuous in v
  bool takes_inverse_mass = false;  // a relaxation that goes with a mass known by its inverse alone

  bool goes_with(std::string_view integrator) const;
  bool uses(std::string_view key) const;
  /// Whether a key of [damping] may stand beside the strategy: one that it uses, and between dampings c and alpha, so
  /// that one can be tried in place of the other.
  bool takes(std::string_view key) const;
};

/// A name of solve.method beside "relaxation": a static solver, which has no time.
struct StaticMethodInfo {
  std::string_view name, equation, source;
  bool takes_end_of_loads = false;  // loads and supports may depend on t: the equilibrium is that at stop.time
  bool is_newton = false;           // one step is the whole solution
  bool factorises = false;          // K, so that no mass has a part in it
  bool tells_omega_1 = false;       // of a linear body, by its steps
};

/// A name of integrator.method.
struct MethodInfo {
  std::string name;         // as in integrator.method
  std::string description;  // one line, with its source
  bool fixed_step = true;
  bool adaptive = false;                                                     // has an error estimate
  std::vector<DampingTreatment> treatments = {DampingTreatment::automatic};  // of integrator.damping
};

/// What is wrong with a key of [exact].
struct SolutionFault {
  std::string_view key;
  std::string message;
};

/// A name of exact.solution. Its material is that of the scene's bodies; all else are its parameters.
struct SolutionInfo {
  std::string_view name, description, source;
  std::vector<StressState> states;
  std::vector<ParameterInfo> parameters;
  std::vector<ChoiceInfo> choices{};
  std::vector<std::string_view> laws{};  // for which it holds; empty: for all, at small strain
  bool has_stress = true;
  /// Of a scene whose parameters are each in their range; null: nothing can be wrong then.
  std::optional<SolutionFault> (*fault)(const Problem&) = nullptr;
};

struct Catalogue {
  std::vector<LawInfo> laws;
  std::vector<StrategyInfo> strategies;  // dampings, then relaxations
  std::vector<StaticMethodInfo> static_methods;
  std::vector<MethodInfo> methods;
  std::vector<SolutionInfo> solutions;

  const LawInfo* law(std::string_view name) const;  // null if there is none of that name; likewise below
  const StrategyInfo* strategy(std::string_view name) const;
  const StaticMethodInfo* static_method(std::string_view name) const;
  const MethodInfo* method(std::string_view name) const;
  const SolutionInfo* solution(std::string_view name) const;
};

}  // namespace stillpoint
