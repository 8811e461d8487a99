// Loads so small that 1 + strain is 1: an elastic body answers them in proportion all the same.
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "scenes.hpp"

using namespace stillpoint;
using scenes::run_text;

namespace {

// A cantilever under its weight and a pressure, of strains of about `load`.
std::string loaded_cantilever(int dim, const std::string& law, double load, const std::string& way) {
  const bool space = dim == 3;
  return fmt::format(R"(
dim = {}
[grid]
min = [{}]
max = [{}]
cells = [{}]
basis = "linear"
[body]
material = "m"
{}
points_per_cell = {}
placement = "gauss"
[material.m]
law = "{}"
E = 1000.0
nu = 0.3
rho = 1.0
[mass]
kind = "lumped"
[[support]]
face = "left"
[body_force]
value = [0.0, {:e}{}]
[[traction]]
face = "top"
pressure = {:e}
{}
[stop]
residual = 1e-8
[[probe]]
name = "c"
at = [1.6, 0.6{}]
fields = ["u.y", "stress.xx"]
)",
                     dim, space ? "0, 0, 0" : "0, 0", space ? "2, 1, 1" : "2, 1", space ? "4, 2, 2" : "4, 2",
                     space ? "" : "state = \"plane-strain\"", space ? 8 : 4, law, -50 * load, space ? ", 0" : "",
                     30 * load, way, space ? ", 0.6" : "");
}

const std::vector<std::string> tables_of_ways = {
    "[solve]\nmethod = \"newton\"",   "[solve]\nmethod = \"cg\"",          "[solve]\nmethod = \"lbfgs\"",
    "[damping]\nstrategy = \"auto\"", "[damping]\nstrategy = \"viscous\"", "[damping]\nstrategy = \"kinetic\""};

}  // namespace

TEST_CASE("a load of any smallness bends an elastic body of finite strain as Hooke's law says, by any way to it") {
  for (const char* law : {"neo-hookean", "hencky"}) {
    for (const double load : {1e-9, 1e-12, 1e-20, 1e-40}) {
      for (const std::string& way : tables_of_ways) {
        CAPTURE(law, load, way);
        const Summary exact = run_text(loaded_cantilever(2, "linear-elastic", load, way));
        const Summary s = run_text(loaded_cantilever(2, law, load, way));
        REQUIRE(s.status == RunStatus::equilibrium);
        // The residual allows 1e-8 times the body's condition; terms of second order are below it.
        for (const char* field : {"u.y", "stress.xx"})
          CHECK(scenes::probe(s, "c", field) == Approx(scenes::probe(exact, "c", field)).epsilon(1e-5).margin(0));
      }
    }
  }
}

TEST_CASE("in space as well, and where points share their change of volume") {
  for (const char* law : {"neo-hookean", "hencky"}) {
    for (const double load : {1e-12, 1e-20}) {
      for (const std::string& way : {tables_of_ways[0], tables_of_ways[3]}) {
        CAPTURE(law, load, way);
        const Summary exact = run_text(loaded_cantilever(3, "linear-elastic", load, way));
        const Summary s = run_text(loaded_cantilever(3, law, load, way));
        REQUIRE(s.status == RunStatus::equilibrium);
        CHECK(scenes::probe(s, "c", "u.y") == Approx(scenes::probe(exact, "c", "u.y")).epsilon(1e-5).margin(0));
      }
      CAPTURE(law, load);
      const std::vector<std::string> shared = {"phase.dilatation=cells"};
      const Summary exact = run_text(loaded_cantilever(2, "linear-elastic", load, tables_of_ways[3]), shared);
      const Summary s = run_text(loaded_cantilever(2, law, load, tables_of_ways[3]), shared);
      REQUIRE(s.status == RunStatus::equilibrium);
      CHECK(scenes::probe(s, "c", "u.y") == Approx(scenes::probe(exact, "c", "u.y")).epsilon(1e-5).margin(0));
    }
  }
}
