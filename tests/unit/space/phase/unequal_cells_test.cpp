// Grids of unequal cells: uniform states stay what they are, and what counts in cells counts in those that are there.
#include <stillpoint/stillpoint.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "free_block.hpp"
#include "largest.hpp"
#include "space/phase/phase_changes.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using stillpoint::test::free_block;
using stillpoint::test::TemporaryFolder;

namespace {

// A jump of the cell length, cells that grow and shrink, and one that is alone in its piece.
const std::vector<std::string> kPieces = {"[[0, 0.3, 4], [0.3, 0.8, 3, 2.5], [0.8, 1, 1]]",
                                          "[[0, 0.5, 3, 0.4], [0.5, 1, 2]]", "[[0, 0.6, 2, 3], [0.6, 1, 1]]"};

struct BasisAndPoints {
  std::string basis, points;
};

/// A cube, square or ring of 1 m under tractions of 1e-3 on its upper faces, between rollers on the lower ones.
Scene pulled(const std::string& state, const std::string& basis, const std::string& points,
             std::vector<std::string> more = {}) {
  const int dim = state == "space" ? 3 : 2;
  const auto axes = static_cast<std::size_t>(dim);
  std::string text = fmt::format("dim = {}\n[grid]\nbasis = \"{}\"\n", dim, basis);
  for (std::size_t d = 0; d < axes; ++d) text += fmt::format("{} = {}\n", "xyz"[d], kPieces[d]);
  text += fmt::format("[body]\nmaterial = \"steel\"\nplacement = \"gauss\"\nstate = \"{}\"\npoints_per_cell = {}\n",
                      state, points);
  text += "[material.steel]\nlaw = \"linear-elastic\"\nE = 1\nnu = 0.3\nrho = 1\n[mass]\nkind = \"lumped\"\n";
  for (const char* face : {"left", "bottom", "back"})
    if (dim == 3 || std::string(face) != "back")
      text += fmt::format("[[support]]\nface = \"{}\"\nkind = \"roller\"\n", face);
  text += fmt::format("[[traction]]\nface = \"right\"\nvalue = [1e-3, 0{}]\n", dim == 3 ? ", 0" : "");
  text += fmt::format("[[traction]]\nface = \"top\"\nvalue = [0, -2e-3{}]\n", dim == 3 ? ", 0" : "");
  text += "[solve]\nmethod = \"newton\"\n[stop]\nresidual = 1e-13\ndistance = 0\n[exact]\n";
  // e = (σ − ν (tr σ − σ))/E with σ = (1e-3, −2e-3, σ_zz): in plane strain σ_zz = ν (σ_xx + σ_yy), in a ring σ_θθ =
  // σ_rr.
  text += state == "space" ? "u = [\"1.6e-3*x\", \"-2.3e-3*y\", \"0.3e-3*z\"]\nstress = [1e-3, -2e-3, 0, 0, 0, 0]\n"
          : state == "axisymmetric" ? "u = [\"1.3e-3*x\", \"-2.6e-3*y\"]\nstress = [1e-3, -2e-3, 1e-3, 0]\n"
                                    : "u = [\"1.69e-3*x\", \"-2.21e-3*y\"]\nstress = [1e-3, -2e-3, -0.3e-3, 0]\n";
  const TemporaryFolder folder;
  return load_scene(folder.write("pulled.toml", text), more);
}

}  // namespace

TEST_CASE("in unequal cells a uniform stress is found to rounding: in the plane, in rings and in space") {
  const std::vector<BasisAndPoints> in_plane = {{"linear", "4"}, {"quadratic", "9"}, {"cubic", "16"}};
  const std::vector<BasisAndPoints> in_space = {{"linear", "8"}, {"quadratic", "27"}};
  for (const std::string state : {"plane-strain", "axisymmetric", "space"}) {
    for (const auto& [basis, points] : state == "space" ? in_space : in_plane) {
      CAPTURE(state, basis);
      const Summary summary = run(pulled(state, basis, points));
      REQUIRE(summary.status == RunStatus::equilibrium);
      CHECK(summary.error->u_rel_max < 1e-11);
      CHECK(*summary.error->stress_rel_l2 < 1e-11);
    }
  }
}

TEST_CASE("the motion that ends a phase is a share of the cells where the body is") {
  // Cells of 0.125 m in the left half and of 0.0625 m in the right one.
  const std::vector<std::string> grid = {"grid.x=[[0, 1.125, 9], [1.125, 2.25, 18]]", "grid.y=[[0, 1, 8]]",
                                         "initial.v=[1, 0]", "integrator.step=1e-3"};
  const auto motion = [&](const std::string& min, const std::string& max) {
    std::vector<std::string> all = grid;
    all.insert(all.end(), {"body.min=" + min, "body.max=" + max});
    Largest furthest;
    int phases = 0;
    test::advanced(free_block(all), 0.1, [&](const test::Moment& moment, bool after) {
      if (after) return;
      ++phases;
      furthest.take(largest_magnitude(moment.u));
    });
    CHECK(phases > 3);
    return furthest.value();
  };
  CHECK(motion("[0.25, 0.25]", "[0.75, 0.75]") == Approx(0.0125).margin(0.0011));
  CHECK(motion("[1.25, 0.25]", "[1.75, 0.75]") == Approx(0.00625).margin(0.0011));
}

TEST_CASE("a block that is drawn into cells of half the length, through many phases, bears its load as evenly") {
  // Its points stand for domains, which come to be half as wide again as these cells and are halved there. The block of
  // E = 1e4 is drawn out to 1.56 times its length.
  for (const std::string basis : {"linear", "quadratic"}) {
    const auto spread = [&](const std::vector<std::string>& grid) {
      std::vector<std::string> all = {"grid.basis=" + basis,
                                      "body={min=[0, 0], max=[1, 0.5], material='stuff', points_per_cell=4}",
                                      "phase.quadrature=domains",
                                      "support=[{face='left', kind='roller'}, {face='bottom', kind='roller'}]",
                                      "traction=[{face='right', value=['5e3*min(t, 1)', 0]}]",
                                      "damping={strategy='viscous', c='critical'}",
                                      "stop={residual=1e-6, time=0}"};
      all.insert(all.end(), grid.begin(), grid.end());
      Simulation simulation(free_block(all));
      REQUIRE(simulation.run() == RunStatus::equilibrium);
      CHECK(simulation.summary().phases > 10);
      const LagrangianPhase& phase = simulation.parts().phase;
      const std::vector<double> x = phase.fields().positions();
      std::vector<double> stress(4 * phase.points());
      phase.fields().point_stress(simulation.t(), simulation.u(), stress);
      double least = stress[0], most = stress[0], furthest = 0;
      for (std::size_t p = 0; p < phase.points(); ++p) {
        furthest = std::max(furthest, x[2 * p]);
        least = std::min(least, stress[4 * p]);
        most = std::max(most, stress[4 * p]);
      }
      CHECK(furthest > 1.3);
      return (most - least) / most;
    };
    const double equal = spread({"grid.max=[2.5, 1]", "grid.cells=[10, 6]"});
    const double unequal = spread({"grid.x=[[0, 1, 4], [1, 2.5, 12]]", "grid.y=[[0, 0.5, 4], [0.5, 1, 2]]"});
    CAPTURE(basis, equal);
    CHECK(unequal < equal);
  }
}

TEST_CASE("one piece of equal cells is the grid of min, max and cells: a run in phases has the same bits") {
  const std::vector<std::string> flying = {"initial.v=['1 + y', '-0.3*x']"};
  const auto end_of = [&](const std::vector<std::string>& grid) {
    std::vector<std::string> all = flying;
    all.insert(all.end(), grid.begin(), grid.end());
    Simulation simulation = test::advanced(free_block(all), 0.15);
    return simulation.parts().phase.fields().positions();
  };
  const std::vector<double> plain = end_of({}), pieces = end_of({"grid.x=[[0, 2.25, 9]]", "grid.y=[[0, 1, 4, 1]]"});
  CHECK(plain == pieces);
  CHECK(plain != end_of({"grid.x=[[0, 1, 4], [1, 2.25, 5]]", "grid.y=[[0, 1, 4, 1.01]]"}));
}
