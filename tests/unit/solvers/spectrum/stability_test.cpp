#include <stillpoint/stability.hpp>

#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <string_view>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <catch2/catch.hpp>

#include "chain.hpp"
#include "dense.hpp"
#include "largest.hpp"
#include "solvers/integrators/butcher.hpp"

using namespace stillpoint;
using stillpoint::test::Chain;

namespace {

// Limits as measured before, to two digits after the point.
Approx printed(double value) { return Approx(value).epsilon(0).margin(0.005 + 1e-9); }

const ButcherTable heun_euler = {"Heun-Euler", 2, 2, 1, {0, 0, 1, 0}, {0.5, 0.5}, {0, 1}, {1, 0}};
const ButcherTable cash_karp = {"Cash-Karp",
                                6,
                                5,
                                0,
                                {0,
                                 0,
                                 0,
                                 0,
                                 0,
                                 0,  //
                                 1. / 5,
                                 0,
                                 0,
                                 0,
                                 0,
                                 0,  //
                                 3. / 40,
                                 9. / 40,
                                 0,
                                 0,
                                 0,
                                 0,  //
                                 3. / 10,
                                 -9. / 10,
                                 6. / 5,
                                 0,
                                 0,
                                 0,  //
                                 -11. / 54,
                                 5. / 2,
                                 -70. / 27,
                                 35. / 27,
                                 0,
                                 0,  //
                                 1631. / 55296,
                                 175. / 512,
                                 575. / 13824,
                                 44275. / 110592,
                                 253. / 4096,
                                 0},
                                {37. / 378, 0, 250. / 621, 125. / 594, 0, 512. / 1771},
                                {0, 1. / 5, 3. / 10, 3. / 5, 1, 7. / 8},
                                {}};

// Central differences with averaged damping: |μ|² = (1 − ch/2)/(1 + ch/2) up to h ω = 2.
double leapfrog(double h, double omega, double rate) {
  const double damping = h * rate / 2, determinant = (1 - damping) / (1 + damping);
  const double mean = (1 - h * h * omega * omega / 2) / (1 + damping);
  const double discriminant = mean * mean - determinant;
  return discriminant < 0 ? std::sqrt(determinant) : std::abs(mean) + std::sqrt(discriminant);
}

class TestDamping : public Damping {
 public:
  TestDamping(LinearDamping C, double factor) : C_(C), factor_(factor) {}
  LinearDamping linear() const override { return C_; }
  double stiffness_factor() const override { return factor_; }

 private:
  LinearDamping C_;
  double factor_;
};

}  // namespace

TEST_CASE("stability limits are those of the published and measured table") {
  struct Row {
    ButcherTable table;
    double imaginary, zeta_005, zeta_02;
  };
  for (const Row& row :
       {Row{classical_rk4(), 2.83, 2.91, 2.94}, Row{sofroniou_spaletta_5_3_4(), 2.83, 2.91, 2.94},
        Row{jameson_5(), 4.00, 4.04, 3.52}, Row{heun_euler, 0, 0.80, 1.39}, Row{cash_karp, 0.04, 2.63, 3.14}}) {
    INFO(row.table.name);
    const AmplificationRadius amplification = amplification_of(row.table);
    CHECK(stability_limit(amplification, 0) == printed(row.imaginary));
    CHECK(stability_limit(amplification, 0.05) == printed(row.zeta_005));
    CHECK(stability_limit(amplification, 0.2) == printed(row.zeta_02));
  }
}

TEST_CASE("known limits come out exactly") {
  const AmplificationRadius rk4 = amplification_of(classical_rk4());
  CHECK(stability_limit(rk4, 0) == Approx(2 * std::numbers::sqrt2).epsilon(1e-9));
  CHECK(stability_limit(amplification_of(jameson_5()), 0) == Approx(4).epsilon(1e-9));
  // Overdamped: the fast root −ω(ζ + √(ζ² − 1)) against RK4's real axis, 2.785293563.
  CHECK(stability_limit(rk4, 2) == Approx(2.785293563405282 / (2 + std::sqrt(3.0))).epsilon(1e-9));
  CHECK(stability_limit(leapfrog, 0) == Approx(2).epsilon(1e-9));
  CHECK(stability_limit(leapfrog, 0.2) == Approx(2).epsilon(1e-9));
}

TEST_CASE("a method that amplifies every undamped mode has no stable step") {
  CHECK(stability_limit(amplification_of(heun_euler), 0) == 0);
  CHECK(critical_step(amplification_of(heun_euler), {0.1, 1, 0, 0, 1}) == 0);
  CHECK(critical_step(amplification_of(heun_euler), {0.1, 1, 0.2, 0.2, 1}) > 0.1);
}

TEST_CASE("a method that is always stable has no limit") {
  const AmplificationRadius implicit = [](double h, double omega, double) { return 1 / (1 + h * omega); };
  CHECK(stability_limit(implicit, 0) == std::numeric_limits<double>::infinity());
  CHECK(critical_step(implicit, {0.1, 1, 0, 0, 1}) == std::numeric_limits<double>::infinity());
}

TEST_CASE("beside a damping rate of any size leapfrog keeps 2/omega and a Runge-Kutta method its limit over the rate") {
  for (const double rate : {1e4, 1e8, 1e20, 1e160, 1e300}) {
    CAPTURE(rate);
    CHECK(critical_step(leapfrog, {1, 50, rate, rate, 1}) == Approx(2. / 50).epsilon(1e-6));
    // |1 + z + z²/2 + z³/6 + z⁴/24| = 1 at z = −2.78529356
    CHECK(rate * critical_step(amplification_of(classical_rk4()), {1, 50, rate, rate, 1}) ==
          Approx(2.78529356).epsilon(1e-6));
  }
}

TEST_CASE("an amplification that is not a number is not stable") {
  const AmplificationRadius broken = [](double, double, double) { return std::nan(""); };
  CHECK(stability_limit(broken, 0) == 0);
}

TEST_CASE("the critical step scales with omega_max and shrinks with local damping as 1/sqrt(1 + alpha)") {
  CHECK(critical_step(leapfrog, {0, 50, 0, 0, 1}) == Approx(2. / 50).epsilon(1e-9));
  CHECK(critical_step(leapfrog, {1, 50, 0, 0, 1.7}) == Approx(2. / 50 / std::sqrt(1.7)).epsilon(1e-9));
  CHECK(critical_step(leapfrog, {1, 50, 2, 2, 1}) == Approx(2. / 50).epsilon(1e-9));
}

TEST_CASE("the critical step is stable for every frequency and rate in the ranges, and 1 % more is not") {
  for (const ButcherTable& table : {classical_rk4(), sofroniou_spaletta_5_3_4(), jameson_5(), heun_euler}) {
    for (const DampedSpectrum& spectrum : {DampedSpectrum{0.1, 10, 0.2, 0.2, 1}, DampedSpectrum{0, 10, 0.5, 30, 1},
                                           DampedSpectrum{2, 10, 3, 8, 1.5}, DampedSpectrum{5, 10, 60, 80, 1}}) {
      const AmplificationRadius amplification = amplification_of(table);
      const double h = critical_step(amplification, spectrum);
      const auto worst = [&](double step) {
        Largest largest;
        const double low = spectrum.omega_1 > 0 ? spectrum.omega_1 : 1e-3 * spectrum.omega_max;
        const double high = spectrum.omega_max * std::sqrt(spectrum.stiffness_factor);
        for (int i = 0; i <= 500; ++i) {
          for (int j = 0; j <= 50; ++j) {
            const double omega = low * std::pow(high / low, i / 500.),
                         rate = spectrum.rate_min + (spectrum.rate_max - spectrum.rate_min) * j / 50;
            largest.take(amplification(step, omega, rate));
          }
        }
        return largest.value();
      };
      INFO(table.name << ", rates " << spectrum.rate_min << " to " << spectrum.rate_max << ": h = " << h);
      CHECK(h > 0);
      CHECK(worst(h) <= 1 + 1e-6);
      CHECK(worst(1.01 * h) > 1 + 1e-6);
    }
  }
}

TEST_CASE("viscous damping has one rate, identity damping has those of the extreme masses") {
  const Chain lumped({.masses = {2, 0.5, 4}});
  const DampedSpectrum viscous = damped_spectrum(1, 9, TestDamping({.mass = 0.3}, 1), lumped.mass());
  CHECK(viscous.rate_min == 0.3);
  CHECK(viscous.rate_max == 0.3);
  const DampedSpectrum identity = damped_spectrum(1, 9, TestDamping({.mass = 0.3, .identity = 2}, 1.7), lumped.mass());
  CHECK(identity.omega_1 == 1);
  CHECK(identity.omega_max == 9);
  CHECK(identity.stiffness_factor == 1.7);
  CHECK(identity.rate_min == Approx(0.3 + 2. / 4));
  CHECK(identity.rate_max == Approx(0.3 + 2 / 0.5));
}

TEST_CASE("the rates of identity damping enclose those of a consistent mass within 2 %") {
  for (const std::size_t n : {1u, 2u, 30u, 300u}) {
    std::vector<double> masses;
    for (std::size_t i = 0; i < n; ++i) masses.push_back(1 + 0.5 * std::sin(5.0 * static_cast<double>(i)));
    const Chain chain({.masses = masses, .consistent = true});
    const Eigen::VectorXd m = test::dense_eigenvalues(chain.mass().matrix());
    const DampedSpectrum spectrum = damped_spectrum(1, 9, TestDamping({.identity = 0.45}, 1), chain.mass());
    INFO("n = " << n);
    CHECK(spectrum.rate_min <= 0.45 / m.maxCoeff());
    CHECK(spectrum.rate_min >= 0.45 / m.maxCoeff() / 1.02);
    CHECK(spectrum.rate_max >= 0.45 / m.minCoeff());
    CHECK(spectrum.rate_max <= 0.45 / m.minCoeff() * 1.02);
  }
}

TEST_CASE("a kick and a drift with Cundall's damping let motions grow from h = 2/√(1 + α) on", "[stability]") {
  const OscillatorStep kick_drift = [](double h, const Damping& local, Oscillators& all) {
    std::vector<double> Q;
    for (const double u : all.u) Q.push_back(-u);
    local.add_local(all.v, Q);
    for (std::size_t k = 0; k < Q.size(); ++k) {
      all.v[k] += h * Q[k];
      all.u[k] += h * all.v[k];
    }
  };
  for (const double alpha : {0.2, 0.5, 0.7, 0.9}) {
    CAPTURE(alpha);
    const auto cundall = make_damping("cundall", 0, alpha), one_sided = make_damping("one-sided", 0, alpha);
    CHECK(switched_stability_limit(kick_drift, *cundall) == Approx(2 / std::sqrt(1 + alpha)).epsilon(5e-3));
    // 2, but from √3 on, where three steps make a period, motions hardly meet one-sided damping: it is on the safe side
    const double limit = switched_stability_limit(kick_drift, *one_sided);
    CHECK(limit <= 2.01);
    CHECK(limit >= 1.73);
  }
}

TEST_CASE("a motion that meets the switches of local damping in time with Jameson's step grows from half its limit on",
          "[stability]") {
  const double linear = stability_limit(amplification_of(jameson_5()), 0);
  for (const std::string_view damping : {"cundall", "one-sided"}) {
    const double switched = switched_stability_limit(oscillator_step_of(jameson_5()), *make_damping(damping, 0, 0.7));
    CHECK(switched < 0.6 * linear);
    CHECK(switched > 0.4 * linear);
  }
}
