// Supports that hold by springs, on parts of faces and in mid-face.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/SparseCore>
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "elastic_block.hpp"
#include "scenes.hpp"
#include "simulation/parts.hpp"
#include "space/phase/lagrangian_phase.hpp"
#include "statics.hpp"

using namespace stillpoint;
using namespace stillpoint::test;

TEST_CASE("a pin in mid-face holds a stretched block against rigid motion and leaves its strain as it is") {
  // Uniform tension q, between a roller on the left and a pin at (0, 0.47): u_x = q x (1 − ν²), u_y = −q ν (1 + ν)(y −
  // 0.47).
  constexpr double q = 0.01, nu = 0.3, at = 0.47;
  for (const char* basis : {"linear", "quadratic", "cubic", "hermite"}) {
    CAPTURE(basis);
    const Scene scene = block({of(basis), fmt::format("traction=[{{face='right', value=[{}, 0]}}]", q),
                               fmt::format("support=[{{face='left', kind='roller'}}, {{at=[0, {}], component='y', "
                                           "name='pin'}}]",
                                           at)});
    Simulation simulation(scene);
    REQUIRE(simulation.run() == RunStatus::equilibrium);
    const std::vector<double> x = simulation.parts().phase.fields().positions();
    const ConstVec u = simulation.field("u");
    double error = 0;
    for (std::size_t p = 0; p < simulation.points(); ++p) {
      error = std::max({error, std::abs(u[2 * p] - q * (1 - nu * nu) * x[2 * p]),
                        std::abs(u[2 * p + 1] + q * nu * (1 + nu) * (x[2 * p + 1] - at))});
    }
    CHECK(error < 1e-9 * q);  // the residual's part of it
    const Summary s = simulation.summary();
    REQUIRE(s.weak_supports.size() == 1);
    CHECK(s.weak_supports[0].gap < 1e-9 * q);
    CHECK(std::abs(s.reactions.at("pin")[1]) < 1e-9 * q);
    CHECK(std::ranges::none_of(s.notes, [](const std::string& note) {
      return note.find("nothing holds") != std::string::npos || note.find("gives way") != std::string::npos;
    }));
  }
}

TEST_CASE("springs are in R(u) and in K(u): the tangent is R's derivative, as a product and as a matrix") {
  for (const char* basis : {"linear", "quadratic", "cubic", "hermite"}) {
    const auto phase = make_phase(block({of(basis), "grid.cells=[3, 3]",
                                         "support=[{face='bottom'}, {at=[0.45, 0.55], component='x', u=0.01}, "
                                         "{face='top', from=0.2, to=0.9, stiffness=5, u=-0.01}]"}));
    const std::size_t n = phase->size();
    std::vector<double> u(n), du(n), product(n);
    for (std::size_t k = 0; k < n; ++k)
      u[k] = 0.01 * std::sin(static_cast<double>(3 * k)), du[k] = std::cos(static_cast<double>(k));
    phase->tangents().apply(Tangent::consistent, 0, u, du, product);
    const SparseMatrix K = phase->tangents().matrix(Tangent::elastic, 0, u);
    const Eigen::VectorXd by_matrix = K * Eigen::Map<const Eigen::VectorXd>(du.data(), static_cast<Eigen::Index>(n));
    CHECK((K - SparseMatrix(K.transpose())).norm() < 1e-14 * K.norm());  // rounding
    std::vector<double> there(n);
    for (std::size_t k = 0; k < n; ++k) there[k] = u[k] + du[k];
    const std::vector<double> R = statics::internal_force(*phase, u), R_there = statics::internal_force(*phase, there);
    double error = 0, scale = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const double change = R_there[k] - R[k];  // R is linear
      error =
          std::max({error, std::abs(change - product[k]), std::abs(change - by_matrix[static_cast<Eigen::Index>(k)])});
      scale = std::max(scale, std::abs(change));
    }
    CAPTURE(basis);
    CHECK(error < 1e-12 * scale);
    // Without displacement, the springs alone pull towards what is prescribed.
    const std::vector<double> at_rest = statics::internal_force(*phase, std::vector<double>(n, 0.0));
    CHECK(*std::ranges::max_element(at_rest) > 0);
  }
}

TEST_CASE("a weakly held face gives way by what its springs say, and converges to the strongly held one as h") {
  // The part from 0 to 1 of a quadratic face is the whole face, and held by springs.
  for (const char* basis : {"quadratic", "cubic"}) {
    CAPTURE(basis);
    std::vector<double> errors, gaps;
    for (const int n : {4, 8, 16}) {
      const auto pressed = [&](const char* part) {
        return solved({of(basis), cells(n),
                       fmt::format("support=[{{face='bottom'}}, {{face='left', kind='roller'}}, "
                                   "{{face='top', name='lid', kind='roller', u=-0.01{}}}]",
                                   part)});
      };
      const Summary strong = pressed(""), weak = pressed(", from=0, to=1");
      const double reaction = strong.reactions.at("lid")[1];
      CHECK(strong.weak_supports.empty());
      REQUIRE(weak.weak_supports.size() == 1);
      errors.push_back(std::abs(weak.reactions.at("lid")[1] / reaction - 1));
      gaps.push_back(weak.weak_supports[0].share);
    }
    CAPTURE(errors, gaps);
    for (std::size_t k = 1; k < errors.size(); ++k) {
      const double order = std::log2(errors[k - 1] / errors[k]);
      CHECK(order > 0.85);
      CHECK(order < 1.15);
    }
    CHECK(errors.back() < 0.03);  // 16 cells
    CHECK(gaps.back() < 0.03);
  }
}

TEST_CASE("the force under a footing that quadratic springs hold converges to that which linear nodes hold") {
  std::vector<double> differences;
  for (const int n : {8, 16, 32}) {
    const double strong =
        solved({kFooting, of("linear"), cells(n), "body.points_per_cell=4"}).reactions.at("footing")[1];
    const double weak = solved({kFooting, of("quadratic"), cells(n)}).reactions.at("footing")[1];
    CHECK(weak / strong < 1);  // springs give way, and linear cells are too stiff
    differences.push_back(1 - weak / strong);
  }
  CAPTURE(differences);
  CHECK(differences[1] < 0.65 * differences[0]);
  CHECK(differences[2] < 0.65 * differences[1]);
  CHECK(differences[2] < 0.03);
}

TEST_CASE("a smooth footing moves along its face, a rough one does not, and the rough one bears more") {
  const auto pressed = [](const char* kind) {
    return solved({of("quadratic"), fmt::format("support=[{{face='bottom'}}, {{face='top', name='footing', from=0.25, "
                                                "to=0.75, u=-0.01, kind='{}'}}]",
                                                kind)});
  };
  const Summary smooth = pressed("roller"), rough = pressed("fixed");
  CHECK(smooth.reactions.at("footing")[0] == 0);
  CHECK(std::abs(rough.reactions.at("footing")[0]) < 1e-10);  // by symmetry
  CHECK(rough.reactions.at("footing")[1] < smooth.reactions.at("footing")[1]);
  CHECK(smooth.reactions.at("footing")[1] < 0);
}

TEST_CASE("a relaxation finds the gap and the reactions of Newton's method") {
  for (const char* basis : {"linear", "quadratic"}) {
    const Summary newton = solved({kFooting, of(basis)});
    for (const char* damping : {"viscous", "kinetic", "auto"}) {
      const Summary relaxed = run(block({kFooting, of(basis), "solve.method=relaxation",
                                         fmt::format("damping.strategy={}", damping), "stop.residual=1e-9"}));
      CAPTURE(basis, damping, relaxed.reason);
      REQUIRE(relaxed.status == RunStatus::equilibrium);
      CHECK(relaxed.reactions.at("footing")[1] == Approx(newton.reactions.at("footing")[1]).epsilon(1e-6));
      CHECK(relaxed.reactions.at("base")[1] == Approx(newton.reactions.at("base")[1]).epsilon(1e-6));
      if (newton.weak_supports.empty()) continue;
      CHECK(relaxed.weak_supports[0].gap == Approx(newton.weak_supports[0].gap).epsilon(1e-6));
    }
  }
}

TEST_CASE("springs as stiff as a cell leave at least 0.55 of the critical step, and stiffer ones shorten it") {
  const auto critical_step = [](const std::string& basis, const std::string& more) {
    return *run(block({of(basis), "solve.method=relaxation", "stop.residual=0", "stop.steps=1",
                       "support=[{face='bottom'}" + more + "]"}))
                .critical_step;
  };
  for (const char* basis : {"linear", "quadratic", "cubic", "hermite"}) {
    const double without = critical_step(basis, "");
    for (const char* more : {", {at=[0.47, 1], component='y'}", ", {at=[0.5, 0.53], component='x'}",
                             ", {at=[1, 0.53], component='x'}, {at=[1, 0.53], component='y'}"}) {
      const double share = critical_step(basis, more) / without;
      CAPTURE(basis, more, share);
      CHECK(share > 0.55);  // 0.60 to 1.00
      CHECK(share <= 1 + 1e-6);
    }
    if (std::string(basis) == "linear" || std::string(basis) == "hermite") continue;
    const double share = critical_step(basis, ", {face='top', from=0.3, to=0.8}") / without;
    CAPTURE(basis, share);
    CHECK(share > 0.55);  // 0.64 and 0.67
  }
  CHECK(critical_step("quadratic", ", {at=[0.5, 1], component='y', stiffness=1e4}") <
        0.2 * critical_step("quadratic", ""));
}

TEST_CASE("functions that hardly reach the body shorten no step by a spring on them") {
  // The body ends 0.02 of a cell past a grid line, and is pinned there.
  const auto critical_step = [](const std::string& more) {
    return *run(block({of("quadratic"), "grid.max=[1.2, 1]", "grid.cells=[8, 8]", "body.max=[1.053, 1]",
                       "solve.method=relaxation", "stop.residual=0", "stop.steps=1",
                       "support=[{face='bottom'}" + more + "]"}))
                .critical_step;
  };
  CHECK(critical_step(", {at=[1.053, 0.5], component='x'}") > 0.55 * critical_step(""));
}

TEST_CASE("a stiffness that is given is that of the spring: a block on springs sinks by its weight over them") {
  // A face of 1 m² on 50 N/m³ under a weight of 1 N, and a roller at the side: u = 0.02 m at the bottom.
  const Summary s = solved({of("linear"),
                            "support=[{face='bottom', kind='roller', stiffness=50, name='ground'}, "
                            "{face='left', kind='roller'}]",
                            "body_force.value=[0, -1]"});
  CHECK(s.reactions.at("ground")[1] == Approx(1).epsilon(1e-9));
  REQUIRE(s.weak_supports.size() == 1);
  CHECK(s.weak_supports[0].stiffness == Approx(50));
  CHECK(s.weak_supports[0].gap > 0.0199);
  CHECK(std::ranges::none_of(s.notes,
                             [](const std::string& note) { return note.find("gives way") != std::string::npos; }));
  const Summary bar = run(scenes::bar({"support=[{at=0.0, stiffness=0.01, name='end'}]", "stop.residual=1e-10"}));
  CHECK(bar.weak_supports[0].gap == Approx(0.1).epsilon(1e-6));  // P₀/k
  CHECK(bar.reactions.at("end")[0] == Approx(-0.001).epsilon(1e-6));
}

TEST_CASE("a spring that no material reaches, or whose functions are all held, is refused") {
  const auto message = [&](const std::string& spring) {
    try {
      make_phase(block({of("quadratic"), "body.max=[0.6, 0.7]", "support=[{face='bottom'}, " + spring + "]"}));
    } catch (const SceneError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  CHECK_THAT(message("{at=[0.95, 0.9]}"), Catch::Contains("no material reaches this support"));
  CHECK_THAT(message("{at=[0.3, 0]}"), Catch::Contains("this place is supported already"));
  CHECK_THAT(message("{face='right', from=0.1, to=0.2}"), Catch::Contains("no material reaches this support"));
  CHECK(message("{at=[0.3, 0.02]}") == "accepted");
}
