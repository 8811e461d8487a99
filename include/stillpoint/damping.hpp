// Damping strategies: what is added to M a = Q, Q = F − R.
//
//   none        M a = Q
//   viscous     M a = Q − c M v
//   identity    M a = Q − c v                          (the paper's: C = c I)
//   one-sided   M a = Q + D,  D_i = −α Q_i where v_i Q_i > 0, else 0        [Więckowski 2011, eq. 4]
//   cundall     M a = Q + D,  D_i = −α |Q_i| sgn v_i                        [Cundall 1987]
#pragma once

#include <stillpoint/types.hpp>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace stillpoint {

/// The linear part of the damping, C = mass · M + identity · I.
struct LinearDamping {
  double mass = 0;      // [1/s]
  double identity = 0;  // [kg/s]
};

class Damping {
 public:
  virtual ~Damping() = default;
  virtual std::string_view name() const = 0;
  /// C, so that integrators can treat it implicitly.
  virtual LinearDamping linear() const { return {}; }
  /// Whether add_local() does anything; then the right-hand side is discontinuous in v.
  virtual bool is_local() const { return false; }
  /// Q += D(v, Q), degree of freedom by degree of freedom; v, Q: (n).
  virtual void add_local(ConstVec /*v*/, Vec /*Q*/) const {}
  /// The largest |Q + D|/|Q|: by this the critical step sees the stiffness grow (1 + α for Cundall's).
  virtual double stiffness_factor() const { return 1; }
};

struct DampingInfo {
  std::string_view name, equation, source;
};
/// Every strategy, for `stillpoint list dampings`.
const std::vector<DampingInfo>& damping_strategies();

/// Makes a strategy by its name; c for viscous and identity, alpha for one-sided and cundall.
/// Throws std::invalid_argument on an unknown name or a parameter out of range (c < 0, α outside [0, 1)).
std::unique_ptr<Damping> make_damping(std::string_view name, double c, double alpha);

}  // namespace stillpoint
