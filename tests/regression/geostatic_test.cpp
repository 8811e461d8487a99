// The stress under a level surface: problems/level_ground.toml.
#include <stillpoint/state_norms.hpp>

#include "driven.hpp"
#include "largest.hpp"
#include "scenes.hpp"
#include "statics.hpp"

using namespace stillpoint;
using Catch::Matchers::WithinRel;

namespace {

constexpr double ground_weight = 1800 * 9.81, ground_depth = 1;  // ρ g [N/m³], H [m]

Scene ground(const std::vector<std::string>& overrides = {}) { return scenes::load("level_ground", overrides); }

}  // namespace

TEST_CASE("level ground whose cells are full is in balance at the start to rounding, and stays as it is") {
  for (const std::string base : {"fixed", "roller"}) {
    for (const std::string points : {"4", "9"}) {
      CAPTURE(base, points);
      driven::Motion motion(ground({"support[0].kind=" + base, "body.points_per_cell=" + points}));
      CHECK(StateNorms(motion.relaxation()).residual(0, motion.u()) < 1e-12);
      motion.run_to(1);
      CHECK(StateNorms(motion.relaxation()).residual(1, motion.u()) < 1e-12);
      CHECK(largest_magnitude(motion.u()) < 1e-12 * ground_depth);
    }
  }
}

TEST_CASE(
    "ground in layers bears the weight of those above, each with its own density, and is in balance at the start") {
  driven::Motion motion(
      ground({"body=[{max=[1, 0.5], material='sand', state='plane-strain', points_per_cell=4}, "
              "{min=[0, 0.5], max=[1, 1], material='peat', state='plane-strain', points_per_cell=4}]",
              "material.peat={law='drucker-prager', E=2e6, nu=0.3, rho=600, phi=35}"}));
  CHECK(StateNorms(motion.relaxation()).residual(0, motion.u()) < 1e-5);  // the way over the border is 1e-6 of a cell
  motion.run_to(1);
  CHECK(StateNorms(motion.relaxation()).residual(1, motion.u()) < 1e-5);
  CHECK(largest_magnitude(motion.u()) < 1e-7 * ground_depth);
}

TEST_CASE("level ground thrusts K0 rho g H^2/2 against a smooth wall, less what a fixed base holds") {
  // The nodes' shares add up to Σ V_p σ_xx/Δx, exact for a linear stress. The base's node holds, of that,
  //   h/2 [3/4 σ(h/4) + 1/4 σ(3h/4)] = K0 ρ g h/2 (H − 3h/8)   with the points at h/4 and 3h/4.
  constexpr double K0 = 0.3 / 0.7, H = ground_depth, h = 0.125;  // the cells' height
  const double thrust = K0 * ground_weight * H * H / 2, at_base = K0 * ground_weight * h / 2 * (H - 3 * h / 8);
  for (const std::string base : {"fixed", "roller"}) {
    CAPTURE(base);
    driven::Motion motion(ground({"support[0].kind=" + base}));
    motion.run_to(0.1);
    for (std::size_t wall = 0; wall < 2; ++wall)
      CHECK_THAT(motion.wall(wall).normal, WithinRel(thrust - (base == "fixed" ? at_base : 0), 1e-12));
  }
}

TEST_CASE("level ground stands through its phases: in a whole run nothing moves and no phase ends") {
  const Summary s = run(ground());
  CHECK(s.exit_status == 0);
  CHECK(s.phases == 1);
  CHECK(s.residual < 1e-12);
  CHECK(std::abs(scenes::probe(s, "surface", "u.y")) < 1e-12 * ground_depth);
  CHECK(std::abs(scenes::probe(s, "surface", "stress.yy")) <
        1e-9 * ground_weight * ground_depth);  // at the surface there is none
}

TEST_CASE("a stress to begin with that the ground cannot bear is told, and one that it can is not") {
  const auto tells = [](const std::vector<std::string>& overrides) {
    const auto phase = make_phase(ground(overrides));
    const std::vector<std::string> notes = phase->diagnosis().notes_of_laws();
    return !notes.empty() && notes[0].find("the initial stress lies outside the strength of material.sand") == 0;
  };
  for (const std::string law : {"{law='drucker-prager', E=2e6, nu=0.3, rho=1800, phi=35, cone='plane-strain'}",
                                "{law='mohr-coulomb', E=2e6, nu=0.3, rho=1800, phi=35}"}) {
    CAPTURE(law);
    const auto with_K0 = [&](const char* K0) {
      return tells({"material.sand=" + law, std::string("initial.geostatic.K0=") + K0});
    };
    CHECK(with_K0("0.1"));  // Rankine's active pressure is 0.27, his passive one 3.69
    CHECK_FALSE(with_K0("0.5"));
    CHECK_FALSE(with_K0("1"));
    CHECK(with_K0("12"));
  }
}

TEST_CASE("ground that is at rest from the beginning is found there by every static solver") {
  for (const char* method : {"newton", "newton-cg", "cg", "lbfgs"}) {
    for (const char* law : {"drucker-prager", "mohr-coulomb"}) {
      CAPTURE(method, law);
      const Summary s = run(ground({std::string("solve.method=") + method, std::string("material.sand.law=") + law,
                                    "material.sand.c=1e4", "stop.residual=1e-6", "wall=[]",
                                    "support=[{face='bottom'}, {face='left', kind='roller'}, {face='right', "
                                    "kind='roller'}]"}));
      CAPTURE(s.reason);
      CHECK(s.status == RunStatus::equilibrium);
    }
  }
}
