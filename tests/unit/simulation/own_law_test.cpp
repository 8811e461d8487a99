#include <stillpoint/linear_elastic.hpp>
#include <stillpoint/neo_hookean.hpp>
#include <stillpoint/own_law.hpp>
#include <stillpoint/scene_error.hpp>
#include <stillpoint/simulation.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "files.hpp"
#include "largest.hpp"
#include "plan/catalogue.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;

namespace {

template <StressState S>
struct Again : NeoHookean<S> {
  explicit Again(const LawParameters& of) : NeoHookean<S>(LameParameters::from(of.at("E"), of.at("nu"))) {}
};

// Whose stress is no number once it is strained.
template <StressState S>
struct Torn : Again<S> {
  using Again<S>::Again;
  Gradient<S> first_piola(const Gradient<S>& H) const {
    Gradient<S> P = Again<S>::first_piola(H);
    if (H[0] != 0) P[0] = std::numeric_limits<double>::quiet_NaN();
    return P;
  }
};

OwnLaw named(const std::string& name) {
  return {.name = name,
          .equation = "as neo-hookean",
          .parameters = {{.name = "E", .unit = "Pa"}, {.name = "nu", .lower = -0.2, .upper = 0.5, .fallback = 0}}};
}

void add_again() {
  using enum StressState;
  add_law<Again, uniaxial_stress, uniaxial_strain, plane_strain, plane_stress, axisymmetric, space>(named("again"));
}

std::vector<double> fields_after(int steps, const std::string& scene, std::vector<std::string> overrides) {
  overrides.insert(overrides.end(), {"stop.distance=0"});
  Simulation simulation(load_scene(STILLPOINT_PROBLEMS "/" + scene, overrides), {.threads = 1, .stops = false});
  for (int k = 0; k < steps; ++k) simulation.step();
  std::vector<double> found;
  for (const char* field : {"position", "u", "stress"}) {
    const ConstVec values = simulation.field(field);
    found.insert(found.end(), values.begin(), values.end());
  }
  return found;
}

// The largest difference of the same run with the two laws, as a share of the largest entry.
double difference(int steps, const std::string& scene, const std::string& law_key,
                  const std::vector<std::string>& overrides) {
  const auto with = [&](const char* law) {
    std::vector<std::string> all = overrides;
    all.push_back(law_key + "=" + law);
    return fields_after(steps, scene, all);
  };
  const std::vector<double> built_in = with("neo-hookean"), own = with("again");
  REQUIRE(own.size() == built_in.size());
  Largest size, apart;
  for (std::size_t k = 0; k < own.size(); ++k) {
    size.take_magnitude(built_in[k]);
    apart.take_magnitude(own[k] - built_in[k]);
  }
  REQUIRE(size.value() > 0);
  return apart.value() / size.value();
}

}  // namespace

TEST_CASE(
    "a law that a program adds moves points as the built-in one of the same formula does, in every stress state") {
  add_again();
  constexpr double rounding = 1e-11;  // after these steps
  for (const char* state : {"plane-strain", "plane-stress", "axisymmetric"}) {
    INFO(state);
    CHECK(difference(60, "block.toml", "material.rubber.law", {std::string("body.state=") + state}) < rounding);
  }
  for (const char* state : {"uniaxial-stress", "uniaxial-strain"}) {
    INFO(state);
    CHECK(difference(60, "neo_hookean_bar.toml", "material.rubber.law", {std::string("body.state=") + state}) <
          rounding);
  }
  CHECK(difference(20, "square_load.toml", "material.ground.law", {"mass.kind=lumped"}) < rounding);
}

TEST_CASE("a law that a program adds takes up the deformation from phase to phase as the built-in one does") {
  add_again();
  CHECK(difference(60, "block.toml", "material.rubber.law", {"phase.max_motion=0.02", "phase.transfer=flip"}) < 1e-10);
}

TEST_CASE("Newton's method converges quadratically with the moduli of a law that a program adds") {
  add_again();
  Simulation simulation(load_scene(STILLPOINT_PROBLEMS "/block.toml",
                                   {"material.rubber.law=again", "solve.method=newton", "stop.residual=1e-12"}),
                        {.threads = 1});
  CHECK(simulation.run() == RunStatus::equilibrium);
  CHECK(simulation.summary().residual <= 1e-12);
  CHECK(simulation.evaluations() <= 12);  // a first-order iteration takes some thirty
}

TEST_CASE("a law that a program adds is listed, and its parameters are read and refused as those of any other") {
  add_again();
  const LawInfo* const row = catalogue().law("again");
  REQUIRE(row);
  CHECK(row->equation == "as neo-hookean");
  CHECK(row->parameters.size() == 3);  // rho beside its own
  const auto refusal = [](const std::vector<std::string>& overrides) -> std::string {
    try {
      load_scene(STILLPOINT_PROBLEMS "/block.toml", overrides);
    } catch (const SceneError& error) {
      return error.what();
    }
    return "accepted";
  };
  const std::string law = "material.rubber.law=again";
  CHECK(refusal({law}) == "accepted");
  CHECK(refusal({law, "material.rubber.nu=0.7"}).find("nu") != std::string::npos);
  CHECK(refusal({law, "material.rubber.mu=1"}).find("unknown key 'mu'") != std::string::npos);
  CHECK(refusal({"material.rubber.law=agian"}).find("did you mean 'again'?") != std::string::npos);
  add_law<Again, StressState::space>(named("only-in-space"));
  CHECK(refusal({"material.rubber.law=only-in-space"}).find("plane-strain") != std::string::npos);
}

TEST_CASE("names of laws are words, not those of this library, and those of parameters differ") {
  const auto add = [](const OwnLaw& law) { add_law<Again, StressState::plane_strain>(law); };
  CHECK_THROWS_AS(add(named("neo-hookean")), std::invalid_argument);
  CHECK_THROWS_AS(add(named("Again")), std::invalid_argument);
  OwnLaw twice = named("twice");
  twice.parameters.push_back({.name = "rho"});
  CHECK_THROWS_AS(add(twice), std::invalid_argument);
  CHECK(catalogue().law("twice") == nullptr);
  CHECK_THROWS_AS(add_law(named("nowhere"), {}), std::invalid_argument);
  CHECK_NOTHROW(add(named("once-more")));
  CHECK_NOTHROW(add(named("once-more")));
}

TEST_CASE("a law that a program adds whose stress is no number ends a run with its reason") {
  add_law<Torn, StressState::plane_strain>(named("torn"));
  Simulation simulation(load_scene(STILLPOINT_PROBLEMS "/block.toml", {"material.rubber.law=torn"}), {.threads = 1});
  const RunStatus status = simulation.run();
  CHECK((status == RunStatus::diverged || status == RunStatus::failed));
  CHECK_FALSE(simulation.reason().empty());
}

TEST_CASE("an exact solution does not go with a law that a program adds without E and nu") {
  OwnLaw law = named("of-one-modulus");
  law.parameters[0].name = "mu";
  law.parameters[1].name = "k";
  add_law(law, {{StressState::space, [](const LawParameters&) { return std::unique_ptr<LawAnswers>(); }}});
  std::string scene = test::contents(STILLPOINT_PROBLEMS "/torsion.toml");
  const std::size_t begin = scene.find("[material.steel]"), end = scene.find("[[support]]");
  REQUIRE(end > begin);
  scene.replace(begin, end - begin, "[material.steel]\nlaw = \"of-one-modulus\"\nmu = 1.0\nrho = 1.0\n\n");
  const test::TemporaryFolder folder;
  try {
    load_scene(folder.write("torsion.toml", scene).string(), {"mass.kind=lumped"});
    FAIL("accepted");
  } catch (const SceneError& error) {
    INFO(error.what());
    CHECK(std::string(error.what()).find("the law 'of-one-modulus' has no E") != std::string::npos);
  }
}
