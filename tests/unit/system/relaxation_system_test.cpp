// The right-hand side, residuals, energies and the error bound of a relaxation, against the formulas that define them.
#include <stillpoint/relaxation_system.hpp>
#include <stillpoint/state_norms.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/SparseCore>
#include <catch2/catch.hpp>

#include "chain.hpp"
#include "dense.hpp"
#include "largest.hpp"
#include "random_values.hpp"

using namespace stillpoint;
using namespace stillpoint::test;
using Catch::Matchers::WithinRel;

namespace {

using Values = std::vector<double>;

constexpr std::size_t n = 6;

/// A stiffening chain of unequal masses under load.
Chain stiffening(bool consistent) {
  return Chain({.stiffness = 3, .cubic = 2, .masses = {1, 0.5, 2, 4, 0.25, 1}, .consistent = consistent, .load = 0.7});
}

Eigen::VectorXd dense(ConstVec x) {
  return Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
}
Eigen::MatrixXd dense(const Mass& M) { return M.matrix(); }

Mass known_by_inverse(const Mass& M) {
  return Mass::by_inverse(M.size(), [&M](ConstVec b, Vec x) { M.solve(b, x); });
}

/// F − R(u)
Values balance(const Chain& chain, ConstVec u) {
  Values F(u.size()), R(u.size());
  chain.external_force(0, u, F);
  REQUIRE(chain.internal_force(0, u, R, *chain.make_trial()));
  std::ranges::transform(F, R, F.begin(), std::minus<>());
  return F;
}

/// One mass on a spring of stiffness 1 that says the spring's force as its reaction, under a load that may change.
class Supported : public Chain {
 public:
  explicit Supported(bool says_reactions) : Chain({.n = 1}), says_reactions_(says_reactions) {}
  double load = 0;
  void external_force(double /*t*/, ConstVec /*u*/, Vec F) const override { F[0] = load; }
  bool internal_force(double t, ConstVec u, Vec R, TrialState& trial) const override {
    if (says_reactions_) trial.reactions = {u[0]};
    return Chain::internal_force(t, u, R, trial);
  }

 private:
  bool says_reactions_;
};

}  // namespace

TEST_CASE("the right-hand side is v and M⁻¹ (F − R + D − c_I v) − c_M v, of any mass under any damping") {
  const bool consistent = GENERATE(false, true);
  const std::string strategy = GENERATE("none", "viscous", "identity", "one-sided", "cundall");
  CAPTURE(strategy, consistent);
  Chain chain = stiffening(consistent);
  const auto damping = make_damping(strategy, 0.3, 0.4);
  RelaxationSystem system(chain, *damping);
  const Values y = random_values(2 * n, 0.5);
  Values ydot(2 * n);
  REQUIRE(system(0, y, ydot));
  const ConstVec u = first_half(ConstVec(y)), v = second_half(ConstVec(y));
  Values Q = balance(chain, u);
  damping->add_local(v, Q);
  const LinearDamping C = damping->linear();
  const Eigen::VectorXd a = dense(chain.mass()).llt().solve(dense(Q) - C.identity * dense(v)) - C.mass * dense(v);
  CHECK(std::ranges::equal(first_half(ConstVec(ydot)), v));
  CHECK((dense(second_half(ConstVec(ydot))) - a).norm() < 1e-13 * a.norm());
}

TEST_CASE("with a mass that is known by its inverse the right-hand side is M⁻¹p and F − R − c p") {
  Chain chain = stiffening(true);
  const Mass inverse = known_by_inverse(chain.mass());
  const auto damping = make_damping("viscous", 0.3, 0);
  RelaxationSystem system(chain, *damping, {}, &inverse);
  const Values y = random_values(2 * n, 0.5);
  Values ydot(2 * n);
  REQUIRE(system(0, y, ydot));
  const ConstVec p = second_half(ConstVec(y));
  const Eigen::VectorXd v = dense(chain.mass()).llt().solve(dense(p));
  const Eigen::VectorXd p_dot = dense(balance(chain, first_half(ConstVec(y)))) - 0.3 * dense(p);
  CHECK((dense(first_half(ConstVec(ydot))) - v).norm() < 1e-13 * v.norm());
  CHECK((dense(second_half(ConstVec(ydot))) - p_dot).norm() < 1e-13 * p_dot.norm());
}

TEST_CASE("a mass that is known by its inverse alone goes with no local damping and no C = c I") {
  Chain chain({.n = 3});
  const Mass inverse = known_by_inverse(chain.mass());
  for (const std::string strategy : {"identity", "one-sided", "cundall", "combined"}) {
    CAPTURE(strategy);
    const auto damping = make_damping(strategy, 0.3, 0.4);
    CHECK_THROWS_AS(RelaxationSystem(chain, *damping, {}, &inverse), std::invalid_argument);
    CHECK_NOTHROW(RelaxationSystem(chain, *damping));
  }
}

TEST_CASE("of a long vector, in one pass over memory, the damped force is what it is in two") {
  const auto* strategy = GENERATE("none", "one-sided", "cundall", "combined");
  CAPTURE(strategy);
  constexpr std::size_t length = 20'001;  // several threads, pieces, and a last one that is not whole
  Chain chain({.n = length, .consistent = GENERATE(false, true), .load = 1e-3});
  const auto damping = make_damping(strategy, 0, 0.4);
  RelaxationSystem system(chain, *damping);
  Values u(length), v(length), in_one(length), in_two(length);
  for (std::size_t i = 0; i < length; ++i) {
    u[i] = std::sin(0.7 * static_cast<double>(i));
    v[i] = std::sin(1.3 * static_cast<double>(i));
  }
  for (const bool remembered : {false, true}) {
    REQUIRE(system.out_of_balance(0, u, in_two));
    if (remembered) system.remember_force();
    for (double& x : u) x *= 1.1;
    REQUIRE(system.out_of_balance(0, u, in_two));
    system.add_local_damping(v, in_two);
    REQUIRE(system.damped_out_of_balance(0, u, v, in_one));
    CHECK(in_one == in_two);
  }
}

TEST_CASE("damping by the sign of dQ/dt takes the force that was remembered, and none after it was forgotten") {
  Chain chain({.n = 1});  // Q = −u
  const auto damping = make_damping("combined", 0, 0.8);
  RelaxationSystem system(chain, *damping);
  const auto damped = [&](double u, double v) {
    Values Q(1);
    REQUIRE(system.damped_out_of_balance(0, Values{u}, Values{v}, Q));
    return Q[0];
  };
  CHECK_THAT(damped(1, 2), WithinRel(-1 - 0.4));  // sgn dQ/dt counts as 0
  system.remember_force();
  CHECK_THAT(damped(2, 2), WithinRel(-2 - 0.4 * 2 * 2));  // Q falls while v > 0: the two signs differ
  CHECK_THAT(damped(0.5, 2), WithinRel(-0.5));            // Q rises: they are the same
  system.forget_force();
  CHECK_THAT(damped(2, 2), WithinRel(-2 - 0.4 * 2));
}

TEST_CASE("the residual is ‖F − R‖/‖F‖, and known again at no further evaluation") {
  Chain chain = stiffening(false);
  const auto damping = no_damping();
  RelaxationSystem system(chain, *damping);
  StateNorms norms(system);
  const Values u = random_values(n, 0.5);
  const double expected = dense(balance(chain, u)).norm() / (0.7 * std::sqrt(static_cast<double>(n)));
  CHECK_THAT(norms.residual(0, u), WithinRel(expected, 1e-14));
  CHECK(system.evaluations() == 0);  // of integrators
  Values Q(n);
  REQUIRE(system.out_of_balance(0, Values(n), Q));
  CHECK(norms.last_residual() == 1);  // R = 0
  CHECK(system.evaluations() == 1);
}

TEST_CASE("where nothing loads a body its residual is relative to the largest reactions so far") {
  Supported body(true);
  const auto damping = no_damping();
  RelaxationSystem system(body, *damping);
  StateNorms norms(system);
  CHECK(norms.residual(0, Values{0}) == 0);
  CHECK(norms.residual(0, Values{-4}) == 1);
  CHECK(norms.residual(0, Values{1}) == 0.25);
  body.load = 8;
  CHECK(norms.residual(0, Values{6}) == 0.25);  // ‖F‖ again
  body.load = 1e-13;                            // what rounding leaves of 8
  CHECK_THAT(norms.residual(0, Values{2}), WithinRel(0.25, 1e-12));
}

TEST_CASE("where nothing loads or holds a body its residual is relative to its largest internal force so far") {
  Supported body(false);
  const auto damping = no_damping();
  RelaxationSystem system(body, *damping);
  StateNorms norms(system);
  CHECK(norms.residual(0, Values{0}) == 0);
  CHECK(norms.residual(0, Values{-4}) == 1);
  CHECK(norms.residual(0, Values{1}) == 0.25);
}

TEST_CASE("a state that cannot be evaluated has no residual, and its trial is refused") {
  Chain chain({.n = 2, .cubic = 1});
  const auto damping = no_damping();
  RelaxationSystem system(chain, *damping);
  const Values y(4, 1e200);  // whose cube is no number
  Values ydot(4), Q(2);
  CHECK_FALSE(system(0, y, ydot));
  CHECK_FALSE(system.out_of_balance(0, first_half(ConstVec(y)), Q));
  CHECK_FALSE(system.damped_out_of_balance(0, first_half(ConstVec(y)), second_half(ConstVec(y)), Q));
  CHECK(std::isnan(StateNorms(system).residual(0, first_half(ConstVec(y)))));
  CHECK(system.evaluations() == 3);
}

TEST_CASE(
    "the error bound of a linear system is ‖u − u*‖_K where the error is the lowest mode, and no less elsewhere") {
  Chain chain({.n = 30, .mass = 0.5, .stiffness = 8, .consistent = GENERATE(false, true), .load = 0.1});
  const Eigen::MatrixXd K = chain.matrix(Tangent::consistent, 0, Values(30)), M = dense(chain.mass());
  const Eigen::VectorXd rest = K.llt().solve(Eigen::VectorXd::Constant(30, 0.1));
  const double omega_1 = std::sqrt(dense_eigenvalues(K, M)[0]);
  const auto damping = no_damping();
  RelaxationSystem system(chain, *damping);
  StateNorms norms(system);
  const auto ratio = [&](const Eigen::VectorXd& error) {
    const Eigen::VectorXd u = rest + error;
    norms.residual(0, ConstVec(u.data(), 30));
    return norms.energy_error(chain.mass(), omega_1) / std::sqrt(error.dot(K * error));
  };
  Eigen::VectorXd mode = Eigen::VectorXd::Ones(30);
  for (int k = 0; k < 40; ++k) mode = K.llt().solve(M * mode).normalized();
  CHECK_THAT(ratio(mode), WithinRel(1, 1e-9));
  for (unsigned seed = 1; seed <= 5; ++seed) CHECK(ratio(dense(random_values(30, 1, seed))) > 1.5);
}

TEST_CASE("power, energies and norms are those of Q, F, R and M at the last evaluation") {
  Chain chain = stiffening(true);
  const Mass inverse = known_by_inverse(chain.mass());
  const auto damping = no_damping();
  RelaxationSystem system(chain, *damping), by_momentum(chain, *damping, {}, &inverse);
  const Values u = random_values(n, 0.5, 1);
  Values v = random_values(n, 2, 2), p(n);
  chain.mass().apply(v, p);
  const Eigen::VectorXd Q = dense(balance(chain, u)), F = Eigen::VectorXd::Constant(n, 0.7), R = F - Q;
  const Eigen::MatrixXd M = dense(chain.mass());
  Vector u_ = system.vectors().make(n), v_ = system.vectors().view(v), p_ = system.vectors().view(p);
  std::ranges::copy(u, u_.span().begin());
  for (RelaxationSystem* each : {&system, &by_momentum}) {
    StateNorms norms(*each);
    norms.residual(0, u);
    const auto motion = norms.motion(each == &system ? v_ : p_);
    CHECK_THAT(motion.power, WithinRel(Q.dot(dense(v)), 1e-12));
    CHECK_THAT(motion.kinetic_energy, WithinRel(0.5 * dense(v).dot(M * dense(v)), 1e-12));
    CHECK_THAT(norms.work_scale(u_), WithinRel(std::abs(F.dot(dense(u))) + std::abs(R.dot(dense(u))), 1e-13));
    CHECK_THAT(norms.mass_norm(chain.mass(), u_), WithinRel(std::sqrt(dense(u).dot(M * dense(u))), 1e-13));
    CHECK_THAT(norms.energy_error(chain.mass(), 2), WithinRel(std::sqrt(Q.dot(M.llt().solve(Q))) / 2, 1e-13));
  }
}

TEST_CASE("a system that is restored has the forces, the scale and the count of the one that was saved") {
  Supported body(false);
  const auto damping = make_damping("combined", 0, 0.5);
  RelaxationSystem system(body, *damping);
  Values Q(1), again(1);
  body.load = 4;
  REQUIRE(system.out_of_balance(1, Values{1}, Q));
  StateNorms(system).last_residual();
  system.remember_force();
  body.load = 0;
  REQUIRE(system.out_of_balance(2, Values{1}, Q));
  SavedState saved;
  system.archive(StateArchive::saving(saved));
  RelaxationSystem restored(body, *damping);
  restored.archive(StateArchive::restoring(saved));
  CHECK(restored.evaluations() == 2);
  CHECK(restored.last().t == 2);
  CHECK(StateNorms(restored).last_residual() == 0.25);  // of ‖F‖ = 4 before
  REQUIRE(system.damped_out_of_balance(3, Values{2}, Values{1}, Q));
  REQUIRE(restored.damped_out_of_balance(3, Values{2}, Values{1}, again));
  CHECK(again == Q);
  CHECK(Q[0] == -3);  // −2, and half as much: Q fell from the 3 that was remembered
}
