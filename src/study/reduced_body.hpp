// A body at rest that is given less strength: what it does then.
#pragma once

#include <stillpoint/safety.hpp>
#include <stillpoint/simulation.hpp>
#include <stillpoint/state_archive.hpp>

#include <string>
#include <vector>

#include "base/stopwatch.hpp"
#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

class ReducedBody {
 public:
  /// Takes the body to its equilibrium with its strength over options.from, in its scene's own way and through all of
  /// its stages. Throws SceneError if it does not come to one. scene, options: must outlive this object.
  ReducedBody(const Scene& scene, const SafetyOptions& options);

  /// The equilibrium, or that it was interrupted.
  const SafetyTrial& first() const { return first_; }
  std::vector<std::string> notes() { return simulation_.summary().notes; }
  /// What the body does with its strength over `factor`, from that equilibrium, in a single phase.
  SafetyTrial try_factor(double factor);
  /// What the last trial left.
  Mechanism mechanism(double factor);

 private:
  struct Tried {
    SafetyVerdict verdict = SafetyVerdict::undecided;
    std::string reason{};
    std::vector<double> u{};  // (n), at the end
    long evaluations = 0;
  };

  void require_rest(const Summary& summary);
  void begin(double factor);
  Tried by_newton(double factor);
  Tried by_motion(double factor);
  void doubt_if_squeezed(Tried& tried);

  LagrangianPhase& phase();
  const Problem& problem();  // in its last stage
  double t() const { return simulation_.t(); }
  double residual() const;
  int threads();
  bool uses_newton();
  std::vector<double> field(const std::string& name, ConstVec u);

  const Stopwatch wall_;
  const Scene scene_;  // with the strength of the first factor
  const SafetyOptions& options_;
  Simulation simulation_;
  SafetyTrial first_;
  SavedState at_rest_;
  double strain_ = 0;                                      // the largest, at rest
  std::vector<double> u_, displacement_, plastic_strain_;  // at rest
  std::vector<double> last_u_, last_displacement_;
};

}  // namespace stillpoint
