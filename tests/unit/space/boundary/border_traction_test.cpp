// Tractions on a straight part of a body's border, oblique to the grid or along it.
#include <stillpoint/stillpoint.hpp>

#include <cmath>

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

struct Resultant {
  double x = 0, y = 0, moment = 0;  // about the origin
};

/// Of F(0) over all functions of a free body, about the origin: Σ N_a ξ_a = x with the centres ξ_a of splines.
Resultant resultant(const Scene& scene) {
  const auto phase = make_phase(scene);
  std::vector<double> F(phase->size());
  phase->external_force(0, std::vector<double>(phase->size(), 0.0), F);
  Resultant sum;
  for (std::size_t i = 0; i < F.size(); i += 2) {
    if (F[i] == 0 && F[i + 1] == 0) continue;
    const std::vector<double> x = phase->diagnosis().of_unknown(i).position;
    sum.x += F[i];
    sum.y += F[i + 1];
    sum.moment += x[0] * F[i + 1] - x[1] * F[i];
  }
  return sum;
}

}  // namespace

TEST_CASE("a traction on an oblique side of a polygon adds up to stress times area, about its middle") {
  for (const std::string basis : {"linear", "quadratic"}) {
    for (const std::string line : {"[[4, 0], [0, 3]]", "[[0, 3], [4, 0]]", "[[2, 1.5], [0.8, 2.4]]"}) {
      for (const bool pressure : {false, true}) {
        CAPTURE(basis, line, pressure);
        const std::string load = pressure ? "pressure=0.5" : "value=[0.3, -0.2]";
        const Resultant F = resultant(
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
  const Resultant of_triangle = resultant(
      scenes::load("block", triangle({"phase.max_motion=0.1", "traction=[{line=[[4, 0], [0, 3]], value=[0, 1]}]"})));
  CHECK(of_triangle.y == Approx(5).epsilon(1e-12));
  CHECK(of_triangle.moment == Approx(10).epsilon(1e-12));
  const std::string two =
      "body=[{min=[0, 0], max=[1, 0.5], material='rubber'}, {min=[-0.5, 1], max=[0.5, 1.5], material='rubber'}]";
  auto overrides = in_room({"traction=[{line=[[0.5, 1], [0.5, 1.5]], pressure=2}]"});
  std::erase_if(overrides, [](const std::string& setting) { return setting.starts_with("body."); });
  overrides.insert(overrides.begin(), two);
  const Resultant of_second = resultant(scenes::load("block", overrides));
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
