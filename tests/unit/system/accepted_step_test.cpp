// What an accepted step does to a system: it commits once, contacts open and close; and the forces that only the motion
// feels.
#include <stillpoint/relaxation_system.hpp>
#include <stillpoint/state_norms.hpp>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "chain.hpp"

using namespace stillpoint;
using namespace stillpoint::test;

namespace {

using Values = std::vector<double>;

/// Two masses on springs that count what is evaluated and committed, and remember the u that was.
class Remembering : public Chain {
 public:
  Remembering() : Chain({.n = 2, .load = 3}) { history_dependent_ = true; }
  mutable int evaluations = 0;
  Values committed;  // the first mass's u of each commit

  std::unique_ptr<TrialState> make_trial() const override { return std::make_unique<Trial>(); }
  bool internal_force(double t, ConstVec u, Vec R, TrialState& trial) const override {
    ++evaluations;
    static_cast<Trial&>(trial).u = u[0];
    return Chain::internal_force(t, u, R, trial);
  }
  void commit(TrialState& trial) override { committed.push_back(static_cast<Trial&>(trial).u); }

 private:
  struct Trial : TrialState {
    double u = 0;
  };
};

/// Pushes the first mass by a force of 5 and 2 c v_obstacle with v_obstacle = 10, and holds it.
class Obstacle : public Contact {
 public:
  int updates = 0;
  void add_force(double /*t*/, const LinearDamping& C, Vec Q) const override { Q[0] = held_ = Q[0] + 5 + 20 * C.mass; }
  void hold(Vec Q) const override { Q[0] = held_; }
  ContactChange update(double /*t*/, Vec /*u*/, Vec v) override {
    ++updates, v[0] = 0;
    return ContactChange::velocity;
  }
  double squared_forces(double sum) const override { return sum + 25; }

 private:
  mutable double held_ = 0;
};

class Touching : public Chain {
 public:
  explicit Touching(ChainOptions options) : Chain(std::move(options)) { contact_ = &obstacle; }
  Obstacle obstacle;
};

/// A support that moves with a = 2 and v = 7 and takes the last mass along.
class Pulled : public Chain {
 public:
  Pulled() : Chain({.n = 2, .consistent = true, .load = 1}) {}
  void add_support_inertia(double /*t*/, double c, Vec Q) const override { Q[1] -= 2 + 7 * c; }
};

}  // namespace

TEST_CASE("an accepted step is committed once, evaluated anew only where the last evaluation was elsewhere") {
  Remembering body;
  const auto damping = no_damping();
  RelaxationSystem system(body, *damping);
  Values y = {0.5, 1, 0, 0}, Q(2);
  REQUIRE(system.out_of_balance(0, first_half(ConstVec(y)), Q));
  CHECK(system.accept(0, y, true) == ContactChange::nothing);
  CHECK(body.committed == Values{0.5});
  system.accept(0, y, true);
  CHECK(body.committed == Values{0.5});
  CHECK(body.evaluations == 1);
  y[0] = 0.75;
  system.accept(1, y, false);
  CHECK(body.committed == Values{0.5, 0.75});
  CHECK(body.evaluations == 2);
  CHECK(system.evaluations() == 1);  // of integrators
}

TEST_CASE("a system without memory and contact evaluates nothing when a step is accepted") {
  class Forgetful : public Remembering {
   public:
    Forgetful() { history_dependent_ = false; }
  } body;
  const auto damping = no_damping();
  RelaxationSystem system(body, *damping);
  Values y(4);
  CHECK(system.accept(0, y, false) == ContactChange::nothing);
  CHECK(body.evaluations == 0);
  CHECK(body.committed.empty());
}

TEST_CASE("a contact's force is in Q with the damping in force, and local damping leaves it as it is") {
  Touching body({.n = 2, .load = 1});
  const auto viscous = make_damping("viscous", 0.25, 0), cundall = make_damping("cundall", 0, 0.5);
  RelaxationSystem damped(body, *viscous), local(body, *cundall);
  const Values rest(2), v = {1, 1};
  Values Q(2);
  REQUIRE(damped.out_of_balance(0, rest, Q));
  CHECK(Q == Values{1 + 5 + 20 * 0.25, 1});
  damped.set_damping_rate(0.5);
  REQUIRE(damped.out_of_balance(0, rest, Q));
  CHECK(Q == Values{1 + 5 + 20 * 0.5, 1});
  REQUIRE(local.damped_out_of_balance(0, rest, v, Q));
  CHECK(Q == Values{1 + 5, 0.5});
}

TEST_CASE("a contact's force counts in the residual and in its scale, and its update is that of an accepted step") {
  Touching body({.n = 2});  // no load
  const auto damping = no_damping();
  RelaxationSystem system(body, *damping);
  StateNorms norms(system);
  CHECK(norms.residual(0, Values{0, 0}) == 1);  // ‖(5, 0)‖ over the contact's 5
  CHECK_THAT(norms.residual(0, Values{-2, 0}), Catch::Matchers::WithinRel(std::hypot(5 + 4, -2) / 5, 1e-15));
  Values y = {0, 0, 4, 4};
  CHECK(system.accept(0, y, false) == ContactChange::velocity);
  CHECK(body.obstacle.updates == 1);
  CHECK(y == Values{0, 0, 0, 4});
}

TEST_CASE(
    "the inertia of a moving support is a force of the motion, with the damping in force, and no lack of balance") {
  Pulled body;
  const auto damping = make_damping("viscous", 0.5, 0);
  RelaxationSystem system(body, *damping);
  Values Q(2);
  REQUIRE(system.out_of_balance(0, Values(2), Q));
  CHECK(Q == Values{1, 1 - 2 - 7 * 0.5});
  CHECK(StateNorms(system).last_residual() == 1);  // ‖F‖/‖F‖
  system.last_out_of_balance(0, Q);
  CHECK(Q == Values{1, 1 - 2 - 7 * 0.5});
}

TEST_CASE("loads that are constant are evaluated once, and others in every evaluation") {
  class Loaded : public Chain {
   public:
    explicit Loaded(bool constant) : Chain({.n = 1}) { loads_are_constant_ = constant; }
    mutable int asked = 0;
    void external_force(double /*t*/, ConstVec /*u*/, Vec F) const override { F[0] = ++asked; }
  };
  Loaded constant(true), changing(false);
  const auto damping = no_damping();
  RelaxationSystem once(constant, *damping), always(changing, *damping);
  Values Q(1);
  for (int k = 1; k <= 3; ++k) {
    REQUIRE(once.out_of_balance(0, Values{0}, Q));
    CHECK(Q[0] == 1);
    REQUIRE(always.out_of_balance(0, Values{0}, Q));
    CHECK(Q[0] == k);
  }
  CHECK(constant.asked == 1);
}
