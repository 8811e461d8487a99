#include <stillpoint/damping.hpp>
#include <stillpoint/own_damping.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "base/parallel_loop.hpp"
#include "base/registry.hpp"
#include "system/put_damping.hpp"

namespace stillpoint {
namespace {

class None final : public Damping {};

class Viscous final : public Damping {
 public:
  explicit Viscous(double c) : c_(c) {}
  LinearDamping linear() const override { return {.mass = c_, .identity = 0}; }

 private:
  double c_;  // [1/s]
};

class Identity final : public Damping {
 public:
  explicit Identity(double c) : c_(c) {}
  LinearDamping linear() const override { return {.mass = 0, .identity = c_}; }

 private:
  double c_;  // [kg/s]
};

class OneSided final : public Damping {
 public:
  explicit OneSided(double alpha) : alpha_(alpha) {}
  bool is_local() const override { return alpha_ > 0; }
  // D_i = −α Q_i if v_i Q_i > 0, else 0
  void add_local(ConstVec v, Vec Q) const override {
    for_each_index(Q.size(), [=, kept = 1 - alpha_](std::size_t i) { Q[i] *= v[i] * Q[i] > 0 ? kept : 1.0; });
  }

 private:
  double alpha_;
};

class Cundall final : public Damping {
 public:
  explicit Cundall(double alpha) : alpha_(alpha) {}
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

// A local damping force D(v, Q) that the calling program supplies.
class Own final : public Damping {
 public:
  Own(OwnDampingForce force, double alpha, double stiffness_factor)
      : force_(std::move(force)), alpha_(alpha), stiffness_factor_(stiffness_factor) {}
  bool is_local() const override { return true; }
  bool goes_by_pieces() const override { return false; }
  void add_local(ConstVec v, Vec Q) const override {
    D_.assign(Q.size(), 0.0);
    force_(alpha_, v, Q, D_);
    for_each_index(Q.size(), [=, D = D_.data()](std::size_t i) { Q[i] += D[i]; });
  }
  double stiffness_factor() const override { return stiffness_factor_; }

 private:
  OwnDampingForce force_;
  double alpha_, stiffness_factor_;
  mutable std::vector<double> D_;  // (n)
};

void require(bool ok, std::string_view strategy, std::string_view what, double found) {
  if (!ok) throw std::invalid_argument(fmt::format("damping '{}' needs {}, found {}", strategy, what, found));
}

void require_alpha(std::string_view name, double alpha) {
  require(alpha >= 0 && alpha < 1, name, "0 <= alpha < 1", alpha);
}
void require_c(std::string_view name, double c) { require(c >= 0 && std::isfinite(c), name, "c >= 0", c); }

using Make = std::function<std::unique_ptr<Damping>(double c, double alpha)>;

Registry<StrategyInfo, Make>& registry() {
  static Registry<StrategyInfo, Make> all({
      {{.name = "none", .equation = "M a = Q", .source = "", .damps = false},
       [](double, double) -> std::unique_ptr<Damping> { return std::make_unique<None>(); }},
      {{.name = "viscous",
        .equation = "M a = Q - c M v",
        .source = "mass-proportional; critical for c = 2 omega_1",
        .keys = {"c"}},
       [](double c, double) -> std::unique_ptr<Damping> {
         require_c("viscous", c);
         return std::make_unique<Viscous>(c);
       }},
      {{.name = "identity",
        .equation = "M a = Q - c v",
        .source = "Więckowski 2011, section 3.1: C = c I",
        .keys = {"c"},
        .is_identity = true},
       [](double c, double) -> std::unique_ptr<Damping> {
         require_c("identity", c);
         return std::make_unique<Identity>(c);
       }},
      {{.name = "one-sided",
        .equation = "M a = Q + D, D_i = -alpha Q_i if v_i Q_i > 0, else 0",
        .source = "Więckowski 2011, eq. 4",
        .keys = {"alpha"},
        .is_local = true},
       [](double, double alpha) -> std::unique_ptr<Damping> {
         require_alpha("one-sided", alpha);
         return std::make_unique<OneSided>(alpha);
       }},
      {{.name = "cundall",
        .equation = "M a = Q + D, D_i = -alpha |Q_i| sgn v_i",
        .source = "Cundall 1987",
        .keys = {"alpha"},
        .is_local = true},
       [](double, double alpha) -> std::unique_ptr<Damping> {
         require_alpha("cundall", alpha);
         return std::make_unique<Cundall>(alpha);
       }},
      {{.name = "combined",
        .equation = "M a = Q + D, D_i = -alpha/2 |Q_i| (sgn v_i - sgn dQ_i/dt)",
        .source = "Itasca, FLAC manual, combined damping",
        .keys = {"alpha"},
        .integrators = {"leapfrog", "symplectic-euler"},
        .is_local = true},
       [](double, double alpha) -> std::unique_ptr<Damping> {
         require_alpha("combined", alpha);
         return std::make_unique<Combined>(alpha);
       }},
  });
  return all;
}

}  // namespace

const std::vector<StrategyInfo>& dampings() { return registry().infos(); }

void put_damping(const StrategyInfo& about, double stiffness_factor, OwnDampingForce force) {
  registry().put(about, [=, force = std::move(force)](double, double alpha) -> std::unique_ptr<Damping> {
    return std::make_unique<Own>(force, alpha, stiffness_factor);
  });
}

bool is_undamped(std::string_view strategy) {
  const auto row = std::ranges::find(dampings(), strategy, &StrategyInfo::name);
  return row != dampings().end() && !row->damps;
}

std::unique_ptr<Damping> make_damping(std::string_view name, double c, double alpha) {
  if (const Make make = registry().maker(name)) return make(c, alpha);
  throw std::invalid_argument(fmt::format("there is no damping '{}'", name));
}

std::unique_ptr<Damping> no_damping() { return std::make_unique<None>(); }

}  // namespace stillpoint
