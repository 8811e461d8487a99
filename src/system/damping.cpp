#include <stillpoint/damping.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "base/parallel_loop.hpp"

namespace stillpoint {
namespace {

class None final : public Damping {
 public:
  std::string_view name() const override { return "none"; }
};

class Viscous final : public Damping {
 public:
  explicit Viscous(double c) : c_(c) {}
  std::string_view name() const override { return "viscous"; }
  LinearDamping linear() const override { return {.mass = c_, .identity = 0}; }

 private:
  double c_;  // [1/s]
};

class Identity final : public Damping {
 public:
  explicit Identity(double c) : c_(c) {}
  std::string_view name() const override { return "identity"; }
  LinearDamping linear() const override { return {.mass = 0, .identity = c_}; }

 private:
  double c_;  // [kg/s]
};

class OneSided final : public Damping {
 public:
  explicit OneSided(double alpha) : alpha_(alpha) {}
  std::string_view name() const override { return "one-sided"; }
  bool is_local() const override { return alpha_ > 0; }
  // D_i = −α Q_i where v_i Q_i > 0, else 0
  void add_local(ConstVec v, Vec Q) const override {
    for_each_index(Q.size(), [=, kept = 1 - alpha_](std::size_t i) { Q[i] *= v[i] * Q[i] > 0 ? kept : 1.0; });
  }

 private:
  double alpha_;
};

class Cundall final : public Damping {
 public:
  explicit Cundall(double alpha) : alpha_(alpha) {}
  std::string_view name() const override { return "cundall"; }
  bool is_local() const override { return alpha_ > 0; }
  // D_i = −α |Q_i| sgn v_i, sgn 0 = 0
  void add_local(ConstVec v, Vec Q) const override {
    for_each_index(Q.size(), [=, alpha = alpha_](std::size_t i) {
      const double sign = v[i] > 0 ? 1.0 : v[i] < 0 ? -1.0 : 0.0;
      Q[i] -= alpha * std::abs(Q[i]) * sign;
    });
  }
  double stiffness_factor() const override { return 1 + alpha_; }

 private:
  double alpha_;
};

class Combined final : public Damping {
 public:
  explicit Combined(double alpha) : alpha_(alpha) {}
  std::string_view name() const override { return "combined"; }
  bool is_local() const override { return alpha_ > 0; }
  bool uses_last_force() const override { return true; }
  // D_i = −α/2 |Q_i| (sgn v_i − sgn dQ_i/dt),  dQ/dt by its difference since the last step. For a mass that swings
  // about its rest the two signs are opposite; in a motion that goes steadily one way the second one keeps half the
  // damping.
  void add_local_since(ConstVec v, ConstVec Q_last, Vec Q) const override {
    for_each_index(Q.size(), [=, half = alpha_ / 2](std::size_t i) {
      Q[i] -= half * std::abs(Q[i]) * (sign(v[i]) - sign(Q[i] - Q_last[i]));
    });
  }
  double stiffness_factor() const override { return 1 + alpha_; }

 private:
  static double sign(double x) { return x > 0 ? 1.0 : x < 0 ? -1.0 : 0.0; }

  double alpha_;
};

// Adds nothing: the strategy is in the iteration.
class OwnIteration final : public Damping {
 public:
  explicit OwnIteration(std::string_view name) : name_(name) {}
  std::string_view name() const override { return name_; }

 private:
  std::string_view name_;  // of damping_strategies()
};

void require(bool ok, std::string_view strategy, std::string_view what, double found) {
  if (!ok) throw std::invalid_argument(fmt::format("damping '{}' needs {}, found {}", strategy, what, found));
}

}  // namespace

bool DampingInfo::goes_with(std::string_view method) const {
  return integrators.empty() ||
         std::ranges::any_of(integrators, [&](std::string_view begin) { return method.starts_with(begin); });
}

const std::vector<DampingInfo>& damping_strategies() {
  static const std::vector<DampingInfo> strategies = {
      {.name = "none", .equation = "M a = Q", .source = ""},
      {.name = "viscous",
       .equation = "M a = Q - c M v",
       .source = "mass-proportional; critical for c = 2 omega_1",
       .takes_c = true},
      {.name = "identity",
       .equation = "M a = Q - c v",
       .source = "Więckowski 2011, section 3.1: C = c I",
       .takes_c = true},
      {.name = "one-sided",
       .equation = "M a = Q + D, D_i = -alpha Q_i where v_i Q_i > 0, else 0",
       .source = "Więckowski 2011, eq. 4",
       .takes_alpha = true},
      {.name = "cundall",
       .equation = "M a = Q + D, D_i = -alpha |Q_i| sgn v_i",
       .source = "Cundall 1987",
       .takes_alpha = true},
      {.name = "combined",
       .equation = "M a = Q + D, D_i = -alpha/2 |Q_i| (sgn v_i - sgn dQ_i/dt)",
       .source = "Itasca, FLAC manual, combined damping",
       .takes_alpha = true,
       .integrators = {"leapfrog", "symplectic-euler"}},
      {.name = "kinetic",
       .equation = "M a = Q, v = 0 at every peak of v'Mv/2",
       .source = "Cundall 1976; Barnes 1999",
       .takes_peak = true,
       .owns_iteration = true,
       .resets_velocity = true,
       .integrators = {"leapfrog", "erk:"}},
      {.name = "adaptive",
       .equation = "M a = Q - c M v, c = 2 sqrt(a Rayleigh quotient of the motion)",
       .source = "Underwood 1983",
       .takes_quotient = true,
       .owns_iteration = true,
       .integrators = {"leapfrog"}},
      {.name = "papadrakakis",
       .equation = "M a = Q - c M v, c = 2 omega_1, omega_1 from the decay |du_n+1|/|du_n|",
       .source = "Papadrakakis 1981",
       .owns_iteration = true,
       .integrators = {"leapfrog"}},
      {.name = "fire",
       .equation = "M a = Q, v turned towards Q; v = 0 where v.Q <= 0",
       .source = "Bitzek, Koskinen, Gähler, Moseler, Gumbsch 2006",
       .owns_iteration = true,
       .resets_velocity = true,
       .integrators = {"leapfrog"}},
      {.name = "fire2",
       .equation = "the same, half a step back where v.Q <= 0",
       .source = "Guénolé et al. 2020",
       .owns_iteration = true,
       .resets_velocity = true,
       .integrators = {"leapfrog"}},
      {.name = "chebyshev",
       .equation = "v+ = beta_k v + gamma_k h Q/M, Chebyshev's polynomial on [omega_1^2, omega_max^2]",
       .source = "Golub and Varga 1961",
       .needs_omega_1 = true,
       .owns_iteration = true,
       .has_own_step = true,
       .integrators = {"leapfrog"}},
      {.name = "nesterov",
       .equation = "x+ = u + s Q/M, u+ = x+ + beta_k (x+ - x), begun again where Q.(x+ - x) < 0",
       .source = "Nesterov 1983; O'Donoghue and Candès 2015",
       .owns_iteration = true,
       .resets_velocity = true,
       .integrators = {"leapfrog"}},
      {.name = "cg",
       .equation = "p+ = Q/M + beta p, Polak and Ribière's beta >= 0: a static iteration",
       .source = "Hestenes and Stiefel 1952; Gilbert and Nocedal 1992",
       .owns_iteration = true,
       .has_own_step = true,
       .is_static = true,
       .integrators = {"leapfrog"}},
      {.name = "lbfgs",
       .equation = "p = H Q, H of the last 10 changes of u and Q: a static iteration",
       .source = "Nocedal 1980",
       .owns_iteration = true,
       .has_own_step = true,
       .is_static = true,
       .integrators = {"leapfrog"}},
      {.name = "auto",
       .equation = "M a = Q - c M v, step, mass and c found by itself",
       .source = "Underwood 1983 with v = 0 where v.Q < 0, kinetic where that stalls",
       .owns_iteration = true,
       .has_own_step = true,
       .integrators = {"leapfrog"}},
  };
  return strategies;
}

bool DampingInfo::takes(std::string_view key) const {
  if (key == "peak") return takes_peak;
  if (key == "quotient") return takes_quotient;
  return !owns_iteration;  // c and alpha
}

const DampingInfo* known_damping(std::string_view name) {
  const auto& all = damping_strategies();
  const auto found = std::ranges::find(all, name, &DampingInfo::name);
  return found == all.end() ? nullptr : &*found;
}

const DampingInfo& find_damping(std::string_view name) {
  if (const DampingInfo* info = known_damping(name)) return *info;
  throw std::invalid_argument(fmt::format("there is no damping strategy '{}'", name));
}

std::unique_ptr<Damping> make_damping(std::string_view name, double c, double alpha) {
  if (name == "none") return std::make_unique<None>();
  if (name == "viscous" || name == "identity") {
    require(c >= 0 && std::isfinite(c), name, "c >= 0", c);
    if (name == "viscous") return std::make_unique<Viscous>(c);
    return std::make_unique<Identity>(c);
  }
  const DampingInfo& info = find_damping(name);
  if (info.owns_iteration) return std::make_unique<OwnIteration>(info.name);
  if (info.takes_alpha) {
    require(alpha >= 0 && alpha < 1, name, "0 <= alpha < 1", alpha);
    if (name == "one-sided") return std::make_unique<OneSided>(alpha);
    if (name == "combined") return std::make_unique<Combined>(alpha);
    return std::make_unique<Cundall>(alpha);
  }
  throw std::logic_error(fmt::format("the damping strategy '{}' is listed and cannot be made", name));
}

}  // namespace stillpoint
