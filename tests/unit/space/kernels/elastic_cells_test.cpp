// Forces of linear elastic cells from moments of their points, against the stiffness matrix that the points assemble.

#include <Eigen/SparseCore>
#include <catch2/catch.hpp>
#include <omp.h>

#include "largest.hpp"
#include "random_values.hpp"
#include "scenes.hpp"
#include "statics.hpp"

using namespace stillpoint;

namespace {

void check_force(const std::string& scene, const std::vector<std::string>& set) {
  const auto phase = make_phase(scenes::load(scene, set));
  CAPTURE(scene, set);
  const std::vector<double> u = test::random_values(phase->size(), 1, 7);
  const SparseMatrix K = phase->tangents().matrix(Tangent::elastic, 0, u);
  const Eigen::VectorXd expected = K * Eigen::Map<const Eigen::VectorXd>(u.data(), K.cols());
  const std::vector<double> Ku(expected.begin(), expected.end()), R = statics::internal_force(*phase, u);
  CHECK(largest_difference(R, Ku) < 1e-13 * largest_magnitude(Ku));  // rounding
  std::vector<double> dR(u.size());
  phase->tangents().apply(Tangent::consistent, 0, Ku, u, dR);
  CHECK(largest_difference(dR, Ku) < 1e-13 * largest_magnitude(Ku));
}

}  // namespace

TEST_CASE("forces of linear elastic cells from moments are those of the stiffness matrix that the points assemble") {
  const std::string linear = "grid.basis=linear";
  for (const std::string dilatation : {"phase.dilatation=points", "phase.dilatation=cells"}) {
    for (const std::string points : {"1", "4", "9"}) {
      check_force("cantilever", {linear, dilatation, "material.beam={law='linear-elastic', E=1e6, nu=0.3, rho=1000}",
                                 "body.points_per_cell=" + points});
      check_force("inclusion", {linear, dilatation, "body[0].points_per_cell=" + points,
                                "body[1].points_per_cell=" + points, "material.plate.nu=0.4999"});
    }
    for (const std::string points : {"1", "8", "27"}) {
      for (const std::string placement : {"uniform", "random"}) {
        check_force("oedometer", {dilatation, "grid.cells=[5, 3, 4]", "body.points_per_cell=" + points,
                                  "body.placement=" + placement, "body.volumes=equal"});
      }
    }
    // cut cells, and functions that follow others
    check_force("ladder/kirsch", {linear, dilatation, "grid.cells=[11, 13]"});
  }
}

TEST_CASE("a cell of so many points that parts of it share their change of volume agrees with its matrix by moments") {
  check_force("cantilever",
              {"grid.basis=linear", "phase.dilatation=cells", "grid.cells=[3, 2]",
               "material.beam={law='linear-elastic', E=1e6, nu=0.3, rho=1000}", "body.points_per_cell=169"});
}

TEST_CASE("forces of linear elastic cells are the same bits for 1 and 2 threads") {
  const std::pair<std::string, std::string> scenes_and_cells[] = {{"inclusion", "grid.cells=[100, 100]"},
                                                                  {"oedometer", "grid.cells=[13, 11, 12]"}};
  for (const auto& [scene, cells] : scenes_and_cells) {
    for (const std::string dilatation : {"phase.dilatation=points", "phase.dilatation=cells"}) {
      CAPTURE(scene, dilatation);
      const auto phase = make_phase(scenes::load(scene, {"grid.basis=linear", dilatation, cells}));
      REQUIRE(phase->points() > 8192);  // fewer are left to one thread
      const std::vector<double> u = test::random_values(phase->size(), 1, 7);
      const int before = omp_get_max_threads();
      omp_set_num_threads(1);
      const std::vector<double> one = statics::internal_force(*phase, u);
      omp_set_num_threads(2);
      const std::vector<double> two = statics::internal_force(*phase, u);
      omp_set_num_threads(before);
      CHECK(largest_magnitude(one) > 0);
      CHECK(one == two);
    }
  }
}

TEST_CASE("a displacement that is not a number is refused by cells that know their points by moments") {
  const auto phase = make_phase(scenes::load("ladder/kirsch", {"grid.basis=linear", "grid.cells=[11, 13]"}));
  std::vector<double> u(phase->size(), 0.0), R(phase->size());
  const auto trial = phase->make_trial();
  REQUIRE(phase->internal_force(0, u, R, *trial));
  u[u.size() / 2] = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(phase->internal_force(0, u, R, *trial));
}
