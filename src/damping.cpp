#include <stillpoint/damping.hpp>

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "parallel_loop.hpp"

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

void require(bool ok, std::string_view strategy, std::string_view what, double found) {
  if (!ok) throw std::invalid_argument(fmt::format("damping '{}' needs {}, found {}", strategy, what, found));
}

}  // namespace

const std::vector<DampingInfo>& damping_strategies() {
  static const std::vector<DampingInfo> strategies = {
      {"none", "M a = Q", ""},
      {"viscous", "M a = Q - c M v", "mass-proportional; critical for c = 2 omega_1"},
      {"identity", "M a = Q - c v", "Więckowski 2011, section 3.1: C = c I"},
      {"one-sided", "M a = Q + D, D_i = -alpha Q_i where v_i Q_i > 0, else 0", "Więckowski 2011, eq. 4"},
      {"cundall", "M a = Q + D, D_i = -alpha |Q_i| sgn v_i", "Cundall 1987"},
  };
  return strategies;
}

std::unique_ptr<Damping> make_damping(std::string_view name, double c, double alpha) {
  if (name == "none") return std::make_unique<None>();
  if (name == "viscous" || name == "identity") {
    require(c >= 0 && std::isfinite(c), name, "c >= 0", c);
    if (name == "viscous") return std::make_unique<Viscous>(c);
    return std::make_unique<Identity>(c);
  }
  if (name == "one-sided" || name == "cundall") {
    require(alpha >= 0 && alpha < 1, name, "0 <= alpha < 1", alpha);
    if (name == "one-sided") return std::make_unique<OneSided>(alpha);
    return std::make_unique<Cundall>(alpha);
  }
  throw std::invalid_argument(fmt::format("there is no damping strategy '{}'", name));
}

}  // namespace stillpoint
