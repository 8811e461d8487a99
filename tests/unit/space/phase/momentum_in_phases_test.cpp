// What a body keeps from phase to phase: its momentum, and its shape where it falls freely.
#include <stillpoint/stillpoint.hpp>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "free_block.hpp"
#include "scenes.hpp"
#include "simulation/parts.hpp"
#include "space/phase/lagrangian_phase.hpp"
#include "space/phase/phase_changes.hpp"

using namespace stillpoint;
using namespace stillpoint::test;

namespace {

/// Σ m_p v_p by the points' velocities, their masses from the volumes of the start.
Point<2> momentum(const Moment& moment, const std::vector<double>& volume_at_start, double rho) {
  std::vector<double> v(2 * moment.phase.points());
  moment.phase.fields().point_velocity(moment.t, moment.v, v);
  Point<2> sum{};
  for (std::size_t p = 0; p < volume_at_start.size(); ++p) {
    for (std::size_t i = 0; i < 2; ++i) sum[i] += rho * volume_at_start[p] * v[2 * p + i];
  }
  return sum;
}

}  // namespace

TEST_CASE("linear momentum goes over from each phase to the next, whatever the basis, the law and the transfer") {
  for (const std::string basis : {"linear", "quadratic", "cubic"}) {
    for (const std::string transfer :
         {"transfer='flip'", "transfer='flip', flip_share=0.9", "transfer='pic'", "transfer='apic'",
          "transfer='xpic', xpic_order=1", "transfer='xpic', xpic_order=5"}) {
      for (const bool soil : {false, true}) {
        CAPTURE(basis, transfer, soil);
        const std::vector<std::string> overrides = {"initial.v=['0.8 + 0.5*(y - 0.5)', '0.2*(x - 1)']",
                                                    "grid.basis=" + basis, "integrator.step_fraction=0.2",
                                                    "phase={max_motion=0.1, " + transfer + "}"};
        const Scene scene = soil ? free_soil(overrides) : free_block(overrides);
        const auto at_start = make_phase(scene);
        const std::vector<double> volume = at_start->fields().point_data().volumes;
        const double scale = at_start->info().total_mass;  // times 1 m/s
        Point<2> before{};
        int changes = 0;
        Simulation simulation = advanced(scene, 0.25, [&](const Moment& moment, bool after) {
          const Point<2> now = momentum(moment, volume, 1000);
          if (after) {
            ++changes;
            for (std::size_t i = 0; i < 2; ++i) CHECK(std::abs(now[i] - before[i]) < 1e-13 * scale);
          }
          before = now;
        });
        CHECK(changes >= 6);
        const TransferErrors errors = simulation.parts().phase.control().transfer_errors();
        CHECK(errors.mass < 1e-14);
        CHECK(errors.momentum < 1e-12);
        CHECK(errors.added_mass < 0.15);
        // The sum over the grid's momentum of the start: Σ m_p v_p of the field, whose mean is at the block's middle.
        CHECK(std::abs(before[0] - 0.8 * scale) < 1e-12 * scale);
        CHECK(std::abs(before[1] - 0.025 * scale) < 1e-12 * scale);
      }
    }
  }
}

TEST_CASE("a block falls freely as it should, in one phase as in many, and stays as it is") {
  const auto fall = [](const std::string& max_motion, const std::string& basis) {
    return run(free_block({"grid={min=[0, 0], max=[2, 4], cells=[8, 16], basis='" + basis + "'}",
                           "body={min=[0.55, 2.8], max=[1.5, 3.75]}", "body_force.value=[0, -9.81]", "stop.time=0.6",
                           "phase.max_motion=" + max_motion,
                           "probe=[{name='middle', at=[1, 3.25], fields=['u.y', 'stress.yy']}]"}),
               {.threads = 1});
  };
  constexpr double way = -9.81 * 0.6 * 0.6 / 2;
  CHECK(scenes::probe(fall("none", "linear"), "middle", "u.y") == Approx(way).epsilon(1e-12));
  for (const char* max_motion : {"0.1", "0"}) {
    for (const char* basis : {"linear", "quadratic", "cubic"}) {
      CAPTURE(max_motion, basis);
      const Summary s = fall(max_motion, basis);
      CHECK(s.phases >= 10);
      CHECK(*s.added_mass > 0.001);  // light nodes there are, but they fall like the rest
      CHECK(*s.momentum_error < 1e-12);
      CHECK(scenes::probe(s, "middle", "u.y") == Approx(way).epsilon(1e-9));
      CHECK(std::abs(scenes::probe(s, "middle", "stress.yy")) < 1e-9 * 1e4);
    }
  }
}

TEST_CASE("a free body keeps its momentum through 200 phases, and with apic its angular momentum") {
  for (const std::string basis : {"linear", "quadratic", "cubic"}) {
    for (const std::string transfer : {"flip", "pic", "apic", "xpic"}) {
      CAPTURE(basis, transfer);
      const Summary s =
          run(free_block({"grid={min=[-1, -1], max=[2, 1], cells=[24, 16], basis='" + basis + "'}",
                          "body={min=[-0.52, -0.31], max=[0.23, 0.44]}", "phase.transfer=" + transfer,
                          "material.stuff={law='neo-hookean', E=1e5, nu=0.3, rho=1000}",
                          "initial.v=['1 - 3*y + 0.5*exp(-2*x)', '3*x']", "stop.time=0.6", "phase.max_motion=0.025"}),
              {.threads = 1});
      REQUIRE(s.status == RunStatus::end_time);
      CHECK(s.phases >= 200);
      CHECK(*s.added_mass > 0.01);
      CHECK(*s.momentum_error < 1e-12);
      REQUIRE(s.angular_momentum_error);
      if (transfer == "apic") CHECK(*s.angular_momentum_error < (basis == "linear" ? 0.01 : 1e-10));
    }
  }
}
