// What probes read at places and over parts of the body, against exact values.
#include "output/probes.hpp"

#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "free_block.hpp"
#include "scenes.hpp"

using namespace stillpoint;
using scenes::probe;
using stillpoint::test::free_block;

namespace {

std::string refusal(const Scene& scene) {
  try {
    Simulation simulation(scene, {});
  } catch (const SceneError& error) {
    return error.what();
  }
  return "none";
}

/// A block that flies off with (1, 0.5) m/s, [0.55, 1.5] × [0.8, 1.75] in a grid of cells of 0.25 m.
Summary fly(const std::string& basis, const std::string& probes, const std::string& more = "stop.time=1.2") {
  return run(free_block({"grid={min=[0, 0], max=[4, 4], cells=[16, 16], basis='" + basis + "'}",
                         "body={min=[0.55, 0.8], max=[1.5, 1.75]}", "initial.v=[1, 0.5]", "phase.max_motion=0.1",
                         "probe=" + probes, "stop.time=1.2", more}),
             {.threads = 1});
}

}  // namespace

TEST_CASE("a probe at the face of a block that flies through the grid goes with it, to rounding") {
  for (const char* basis : {"linear", "quadratic", "cubic"}) {
    CAPTURE(basis);
    const Summary s = fly(basis,
                          "[{name='in', at=[0.9, 1.3], fields=['u.x', 'u.y', 'v.x', 'stress.xx', 'strain.xy']}, "
                          "{name='low', at=[0.55, 0.8], fields=['u.x', 'u.y', 'v.x', 'stress.xx']}, "
                          "{name='high', at=[1.5, 1.75], fields=['u.x', 'u.y', 'v.x', 'stress.xx']}]");
    CHECK(s.phases >= 20);
    for (const char* name : {"in", "low", "high"}) {
      CAPTURE(name);
      CHECK(probe(s, name, "u.x") == Approx(1.2).epsilon(1e-9));
      CHECK(probe(s, name, "u.y") == Approx(0.6).epsilon(1e-9));
      CHECK(probe(s, name, "v.x") == Approx(1).epsilon(1e-9));
      CHECK(std::abs(probe(s, name, "stress.xx")) < 1e-9 * 1e4);  // of the modulus
    }
    CHECK(std::abs(probe(s, "in", "strain.xy")) < 1e-9);
    CHECK(s.probe_positions.at("high") == std::vector<double>{1.5, 1.75});
  }
}

TEST_CASE("a probe in space reads what passes there, and nan before and after") {
  const std::string gate = "[{name='gate', at=[1.8, 1.6], frame='space', fields=['v.x', 'v.y']}]";
  const auto at = [&](const char* time) { return fly("linear", gate, std::string("stop.time=") + time); };
  CHECK(std::isnan(probe(at("0.01"), "gate", "v.x")));  // the block is 0.3 m away
  const Summary inside = at("0.6");
  CHECK(probe(inside, "gate", "v.x") == Approx(1).epsilon(1e-9));
  CHECK(probe(inside, "gate", "v.y") == Approx(0.5).epsilon(1e-9));
  CHECK(std::isnan(probe(at("2"), "gate", "v.x")));  // it is 0.75 m past
}

TEST_CASE("a probe in space reads the material that is there, not what was there when the phase began") {
  // A block that stretches by v = 0.5 x or so, in its first phase. With v = v_1 + s (X − 1) beside the node at 1 the
  // material at x = 1 is that from X = 1 − t v.
  const Summary s = run(free_block({"grid={min=[0, 0], max=[4, 4], cells=[16, 16], basis='linear'}",
                                    "body={min=[0.5, 0.5], max=[1.5, 1.5]}", "initial.v=['0.5*x', 0]",
                                    "material.stuff.E=1e-6", "phase.max_motion=0.5", "stop.time=0.1",
                                    "probe=[{name='gate', at=[1, 1], frame='space', fields=['v.x']}, {name='node', "
                                    "at=[1, 1], fields=['v.x']}, {name='before', at=[0.75, 1], fields=['v.x']}]"}),
                        {.threads = 1});
  REQUIRE(s.phases == 1);
  const double v_1 = probe(s, "node", "v.x"), slope = (v_1 - probe(s, "before", "v.x")) / 0.25;
  CHECK(v_1 == Approx(0.5).epsilon(1e-6));
  CHECK(probe(s, "gate", "v.x") == Approx(v_1 / (1 + 0.1 * slope)).epsilon(1e-9));
}

TEST_CASE("a place that all material leaves behind is nan from then on, and a note says since when") {
  const auto part = [](const char* time) {
    return run(free_block({"grid={min=[0, 0], max=[4, 2], cells=[16, 8], basis='linear'}",
                           "body={min=[1.5, 0.5], max=[2.5, 1.5]}", "initial.v=['(x < 2 ? -1 : 1)', 0]",
                           "material.stuff.E=1e-6", "probe=[{name='mid', at=[2, 1], fields=['u.x', 'stress.xx']}]",
                           std::string("stop.time=") + time}),
               {.threads = 1});
  };
  const Summary whole = part("0.1"), parted = part("1");
  CHECK(std::abs(probe(whole, "mid", "u.x")) < 1e-9);
  CHECK(std::isnan(probe(parted, "mid", "u.x")));
  CHECK(std::isnan(probe(parted, "mid", "stress.xx")));
  const auto of_probe = Catch::Contains("probe mid: no material reaches its place (");
  CHECK_THAT(fmt::format("{}", fmt::join(parted.notes, "; ")), of_probe);
  CHECK_THAT(fmt::format("{}", fmt::join(whole.notes, "; ")), !of_probe);
}

TEST_CASE("stress at a place is exact where it is linear, at faces and inside, whatever the bodies' points") {
  for (const char* points : {"4", "9"}) {
    const auto at = [&](double y) {
      const Scene scene =
          scenes::load("column", {"grid.basis=quadratic", fmt::format("body.points_per_cell={}", points),
                                  "body.placement=gauss", "stop.residual=1e-12", "solve.method=newton",
                                  fmt::format("probe=[{{name='p', at=[0.0, {}], fields=['stress.yy']}}]", y)});
      const Summary s = run(scene, {.threads = 1});
      const double weight = 9.81 * scene.materials.begin()->second.parameters.at("rho"), H = scene.grid.max[1];
      return probe(s, "p", "stress.yy") / (weight * H) + (1 - y / H);
    };
    for (const double y : {0.0, 3.3, 5.0, 10.0}) {
      CAPTURE(points, y);
      CHECK(std::abs(at(y)) < 1e-8);
    }
  }
}

TEST_CASE("a probe at a material point's position reads its displacement, and its stress to the order of the method") {
  const Summary points =
      run(scenes::load("mms_bar", {"probe=[{name='p', point=21, fields=['u', 'strain', 'stress']}]"}));
  const double x = points.probe_positions.at("p")[0];
  const Summary place = run(
      scenes::load("mms_bar", {fmt::format("probe=[{{name='p', at={:.17g}, fields=['u', 'strain', 'stress']}}]", x)}));
  for (const char* field : {"u", "strain"})
    CHECK(probe(place, "p", field) == Approx(probe(points, "p", field)).epsilon(1e-12));
  CHECK(probe(place, "p", "stress") == Approx(probe(points, "p", "stress")).epsilon(1e-4));  // h³ = 2.4e-4
}

TEST_CASE("the mean over a box of points and sums over the body are exact") {
  const Summary s =
      fly("quadratic",
          "[{name='half', kind='mean', min=[0, 0], max=[1.025, 4], fields=['u.x', 'v.y', 'stress.xx']}, "
          "{name='all', kind='body', fields=['volume', 'momentum.x', 'momentum.y', 'angular_momentum']}]");
  CHECK(probe(s, "half", "u.x") == Approx(1.2).epsilon(1e-9));
  CHECK(probe(s, "half", "v.y") == Approx(0.5).epsilon(1e-9));
  CHECK(s.probe_positions.empty());
  const double V = 0.95 * 0.95, m = 1000 * V;
  CHECK(probe(s, "all", "volume") == Approx(V).epsilon(1e-9));
  CHECK(probe(s, "all", "momentum.x") == Approx(m).epsilon(1e-9));
  CHECK(probe(s, "all", "momentum.y") == Approx(m / 2).epsilon(1e-9));
  // The centre, (1.025, 1.275) + 1.2 (1, 0.5), by m (1, 0.5)
  CHECK(probe(s, "all", "angular_momentum") == Approx(m * (2.225 * 0.5 - 1.875)).epsilon(1e-9));
}

TEST_CASE("the mean of a stress over points is weighted by their volumes, and the volume follows the strain") {
  // σ = −2 E (…) cos 2x: its mean over the bar is that of E u,x, E sin 2, by volumes that integrate it.
  const Summary s =
      run(scenes::load("mms_bar", {"probe=[{name='m', kind='mean', min=0.0, max=1.0, fields=['stress', 'strain']}, "
                                   "{name='b', kind='body', fields=['volume', 'momentum']}]"}));
  CHECK(probe(s, "m", "strain") == Approx(std::sin(2.0)).epsilon(1e-6));
  CHECK(probe(s, "m", "stress") == Approx(2 * std::sin(2.0)).epsilon(1e-6));
  CHECK(probe(s, "b", "volume") == Approx(1).epsilon(1e-12));
  // The bar doubles its length under uniaxial strain of 1, whatever its sides do.
  const Summary doubled = run(scenes::load("neo_hookean_bar", {"probe=[{name='b', kind='body', fields=['volume']}]"}));
  CHECK(probe(doubled, "b", "volume") == Approx(2).epsilon(1e-6));
}

TEST_CASE("on the axis of a cylinder the hoop strain at a place is the limit of u/r") {
  const auto phase =
      make_phase(scenes::load("cylinder", {"grid.min=[0, 0]", "body.min=[0, 0]", "exact={}", "grid.basis=quadratic",
                                           "traction=[{face='right', pressure=1e-3}]",
                                           "support=[{face='left', kind='roller'}, "
                                           "{face='bottom', kind='roller'}, {face='top', kind='roller'}]"}));
  std::vector<double> u(phase->size());
  for (std::size_t k = 0; k < u.size(); ++k) u[k] = 1e-3 * std::sin(static_cast<double>(k));
  const auto places = phase->fields().read_places(0, u, std::vector<double>(u.size()));
  std::vector<double> on_axis(5), beside(5);
  places->strain(std::vector<double>{0, 0.1}, on_axis);
  places->strain(std::vector<double>{1e-7, 0.1}, beside);
  REQUIRE(std::abs(on_axis[4]) > 1e-4);
  CHECK(on_axis[4] == Approx(beside[4]).epsilon(1e-5));
}

TEST_CASE("a place or a box without material, and a field that no law remembers, are refused at their key") {
  const auto of = [](const std::string& probes) {
    return refusal(
        free_block({"grid={min=[0, 0], max=[4, 4], cells=[16, 16], basis='linear'}",
                    "body=[{min=[0, 0], max=[1, 1], material='stuff'}, {min=[3, 3], max=[4, 4], material='stuff'}]",
                    "probe=" + probes}));
  };
  CHECK_THAT(of("[{name='p', at=[2, 2], fields=['u.x']}]"), Catch::Contains("there is no material at this place"));
  CHECK(of("[{name='p', at=[1, 1], fields=['u.x']}]") == "none");
  CHECK_THAT(of("[{name='p', kind='mean', min=[1.5, 1.5], max=[2.5, 2.5], fields=['u.x']}]"),
             Catch::Contains("there is no material point in this box"));
  CHECK_THAT(of("[{name='p', at=[0.5, 0.5], fields=['u.x', 'plastic_strain']}]"),
             Catch::Contains("no law of these materials remembers 'plastic_strain'"));
}

TEST_CASE("a sum that is nothing around an axis of symmetry is refused, and one along it is not") {
  const auto with_field = [](const std::string& field) {
    return scenes::load("cylinder", {"probe=[{name='b', kind='body', fields=['" + field + "']}]"});
  };
  for (const std::string field : {"momentum.x", "angular_momentum"})
    CHECK_THROWS_WITH(with_field(field), Catch::Contains("probe[0].fields") && Catch::Contains("axis of symmetry"));
  CHECK_NOTHROW(with_field("momentum.y"));
}
