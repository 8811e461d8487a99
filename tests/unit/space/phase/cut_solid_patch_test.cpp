// Bodies in space that cut the cells: what must hold exactly wherever their surfaces lie.
#include <array>
#include <numbers>

#include <fmt/format.h>

#include "largest.hpp"
#include "statics.hpp"
#include "temporary_folder.hpp"
#include "triangles.hpp"

using namespace stillpoint;
using stillpoint::test::TemporaryFolder;

namespace {

constexpr double pi = std::numbers::pi;

/// In a cube of 7³ cells; nothing holds or loads it.
Scene scene_of(const std::string& shape, const std::vector<std::string>& overrides = {}) {
  const TemporaryFolder folder;
  return load_scene(folder.write("solid.toml",
                                 "dim = 3\n[grid]\nmin = [0, 0, 0]\nmax = [1, 1, 1]\ncells = [7, 7, 7]\n"
                                 "[body]\nmaterial = \"stuff\"\npoints_per_cell = 8\n" +
                                     shape +
                                     "\n[material.stuff]\nlaw = \"linear-elastic\"\nE = 1\nnu = 0.3\n"
                                     "rho = 1\n"),
                    overrides);
}

const std::vector<std::string> along_x = {
    "cylinder = [[0, 0.5, 0.5], [1, 0.5, 0.5]]\nradius = 0.41",
    "cylinder = [[0, 0.5, 0.5], [1, 0.5, 0.5]]\nradius = 0.41\ninner_radius = 0.17",
    "polygon = [[0.1, 0.05], [0.9, 0.2], [0.5, 0.55], [0.7, 0.95], [0.07, 0.8]]\naxis = \"x\"",
};

}  // namespace

// σ_xx is in balance with itself between neighbouring cells if they have the same points in y and z.
TEST_CASE("a bar along x of any section, between rollers, is stretched evenly: u is linear and exact (patch test)") {
  const double strain = 1e-3, nu = 0.3;
  for (const std::string& shape : along_x) {
    for (const std::string placed : {"body.placement=uniform", "body.placement=gauss", "body.volumes=equal"}) {
      CAPTURE(shape, placed);
      Scene scene = scene_of(
          shape, {placed, fmt::format("support=[{{face='left', kind='roller'}}, {{face='right', kind='roller', u={}}}]",
                                      strain)});
      scene.initial_u = {Expression(fmt::format("{}*x", strain), {}, "xyz"),
                         Expression(fmt::format("{}*(y - 0.5)", -nu * strain), {}, "xyz"),
                         Expression(fmt::format("{}*(z - 0.5)", -nu * strain), {}, "xyz")};
      const auto phase = make_phase(scene);
      const auto u = phase->initial_displacement(0);
      const auto stress = statics::point_stress(*phase, u);
      for (std::size_t k = 0; k < stress.size(); k += 6) {
        REQUIRE(stress[k] == Approx(strain).epsilon(1e-10));
        for (std::size_t i = 1; i < 6; ++i) REQUIRE(std::abs(stress[k + i]) < 1e-12);
      }
      CHECK(largest_magnitude(statics::out_of_balance(*phase, u)) < 1e-13);
    }
  }
}

TEST_CASE("a pressure all around a body in space has no resultant and no moment, and its work is that on the volume") {
  const TemporaryFolder folder;
  auto facets = test::octahedron();
  for (Facet& facet : facets)
    for (SpacePoint& x : facet)
      for (double& coordinate : x) coordinate = 0.5 + 0.43 * coordinate;
  const double p = 2e-3;
  for (const auto& [shape, V] : std::vector<std::pair<std::string, double>>{
           {"sphere = [0.51, 0.48, 0.5]\nradius = 0.44", 4 * pi / 3 * std::pow(0.44, 3)},
           {fmt::format("stl = '{}'", folder.write("body.stl", test::binary_stl(facets)).string()),
            4.0 / 3 * std::pow(0.43, 3)}}) {
    const auto phase = make_phase(scene_of(shape, {fmt::format("traction=[{{surface='outer', pressure={}}}]", p)}));
    std::vector<double> F(phase->size());
    phase->external_force(0, std::vector<double>(phase->size(), 0.0), F);
    std::array<double, 3> sum{}, moment{};
    double work = 0;  // of u = x: −p ∫ x·n dA = −3 p V
    for (std::size_t i = 0; i < F.size(); ++i) {
      const std::vector<double> x = phase->diagnosis().of_unknown(i).position;
      const std::size_t c = i % 3, next = (c + 1) % 3, last = (c + 2) % 3;
      sum[c] += F[i];
      work += F[i] * x[c];
      moment[next] += x[last] * F[i];
      moment[last] -= x[next] * F[i];
    }
    CAPTURE(shape);
    CHECK(largest_magnitude(sum) < 1e-9 * p);
    CHECK(largest_magnitude(moment) < 1e-6 * p);
    CHECK(work == Approx(-3 * p * V).epsilon(1e-3));
  }
}
