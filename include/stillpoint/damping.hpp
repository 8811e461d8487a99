// Dampings: forces that are added to M a = Q, Q = F − R, so that the motion comes to rest.
//
//   none        M a = Q
//   viscous     M a = Q − c M v
//   identity    M a = Q − c v                          (the paper's: C = c I)
//   one-sided   M a = Q + D,  D_i = −α Q_i if v_i Q_i > 0, else 0           [Więckowski 2011, eq. 4]
//   cundall     M a = Q + D,  D_i = −α |Q_i| sgn v_i                        [Cundall 1987]
//   combined    M a = Q + D,  D_i = −α/2 |Q_i| (sgn v_i − sgn dQ_i/dt)      [Itasca, FLAC: combined damping]
#pragma once

#include <stillpoint/catalogue.hpp>
#include <stillpoint/types.hpp>

#include <memory>
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
  /// The linear part C, so that integrators can treat it implicitly.
  virtual LinearDamping linear() const { return {}; }
  /// Whether add_local() has an effect; the right-hand side is then discontinuous in v.
  virtual bool is_local() const { return false; }
  /// Whether add_local() may be given some of the degrees of freedom at a time, from several threads at once.
  virtual bool goes_by_pieces() const { return true; }
  /// Adds the local damping force, Q += D(v, Q), for each degree of freedom by itself; v, Q: (n).
  virtual void add_local(ConstVec /*v*/, Vec /*Q*/) const {}
  /// Whether D also needs Q of the last accepted step, as for the sign of dQ/dt; add_local_since() is then called in
  /// place of add_local(). Only integrators with one force evaluation a step can provide it.
  virtual bool uses_last_force() const { return false; }
  /// Adds the local damping force that needs the last force, Q += D(v, Q − Q_last, Q); v, Q_last, Q: (n).
  virtual void add_local_since(ConstVec /*v*/, ConstVec /*Q_last*/, Vec /*Q*/) const {}
  /// The largest |Q + D|/|Q|, the factor by which the critical step takes the stiffness to grow (1 + α for Cundall's).
  virtual double stiffness_factor() const { return 1; }
};

/// All dampings, in the order of `stillpoint list dampings`.
const std::vector<StrategyInfo>& dampings();

/// Whether this strategy leaves the motion undamped.
bool is_undamped(std::string_view strategy);

/// Makes a damping by its name; c for viscous and identity, alpha for one-sided, cundall and combined.
/// Throws std::invalid_argument on an unknown name or a parameter out of range (c < 0, α outside [0, 1)).
std::unique_ptr<Damping> make_damping(std::string_view name, double c, double alpha);
/// Makes an absent damping force, as under a relaxation, which finds its own way to rest.
std::unique_ptr<Damping> no_damping();

}  // namespace stillpoint
