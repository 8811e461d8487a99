// Tractions on a straight part of a body's border, oblique to the grid or along it.
#include <stillpoint/stillpoint.hpp>

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "largest.hpp"
#include "scenes.hpp"
#include "space/phase/lagrangian_phase.hpp"

using namespace stillpoint;
using Catch::Matchers::Contains;

namespace {

/// The free block in a grid that leaves room around it, or another body there.
std::vector<std::string> in_room(std::vector<std::string> overrides) {
  overrides.insert(overrides.begin(), {"grid={min=[-1, -1], max=[2, 2], cells=[12, 12]}", "body.min=[0, 0]",
                                       "body.max=[1, 1]", "support=[]", "probe=[]", "damping.c=1.0"});
  return overrides;
}
std::vector<std::string> triangle(std::vector<std::string> overrides) {
  overrides.insert(overrides.begin(),
                   {"grid={min=[0, 0], max=[4, 3], cells=[20, 15]}",
                    "body={polygon=[[0, 0], [4, 0], [0, 3]], material='rubber', state='plane-strain'}", "support=[]",
                    "probe=[]", "damping.c=1.0"});
  return overrides;
}

struct TractionResultant {
  double x = 0, y = 0, moment = 0;  // about the origin
};

/// Of F(0) over all functions of a free body, about the origin: Σ N_a ξ_a = x with the centres ξ_a of splines.
TractionResultant resultant(const Scene& scene) {
  const auto phase = make_phase(scene);
  std::vector<double> F(phase->size());
  phase->external_force(0, std::vector<double>(phase->size(), 0.0), F);
  TractionResultant sum;
  for (std::size_t i = 0; i < F.size(); i += 2) {
    if (F[i] == 0 && F[i + 1] == 0) continue;
    const std::vector<double> x = phase->diagnosis().of_unknown(i).position;
    sum.x += F[i];
    sum.y += F[i + 1];
    sum.moment += x[0] * F[i + 1] - x[1] * F[i];
  }
  return sum;
}

/// ∫ x^a y^b ds from (4, 0) to (0, 3), of length 5: 5 · 4^a 3^b a! b!/(a + b + 1)!
double along_hypotenuse(int a, int b) {
  return 5 * std::pow(4, a) * std::pow(3, b) * std::tgamma(a + 1) * std::tgamma(b + 1) / std::tgamma(a + b + 2);
}

}  // namespace

TEST_CASE("a traction on an oblique side of a polygon adds up to stress times area, about its middle") {
  for (const std::string basis : {"linear", "quadratic"}) {
    for (const std::string line : {"[[4, 0], [0, 3]]", "[[0, 3], [4, 0]]", "[[2, 1.5], [0.8, 2.4]]"}) {
      for (const bool pressure : {false, true}) {
        CAPTURE(basis, line, pressure);
        const std::string load = pressure ? "pressure=0.5" : "value=[0.3, -0.2]";
        const TractionResultant F = resultant(
            scenes::load("block", triangle({"grid.basis=" + basis, "body.points_per_cell=9", "body.volumes=equal",
                                            "traction=[{line=" + line + ", " + load + "}]"})));
        const bool whole = line[2] != '2';
        const double length = whole ? 5 : 1.5, middle_x = whole ? 2 : 1.4, middle_y = whole ? 1.5 : 1.95;
        // outwards is (3, 4)/5
        const double f_x = pressure ? -0.5 * 0.6 : 0.3, f_y = pressure ? -0.5 * 0.8 : -0.2;
        CHECK(F.x == Approx(length * f_x).epsilon(1e-12));
        CHECK(F.y == Approx(length * f_y).epsilon(1e-12));
        CHECK(F.moment == Approx(length * (middle_x * f_y - middle_y * f_x)).epsilon(1e-12));
      }
    }
  }
}

TEST_CASE("a traction that is a cubic of the position has its force and its moment on an oblique side") {
  // t = (x³ − 2 x y² + 3, y³ + x² y)
  const auto I = along_hypotenuse;
  const double f_x = I(3, 0) - 2 * I(1, 2) + 3 * I(0, 0), f_y = I(0, 3) + I(2, 1);
  const double moment = I(1, 3) + I(3, 1) - (I(3, 1) - 2 * I(1, 3) + 3 * I(0, 1));
  for (const std::string basis : {"linear", "quadratic", "cubic"}) {
    for (const std::string phases : {"phase={}", "phase.max_motion=0.1"}) {
      for (const std::string points : {"4", "9", "[3, 2]"}) {
        CAPTURE(basis, phases, points);
        const TractionResultant F = resultant(scenes::load(
            "block", triangle({"grid.basis=" + basis, phases, "body.points_per_cell=" + points,
                               "traction=[{line=[[4, 0], [0, 3]], value=['x^3 - 2*x*y^2 + 3', 'y^3 + x^2*y']}]"})));
        CHECK(F.x == Approx(f_x).epsilon(1e-12));
        CHECK(F.y == Approx(f_y).epsilon(1e-12));
        CHECK(F.moment == Approx(moment).epsilon(1e-12));
      }
    }
  }
}

TEST_CASE("a pressure that is a cubic of the position pushes a face with all of its force, about the right point") {
  // p = x³ − x on the top 0 < x < 1, at y = 1: −∫ p dx = 1/4, about the origin −∫ p x dx = 2/15
  for (const std::string basis : {"linear", "quadratic", "cubic"}) {
    for (const std::string phases :
         {"phase={}", "phase={max_motion=0.1, quadrature='points'}", "phase={max_motion=0.1, quadrature='domains'}"}) {
      for (const std::string points : {"4", "9", "16"}) {
        CAPTURE(basis, phases, points);
        const TractionResultant F =
            resultant(scenes::load("block", in_room({"grid.basis=" + basis, phases, "body.points_per_cell=" + points,
                                                     "traction=[{face='top', pressure='x^3 - x'}]"})));
        CHECK(std::abs(F.x) < 1e-14);
        CHECK(F.y == Approx(0.25).epsilon(1e-12));
        CHECK(F.moment == Approx(2.0 / 15).epsilon(1e-12));
      }
    }
  }
}

TEST_CASE("a traction on a face around an axis is weighed with the radius there") {
  // ∫ r³ 2 π r dr from 0.5 to 1.5
  const double force = 2 * std::numbers::pi * (std::pow(1.5, 5) - std::pow(0.5, 5)) / 5;
  for (const std::string phases : {"phase={}", "phase.max_motion=0.1"}) {
    CAPTURE(phases);
    const TractionResultant F = resultant(
        scenes::load("block", {"grid={min=[0, 0], max=[2, 2], cells=[8, 8]}", "body.min=[0.5, 0.5]",
                               "body.max=[1.5, 1.5]", "body.state=axisymmetric", "body.points_per_cell=9", "support=[]",
                               "probe=[]", "damping.c=1.0", phases, "traction=[{face='top', value=[0, 'x^3']}]"}));
    CHECK(F.y == Approx(force).epsilon(1e-12));
  }
}

TEST_CASE("a traction is told where its material was before the motion, in every phase") {
  // A block pulled to about 1.2 times its length: by the positions of later phases the same formula would be another.
  const auto stretched = [](const std::string& value) {
    Simulation simulation(
        scenes::load("block", {"traction=[{face='right', value=[" + value + ", 0]}]", "phase.max_motion=0.05",
                               "grid={min=[0, 0], max=[2, 2], cells=[8, 8]}", "body.min=[0, 0]", "body.max=[1, 1]"}));
    CHECK(simulation.run() == RunStatus::equilibrium);
    CHECK(simulation.summary().phases > 2);
    return scenes::probe(simulation.summary(), "corner", "u.x");
  };
  // the face is at x = 1, half of it loaded by twice the stress
  const double uniform = stretched("0.2"), by_x = stretched("'x > 1.01 ? 0 : 0.2*x'");
  CHECK(uniform > 0.1);
  CHECK(by_x == Approx(uniform).epsilon(1e-3));
}

TEST_CASE("a traction of the position and t follows t") {
  const auto phase = make_phase(scenes::load("block", in_room({"traction=[{face='top', value=[0, 'x*t']}]"})));
  std::vector<double> F(phase->size());
  for (const double t : {1.0, 3.0, 0.0, 2.0}) {
    phase->external_force(t, std::vector<double>(phase->size(), 0.0), F);
    double sum = 0;
    for (const double f : F) sum += f;
    CHECK(sum == Approx(t / 2).margin(1e-15));
  }
}

TEST_CASE("a traction that has no value on its line is an error at its key, one that is zero beside it a note") {
  const auto error = [](const std::string& load) {
    try {
      Simulation(scenes::load("block", {"traction=[{face='right', " + load + "}]", "stop.time=1"})).run();
    } catch (const SceneError& problem) {
      return std::string(problem.what());
    }
    return std::string();
  };
  CHECK_THAT(error("pressure='sqrt(0.5 - y)'"),
             Contains("not a number at (1, 0.5") && Contains("along the whole traction"));
  CHECK_THAT(error("value=['1/(x - 1)', 0]"), Contains("infinite at (1, 0.01"));
  CHECK_THAT(error("pressure='t*sqrt(0.5 - y)'"), Contains("not a number at t = 0"));
  // It acts at the border alone, where no material point is.
  const auto notes = [](const std::string& pressure) {
    Simulation simulation(scenes::load("block", {"traction=[{face='right', pressure='" + pressure + "'}]"}));
    std::string all;
    for (const std::string& note : simulation.summary().notes) all += note + "\n";
    return all;
  };
  CHECK_THAT(notes("x < 1 ? 0 : 1e-3"), !Contains("loads nothing"));
  CHECK_THAT(notes("x < 1 ? 1e-3 : 0"), Contains("traction[0] is zero"));
}

TEST_CASE("a line along a whole face loads it as the face does, to the last bit, and half of it with half the force") {
  const auto force = [](const std::string& traction) {
    const auto phase =
        make_phase(scenes::load("block", in_room({"body.points_per_cell=9", "traction=[" + traction + "]"})));
    std::vector<double> F(phase->size());
    phase->external_force(0, std::vector<double>(phase->size(), 0.0), F);
    return F;
  };
  const std::string value = ", value=[0.1, 0.7]}";
  const auto face = force("{face='top'" + value), line = force("{line=[[0, 1], [1, 1]]" + value);
  CHECK(face == line);
  const auto part = force("{line=[[0.1, 1], [0.6, 1]]" + value);
  double whole = 0, half = 0;
  for (const double f : face) whole += f;
  for (const double f : part) half += f;
  CHECK(whole == Approx(0.8));
  CHECK(half == Approx(0.4));
}

TEST_CASE("in phases a line is carried with all of its force and moment, on polygons and on one of several bodies") {
  const TractionResultant of_triangle = resultant(
      scenes::load("block", triangle({"phase.max_motion=0.1", "traction=[{line=[[4, 0], [0, 3]], value=[0, 1]}]"})));
  CHECK(of_triangle.y == Approx(5).epsilon(1e-12));
  CHECK(of_triangle.moment == Approx(10).epsilon(1e-12));
  const std::string two =
      "body=[{min=[0, 0], max=[1, 0.5], material='rubber'}, {min=[-0.5, 1], max=[0.5, 1.5], material='rubber'}]";
  auto overrides = in_room({"traction=[{line=[[0.5, 1], [0.5, 1.5]], pressure=2}]"});
  std::erase_if(overrides, [](const std::string& setting) { return setting.starts_with("body."); });
  overrides.insert(overrides.begin(), two);
  const TractionResultant of_second = resultant(scenes::load("block", overrides));
  CHECK(of_second.x == Approx(-1).epsilon(1e-12));
  CHECK(std::abs(of_second.y) < 1e-14);
}

TEST_CASE("a line that no straight side holds, or two bodies, is refused at its key") {
  const auto on = [](const std::string& line) {
    return scenes::refusal("block", triangle({"traction=[{line=" + line + ", pressure=1}]"}));
  };
  CHECK_THAT(on("[[4, 0], [0, 3], [0, 0]]"), Contains("traction[0].line") && Contains("two positions"));
  CHECK_THAT(on("[[4, 0], [4, 0]]"), Contains("traction[0].line") && Contains("the same"));
  CHECK_THAT(on("[[4, 0], [0, 0.1]]"), Contains("traction[0].line") && Contains("no straight side"));
  CHECK_THAT(on("[[1, 0], [0, 1]]"), Contains("no corner between them"));
  CHECK_THAT(scenes::refusal("block", triangle({"traction=[{pressure=1}]"})), Contains("face") && Contains("line"));
  CHECK_THAT(scenes::refusal("block", triangle({"traction=[{face='top', pressure=1}]"})),
             Contains("is a polygon") && Contains("line"));
  auto touching = in_room({"traction=[{line=[[0.2, 0.5], [0.8, 0.5]], pressure=2}]"});
  std::erase_if(touching, [](const std::string& setting) { return setting.starts_with("body."); });
  touching.insert(
      touching.begin(),
      "body=[{min=[0, 0], max=[1, 0.5], material='rubber'}, {min=[0, 0.5], max=[1, 1], material='rubber'}]");
  CHECK_THAT(scenes::refusal("block", touching), Contains("traction[0].line") && Contains("bodies 1 and 2 touch"));
}
