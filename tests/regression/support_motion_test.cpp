// Moving supports against exact motions.
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "scenes.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;

namespace {

// The bar without its force, with x = 0 moved and u = motion everywhere as the exact solution.
Summary pulled_bar(const std::string& motion, const std::vector<std::string>& more) {
  std::vector<std::string> overrides{"support=[{at=0.0, u='" + motion + "'}]",
                                     "force=[]",
                                     "stop.residual=0",
                                     "exact.u=" + motion,
                                     "exact.stress=0",
                                     "output.every=1"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return run(scenes::bar(overrides));
}

/// The block, held on all its faces by these displacements, with them as its exact solution.
std::vector<std::string> held_all_round(const std::string& u_x, const std::string& u_y, const std::string& more = "") {
  std::string supports;
  for (const std::string face : {"left", "right", "bottom", "top"}) {
    for (const std::string component : {"x", "y"})
      supports += "{face='" + face + "', component='" + component + "', u='" + (component == "x" ? u_x : u_y) + "'" +
                  more + "}, ";
  }
  return {"support=[" + supports + "]",
          "traction=[]",
          "probe=[]",
          "material.rubber.law=linear-elastic",
          "exact.u=['" + u_x + "', '" + u_y + "']",
          "solve.method=newton",
          "damping={}",
          "body.placement=gauss"};
}
double error_of_block(std::vector<std::string> overrides, const std::string& more = "grid.basis=linear") {
  overrides.push_back(more);
  return run(scenes::load("block", overrides)).error->u_rel_l2;
}

}  // namespace

TEST_CASE("a body whose border is displaced linearly in the position strains uniformly, to rounding") {
  const auto linear = held_all_round("1e-3*(2*x - y)", "1e-3*(0.5 + x + 3*y)");
  CHECK(error_of_block(linear) < 1e-12);
  CHECK(error_of_block(linear, "body.state=plane-stress") < 1e-12);
}

TEST_CASE("springs hold a border to displacements that vary, as closely as they are stiff, on any basis") {
  for (const std::string basis : {"linear", "quadratic", "cubic"}) {
    CAPTURE(basis);
    const auto held = [&](const std::string& stiffness) {
      return error_of_block(held_all_round("1e-3*(2*x - y)", "1e-3*(0.5 + x + 3*y)", ", stiffness=" + stiffness),
                            "grid.basis=" + basis);
    };
    const double soft = held("1e4"), stiff = held("1e6");
    CHECK(soft < 1e-3);  // E/L over the stiffness is 1e-4
    CHECK(stiff < soft / 90);
  }
}

TEST_CASE("a manufactured solution with displacements prescribed all round converges with the order of the basis") {
  // u = ∇(e^x cos y) has neither divergence nor rotation: in equilibrium without a load, whatever ν
  const auto harmonic = held_all_round("1e-4*exp(x)*cos(y)", "-1e-4*exp(x)*sin(y)");
  const auto [basis, points, order, margin] = GENERATE(table<std::string, int, double, double>(
      {{"linear", 4, 2, 0.1}, {"quadratic", 9, 3, 0.2}, {"cubic", 16, 4, 0.3}}));
  CAPTURE(basis);
  const auto error = [&](int cells) {
    auto overrides = harmonic;
    overrides.insert(overrides.end(), {fmt::format("grid.cells=[{0}, {0}]", cells), "body.placement=gauss",
                                       fmt::format("body.points_per_cell={}", points)});
    return error_of_block(overrides, "grid.basis=" + basis);
  };
  CHECK(std::log2(error(8) / error(16)) == Approx(order).margin(margin));
}

TEST_CASE("a displacement that is linear along the faces all round is met to rounding by splines") {
  const std::string basis = GENERATE("quadratic", "cubic");
  CHECK(error_of_block(held_all_round("1e-3*(2*x - y)", "1e-3*(0.5 + x + 3*y)"), "grid.basis=" + basis) < 1e-9);
}

TEST_CASE("a displacement that varies along a face follows t, too") {
  auto overrides = held_all_round("1e-3*x*t", "1e-3*y*min(t, 0.5)");
  overrides.insert(overrides.end(), {"stop.time=2"});
  CHECK(error_of_block(overrides) < 1e-12);
}

TEST_CASE("a support at a position takes its displacement from there") {
  CHECK(run(scenes::bar({"support=[{at=0.0}, {at=10.0, u='0.1*x^2/100'}]", "force=[]", "exact.u=0.01*x",
                         "exact.stress=0.01", "stop.residual=1e-9"}))
            .error->u_rel_max < 1e-7);
}

TEST_CASE("springs pull their material to the displacement of where it was, in many phases as in one") {
  const auto foot = [](const std::string& phase) {
    const Summary s = run(scenes::load(
        "block",
        {"support=[{face='left', kind='roller'}, {face='bottom', component='x', u='0.2*x*min(t/40, 1)', "
         "stiffness=1e2}, {face='bottom', component='y', stiffness=1e2}]",
         "traction=[]", "grid={min=[0, 0], max=[2, 1.5], cells=[16, 12]}", "body.min=[0, 0]", "body.max=[1, 1]",
         "probe=[{name='middle', at=[0.5, 0], fields=['u.x']}]", "stop={residual=0, time=80}", phase}));
    CHECK(s.exit_status == 0);
    return std::pair(scenes::probe(s, "middle", "u.x"), s.phases);
  };
  const auto [in_one, one] = foot("phase={}");
  const auto [in_many, many] = foot("phase.max_motion=0.1");
  CHECK(one == 1);
  CHECK(many > 10);
  CHECK(in_one == Approx(0.1).epsilon(0.01));  // the springs give way
  CHECK(in_many == Approx(in_one).epsilon(2e-3));
}

TEST_CASE("a displacement that varies along a face is refused where unknowns are no values, or leave the face") {
  const auto refused = [](const std::string& support, const std::vector<std::string>& more) {
    std::vector<std::string> overrides = {"support=[{face='bottom', u='1e-3*x'" + support + "}]", "traction=[]"};
    overrides.insert(overrides.end(), more.begin(), more.end());
    return scenes::refusal("block", overrides);
  };
  using Catch::Contains;
  CHECK(refused("", {}).empty());
  CHECK(refused("", {"grid.basis=quadratic"}).empty());
  CHECK_THAT(refused("", {"grid.basis=hermite"}), Contains("support[0].u") && Contains("slopes"));
  CHECK(refused(", stiffness=1e3", {"grid.basis=hermite"}).empty());
  CHECK_THAT(refused("", {"phase.max_motion=0.1"}), Contains("support[0].u") && Contains("leaves its face"));
  CHECK_THAT(refused(", kind='u'", {}), Contains("kind"));
  try {
    run(scenes::load("block", {"support=[{face='bottom', u='1e-3*sqrt(0.5-x)'}]"}));
    FAIL("expected an error");
  } catch (const SceneError& error) {
    CHECK_THAT(error.what(), Contains("not a number at (0.75, 0)"));
  }
}

TEST_CASE("a support that moves at constant speed from the start carries the body along without stress") {
  // u = 0.3 t is an exact solution: no acceleration, no strain. Initial velocity 0.3 everywhere.
  for (const char* mass : {"consistent", "lumped"}) {
    const Summary s = pulled_bar(
        "0.3*t", {"damping.strategy=none", "initial.v=0.3", "stop.time=10", std::string("mass.kind=") + mass});
    CAPTURE(mass);
    CHECK(s.error->u_rel_max < 1e-9);
    CHECK(std::abs(scenes::probe(s, "p12", "stress")) < 1e-9);
  }
}

TEST_CASE("a support that accelerates with the whole body under its inertia force leaves it unstrained") {
  // u = t²/2 with b = 1 [m/s²]: exact only if the support's inertia M_fs a_s is in the equation.
  const Summary s = pulled_bar("0.5*t^2", {"damping.strategy=none", "body_force.value=1", "stop.time=10",
                                           "integrator.method=erk:fehlberg-13-7-8", "integrator.rtol=1e-10"});
  CHECK(s.error->u_rel_max < 1e-7);  // limited by the numerical second derivative of the motion
}

TEST_CASE("a bar held at one end and pushed in at the other relaxes to uniform compression") {
  const Summary s = run(scenes::bar({"support=[{at=0.0, u='t<5 ? 0.25*(1-cos(pi*t/5)) : 0.5'}, {at=10.0}]", "force=[]",
                                     "stop.residual=1e-9", "exact.u=0.5*(1-x/10)", "exact.stress=-0.05",
                                     "damping.strategy=viscous", "damping.c=critical", "output.every=10"}));
  CHECK(s.status == RunStatus::equilibrium);
  CHECK(s.error->u_rel_max < 1e-7);
  CHECK(*s.error->stress_rel_l2 < 1e-7);
}

TEST_CASE("a support that sets out long after the body has come to rest takes it along by every strategy") {
  for (const char* motion : {"0.01*(1 + min(max(0, t - 600)/50, 1))", "0.01*(1 + (t >= 900))", "0.01*(1 + tanh(t/300))",
                             "0.01*(1 + min(max(0, t - 300)/500, 1))"}) {
    for (const char* strategy : {"auto", "viscous", "adaptive", "one-sided"}) {
      for (const char* residual : {"0", "1e-7"}) {
        CAPTURE(motion, strategy, residual);
        const Summary s =
            run(scenes::bar({std::string("support=[{at=0.0}, {at=10.0, u='") + motion + "'}]", "force=[]", "exact={}",
                             "grid.basis=linear", "grid.cells=8", "mass.kind=lumped",
                             std::string("damping={strategy='") + strategy + "'}",
                             std::string("stop.residual=") + residual, "stop.time=4000", "stop.steps=1000000"}));
        CAPTURE(s.reason);
        CHECK(s.exit_status == 0);
        CHECK(scenes::probe(s, "p12", "u") == Approx(0.02 * 11.5 / 24).epsilon(1e-4));
      }
    }
  }
}

TEST_CASE("a moving support gives the same answer in any units of time") {
  // The same bar in seconds and in microseconds: rho is scaled by 1e-12, times by 1e-6.
  for (const char* basis : {"hermite", "linear"}) {
    const auto u_and_stress = [&](const std::string& rho, const std::string& unit) {
      const Summary s = run(
          scenes::bar({std::string("grid.basis=") + basis, "material.bar.rho=" + rho, "constants.unit=" + unit,
                       "force=[]", "support=[{at=0.0, u='0.01*(1-cos(0.5*t/unit))'}]", "damping.strategy=none",
                       "integrator.method=erk:rk4", "stop.residual=0", "stop.time=20*unit", "output.every=20*unit"}));
      return std::pair{scenes::probe(s, "p12", "u"), scenes::probe(s, "p12", "stress")};
    };
    const auto [u, stress] = u_and_stress("1.0", "1.0");
    const auto [u_micro, stress_micro] = u_and_stress("1e-12", "1e-6");
    CAPTURE(basis);
    CHECK(u_micro == Approx(u).epsilon(1e-6));
    CHECK(stress_micro == Approx(stress).epsilon(1e-6));
  }
}

TEST_CASE("a support that stops at a kink lands on a time step without a blow") {
  // The ramp ends at t = 5, where a row and so a step lands; the kinetic energy after it is that of a run at a tenth of
  // the step.
  const auto energy_after = [](const std::string& fraction) {
    return run(scenes::bar({"force=[]", "support=[{at=0.0, u='0.01*min(t,5)'}]", "damping.strategy=viscous",
                            "damping.c=0.1", "stop.residual=0", "stop.time=6", "output.every=0.5",
                            "integrator.step_fraction=" + fraction}))
        .kinetic_energy;
  };
  CHECK(energy_after("0.9") == Approx(energy_after("0.09")).epsilon(0.25));
}

TEST_CASE("a motion that has no value before t = 0 can be prescribed") {
  const Summary s =
      run(scenes::bar({"force=[]", "support=[{at=0.0, u='0.01*t^1.5'}]", "stop.residual=0", "stop.time=5"}));
  CHECK(s.status == RunStatus::end_time);
}

TEST_CASE("ground that remembers answers a displacement that is there at the start, as an elastic body does") {
  // A block held in a box whose lid has come down by 0.1 %: σ_yy = (λ + 2 μ) ε
  const std::string soils[] = {"law = 'linear-elastic'", "law = 'drucker-prager'\nphi = 30\nc = 1e7",
                               "law = 'mohr-coulomb'\nphi = 30\nc = 1e7"};
  const double modulus = 12e6 * 0.7 / (1.3 * 0.4);
  for (const std::string& soil : soils) {
    for (const std::string way : {"solve.method=newton", "damping.strategy=viscous"}) {
      for (const std::string dilatation : {"phase.dilatation=points", "phase.dilatation=cells"}) {
        CAPTURE(soil, way, dilatation);
        const test::TemporaryFolder folder;
        const auto file =
            folder.write("lid.toml", "dim = 2\n[grid]\nmin = [0, 0]\nmax = [1, 1]\ncells = [4, 4]\n" +
                                         ("[body]\nmaterial = 'soil'\n[material.soil]\nE = 12e6\nnu = 0.3\n"
                                          "rho = 2000\n" +
                                          soil) +
                                         "\n[[support]]\nface = 'bottom'\n[[support]]\nface = 'left'\n"
                                         "kind = 'roller'\n[[support]]\nface = 'right'\nkind = 'roller'\n"
                                         "[[support]]\nface = 'top'\nkind = 'roller'\nu = -1e-3\n"
                                         "[[probe]]\nname = 'middle'\nat = [0.5, 0.5]\n"
                                         "fields = ['stress.yy']\n");
        const Summary s = run(load_scene(file, {way, dilatation, "phase.max_motion=none"}));
        CHECK(s.status == RunStatus::equilibrium);
        CHECK(scenes::probe(s, "middle", "stress.yy") == Approx(-1e-3 * modulus).epsilon(2e-3));  // finite strain
      }
    }
  }
}
