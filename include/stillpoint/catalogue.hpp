// The choices that a scene makes by name, with the properties that decide which choices go together: plain data. Each
// row stands beside the code that it names (a law, a damping, a relaxation, an integrator, an exact solution).
#pragma once

#include <stillpoint/scene_options.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stillpoint {

struct MaterialSpec;
struct Problem;

/// A number that a law or an exact solution takes; allowed if lower < value < upper, and at lower itself if
/// lower_allowed.
struct ParameterInfo {
  std::string_view name, unit, meaning;
  double lower, upper;
  bool lower_allowed;
  bool required;
  double fallback;                // value if the scene gives none and it is not required; NaN: there is none
  std::string_view same_as = {};  // name of an earlier parameter whose value is the fallback; empty: none
  bool by_place = false;          // may be a formula of the material's position before the motion
};

/// A word that a law or an exact solution takes, one of `values`.
struct ChoiceInfo {
  std::string_view name, meaning;
  std::vector<std::string_view> values;
  std::string_view fallback;
};

/// A fault of the value of a key of [material.<name>].
struct LawFault {
  std::string_view key;
  std::string message;
};

/// A material law, named by material.<name>.law.
struct LawInfo {
  std::string_view name, equation, source;
  std::vector<StressState> states;
  std::vector<ParameterInfo> parameters;
  std::vector<ChoiceInfo> choices{};
  bool history_dependent = false;  // the stress depends on more than the deformation
  bool finite_strain = true;
  bool softens_by_rows = false;  // takes MaterialSpec::softening
  bool has_strength = false;     // in the parameters c, phi, psi and tension, which a factor of safety divides
  bool needs_pressure = false;   // no stiffness without pressure: an initial stress has to press everywhere
  std::vector<std::string_view> fields{};  // history variables of a law that a program has added, which probes may name
  bool from_library = false;               // takes MaterialSpec::library, props and statev
  /// Finds a fault of a material whose keys are each in order; null: there can be none.
  std::optional<LawFault> (*fault)(const MaterialSpec&) = nullptr;
};

/// A damping strategy, named by damping.strategy: a damping force, or a relaxation, which is an iteration to rest.
struct StrategyInfo {
  std::string_view name, equation, source;
  std::vector<std::string_view> keys{};  // keys of [damping] that it uses: "c", "alpha", "peak", "quotient"
  /// Beginnings of the names of the integrators that go with the strategy; empty: all integrators.
  std::vector<std::string_view> integrators{};
  bool damps = true;                // takes energy out of the motion
  bool is_identity = false;         // C = c I, which is no multiple of M
  bool is_relaxation = false;       // with leapfrog it takes the place of the integrator's step
  bool has_own_step = false;        // integrator.step and step_fraction have no effect
  bool resets_velocity = false;     // sets all velocities to zero, also those that a wall drives
  bool is_local = false;            // a damping whose force is discontinuous in v
  bool takes_inverse_mass = false;  // a relaxation that goes with a mass known by its inverse alone

  bool goes_with(std::string_view integrator) const;
  bool uses(std::string_view key) const;
  /// Whether a key of [damping] may stand beside the strategy: a key that the strategy uses, or, for a damping, c or
  /// alpha, so that one damping can be tried in place of another.
  bool takes(std::string_view key) const;
};

/// A static solver, which has no time: a value of solve.method other than "relaxation".
struct StaticMethodInfo {
  std::string_view name, equation, source;
  bool takes_end_of_loads = false;  // loads and supports may depend on t: the equilibrium is that at stop.time
  bool is_newton = false;           // one step is the whole solution
  bool factorises = false;          // factorises K, so that the mass plays no part
  bool tells_omega_1 = false;       // its steps yield the lowest frequency ω₁ of a linear body
};

/// A time integrator, named by integrator.method.
struct MethodInfo {
  std::string name;         // value of integrator.method
  std::string description;  // one line, with its source
  bool fixed_step = true;
  bool adaptive = false;                                                     // adapts its step by an error estimate
  std::vector<DampingTreatment> treatments = {DampingTreatment::automatic};  // allowed values of integrator.damping
};

/// A fault of the value of a key of [exact].
struct SolutionFault {
  std::string_view key;
  std::string message;
};

/// An exact solution, named by exact.solution. Its material is that of the scene's bodies; all else are its parameters.
struct SolutionInfo {
  std::string_view name, description, source;
  std::vector<StressState> states;
  std::vector<ParameterInfo> parameters;
  std::vector<ChoiceInfo> choices{};
  std::vector<std::string_view> laws{};  // laws for which it holds; empty: for all, at small strain
  bool has_stress = true;
  /// Finds a fault of a scene whose parameters are each in their range; null: there can be none.
  std::optional<SolutionFault> (*fault)(const Problem&) = nullptr;
};

struct Catalogue {
  std::vector<LawInfo> laws;
  std::vector<StrategyInfo> strategies;  // dampings, then relaxations
  std::vector<StaticMethodInfo> static_methods;
  std::vector<MethodInfo> methods;
  std::vector<SolutionInfo> solutions;

  const LawInfo* law(std::string_view name) const;  // null if no law has this name; likewise below
  const StrategyInfo* strategy(std::string_view name) const;
  const StaticMethodInfo* static_method(std::string_view name) const;
  const MethodInfo* method(std::string_view name) const;
  const SolutionInfo* solution(std::string_view name) const;
};

}  // namespace stillpoint
