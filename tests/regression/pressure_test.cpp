// Pressures against exact solutions: Lamé's cylinder (problems/cylinder.toml) and a block under pressure all round
// (problems/block.toml).
#include <stillpoint/hencky.hpp>
#include <stillpoint/neo_hookean.hpp>

#include <array>

#include <fmt/format.h>

#include "output/exact_error.hpp"
#include "scenes.hpp"
#include "statics.hpp"

using namespace stillpoint;
using Catch::Matchers::WithinAbs;

namespace {

double cylinder_error(std::vector<std::string> overrides, int cells) {
  overrides.push_back("grid.cells=[" + std::to_string(cells) + ", 2]");
  const Scene scene = scenes::load("cylinder", overrides);
  const auto phase = make_phase(scene);
  return exact_error(scene, *phase, 0, statics::solution(*phase))->u_rel_l2;
}

/// f with stress(f) = wanted, of an increasing function.
template <class Stress>
double stretch_at(double wanted, const Stress& stress) {
  double low = 0.3, high = 3;
  for (int k = 0; k < 80; ++k) (stress((low + high) / 2) < wanted ? low : high) = (low + high) / 2;
  return (low + high) / 2;
}

/// H of a stretch f in all directions that the law knows.
template <class Law>
Gradient<Law::state> equal_stretch(double f) {
  Gradient<Law::state> H{};
  H[0] = H[3] = f - 1;
  if constexpr (Law::state == StressState::axisymmetric) H[4] = f - 1;
  return H;
}

template <class Law>
double cauchy_at(double f) {
  return Law(LameParameters::from(1, 0.3)).cauchy(equal_stretch<Law>(f))[0];
}
template <class Law>
double piola_at(double f) {
  return Law(LameParameters::from(1, 0.3)).first_piola(equal_stretch<Law>(f))[0];
}

}  // namespace

TEST_CASE("a cylinder under inner pressure converges to Lamé's solution with order 2 and 3") {
  for (const auto& [basis, order] : {std::pair{"linear", 2.0}, {"quadratic", 3.0}}) {
    const std::vector<std::string> scene = {std::string("grid.basis=") + basis, "body.points_per_cell=9"};
    const double coarse = cylinder_error(scene, 16), fine = cylinder_error(scene, 32);
    CAPTURE(basis, coarse, fine);
    CHECK(std::log2(coarse / fine) == Approx(order).margin(0.15));
    CHECK(fine < (order == 2 ? 1e-3 : 1e-4));
  }
}

TEST_CASE("the cylinder has Lamé's radial and hoop stress in the middle of its cells, within h^2") {
  const double p = 1e-9, a = 1, b = 2, mean_stress = p * a * a / (b * b - a * a);
  const int cells = 32;
  const auto phase = make_phase(scenes::load("cylinder", {fmt::format("grid.cells=[{}, 2]", cells)}));
  const auto x = phase->fields().positions(), stress = statics::point_stress(*phase, statics::solution(*phase));
  std::vector<std::array<double, 3>> mean(cells);  // of the eight points at a cell's radius: rr, zz, θθ
  for (std::size_t k = 0; k < phase->points(); ++k) {
    for (std::size_t i = 0; i < 3; ++i)
      mean.at(static_cast<std::size_t>((x[2 * k] - a) * cells))[i] += stress[4 * k + i] / 8;
  }
  for (int c = 0; c < cells; ++c) {
    const auto [rr, zz, hoop] = mean[static_cast<std::size_t>(c)];
    const double r = a + (c + 0.5) / cells, ratio = b * b / (r * r);
    CHECK_THAT(rr, WithinAbs(mean_stress * (1 - ratio), 1e-3 * p));
    CHECK_THAT(hoop, WithinAbs(mean_stress * (1 + ratio), 1e-3 * p));
    CHECK_THAT(zz, WithinAbs(0.3 * 2 * mean_stress, 1e-3 * p));  // ν (σ_rr + σ_θθ)
  }
  const Summary relaxed = run(scenes::load("cylinder"));
  CHECK(relaxed.status == RunStatus::equilibrium);
  CHECK(relaxed.error->u_rel_l2 == Approx(cylinder_error({}, 8)).epsilon(1e-3));
}

TEST_CASE("a pressure that follows makes sigma = -p in a block at large strain, a dead load of the same size P") {
  // The dead load pulls: one that presses from all sides lets a block turn over.
  constexpr double p = 0.3;  // of E
  const auto relaxed = [](const std::string& law, const std::string& state, const std::string& load) {
    return run(
        scenes::load("block", {"material.rubber.law=" + law, "body.state=" + state, "body.placement=gauss", load}));
  };
  const std::string follows = "traction=[{face='right', pressure=0.3}, {face='top', pressure=0.3}]";
  const std::string dead = "traction=[{face='right', value=[0.3, 0]}, {face='top', value=[0, 0.3]}]";
  const auto check = [&]<class Law>(const std::string& law, const std::string& state) {
    for (const bool pressure : {true, false}) {
      if (pressure && state == "plane-stress") continue;  // the face's thickness is the undeformed one there
      CAPTURE(law, state, pressure);
      const double f = pressure ? stretch_at(-p, cauchy_at<Law>) : stretch_at(p, piola_at<Law>);
      const Summary s = relaxed(law, state, pressure ? follows : dead);
      CHECK(s.status == RunStatus::equilibrium);
      // 1e-8: 100 residuals of the scene
      CHECK_THAT(scenes::probe(s, "corner", "strain.xx"), WithinAbs(f - 1, 1e-8));
      CHECK_THAT(scenes::probe(s, "corner", "stress.xx"), WithinAbs(cauchy_at<Law>(f), 1e-8));
      CHECK_THAT(scenes::probe(s, "corner", "stress.yy"), WithinAbs(cauchy_at<Law>(f), 1e-8));
      CHECK_THAT(scenes::probe(s, "corner", "stress.xy"), WithinAbs(0, 1e-8));
    }
  };
  check.operator()<NeoHookean<StressState::plane_strain>>("neo-hookean", "plane-strain");
  check.operator()<NeoHookean<StressState::plane_stress>>("neo-hookean", "plane-stress");
  check.operator()<NeoHookean<StressState::axisymmetric>>("neo-hookean", "axisymmetric");
  check.operator()<Hencky<StressState::plane_strain>>("hencky", "plane-strain");
  check.operator()<Hencky<StressState::axisymmetric>>("hencky", "axisymmetric");
}

TEST_CASE("a pressure goes with its faces from phase to phase") {
  // The pieces of surface move with the body, so that what is left is what the points lose by changing cells.
  const Summary s = run(scenes::load(
      "block", {"phase.max_motion=0.3", "grid.basis=quadratic", "body.points_per_cell=16", "stop.residual=1e-8"}));
  const double f = stretch_at(-0.3, cauchy_at<NeoHookean<StressState::plane_strain>>);
  CAPTURE(s.reason, s.phases);
  CHECK(s.status == RunStatus::equilibrium);
  CHECK(s.phases > 2);
  CHECK_THAT(scenes::probe(s, "corner", "stress.xx"), WithinAbs(-0.3, 0.01));
  CHECK_THAT(scenes::probe(s, "corner", "u.x"), WithinAbs((f - 1) * s.probe_positions.at("corner")[0], 0.005));
}
