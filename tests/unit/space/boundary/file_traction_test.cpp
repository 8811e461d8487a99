// Tractions on the outer surface of a body that is points from a file.
#include <stillpoint/stillpoint.hpp>

#include <cmath>
#include <fstream>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "scenes.hpp"
#include "space/phase/lagrangian_phase.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using Catch::Matchers::Contains;

namespace {

/// A free body of the points that are inside, four to a cell of 0.1, in a grid from −1 to 3.
class FileBody {
 public:
  template <class Inside>
  explicit FileBody(const Inside& inside) : file_(folder_.path() / "points.csv") {
    std::ofstream out(file_);
    out << "x,y,volume\n";
    constexpr double h = 0.05;
    for (int i = 0; i < 40; ++i) {
      for (int j = 0; j < 40; ++j) {
        const double x = h * (i + 0.5), y = h * (j + 0.5);
        if (inside(x, y)) out << fmt::format("{:.17g},{:.17g},{:.17g}\n", x, y, h * h);
      }
    }
  }
  std::vector<std::string> overrides(std::vector<std::string> more) const {
    more.insert(more.begin(),
                {"grid={min=[-1, -1], max=[3, 3], cells=[40, 40]}",
                 fmt::format("body=[{{file='{}', material='rubber', state='plane-strain'}}]", file_.string()),
                 "support=[]", "probe=[]", "damping.c=1.0"});
    return more;
  }

 private:
  test::TemporaryFolder folder_;
  std::filesystem::path file_;
};

std::array<double, 2> force_on(const FileBody& body, const std::string& traction,
                               const std::string& more = "title=''") {
  const auto phase = make_phase(scenes::load("block", body.overrides({"traction=[{" + traction + "}]", more})));
  std::vector<double> F(phase->size());
  phase->external_force(0, std::vector<double>(phase->size(), 0.0), F);
  std::array<double, 2> sum{};
  for (std::size_t i = 0; i < F.size(); ++i) sum[i % 2] += F[i];
  return sum;
}

}  // namespace

TEST_CASE("a line on the outer surface of a file's points loads it as the side of a box there would be") {
  const FileBody square([](double x, double y) { return x < 1 && y < 1; });
  for (const std::string more : {"title=''", "grid.basis=quadratic", "phase.max_motion=0.1"}) {
    CAPTURE(more);
    const auto top = force_on(square, "line=[[0, 1], [1, 1]], value=[0.3, -0.2]", more);
    CHECK(top[0] == Approx(0.3).epsilon(1e-12));
    CHECK(top[1] == Approx(-0.2).epsilon(1e-12));
    const auto right = force_on(square, "line=[[1, 0.25], [1, 0.75]], pressure=2", more);
    CHECK(right[0] == Approx(-1).epsilon(1e-12));
    CHECK(std::abs(right[1]) < 1e-12);
  }
}

TEST_CASE("a line goes round the corners of a file's points, the shorter way, whichever end is written first") {
  const FileBody square([](double x, double y) { return x < 1 && y < 1; });
  for (const std::string line : {"[[0, 0.5], [0.75, 1]]", "[[0.75, 1], [0, 0.5]]"}) {
    CAPTURE(line);
    const auto F = force_on(square, "line=" + line + ", pressure=1");  // half of the left side, most of the top
    CHECK(F[0] == Approx(0.5).epsilon(1e-12));
    CHECK(F[1] == Approx(-0.75).epsilon(1e-12));
  }
}

TEST_CASE("a pressure on a part of a disc of points pushes with its chord, in two steps as in one") {
  const FileBody disc([](double x, double y) { return std::hypot(x - 1, y - 1) < 0.9; });
  // ∫ n ds from a to b is the chord turned by 90°: upper half, 1.8 wide, but for the points' squares
  const auto upper = force_on(disc, "line=[[0.1, 1], [1.9, 1]], pressure=1");
  CHECK(std::abs(upper[0]) < 0.05);
  CHECK(std::abs(upper[1]) == Approx(1.8).epsilon(0.03));
  const auto left = force_on(disc, "line=[[0.1, 1], [1, 1.9]], pressure=1");
  const auto right = force_on(disc, "line=[[1, 1.9], [1.9, 1]], pressure=1");
  CHECK(left[0] > 0.8);
  CHECK(left[1] + right[1] == Approx(-1.8).epsilon(0.03));
}

TEST_CASE("a line off the outline of a file's points is refused at its key") {
  const FileBody square([](double x, double y) { return x < 1 && y < 1; });
  CHECK_THAT(scenes::refusal("block", square.overrides({"traction=[{line=[[0.5, 0.5], [1, 0.5]], pressure=1}]"})),
             Contains("traction[0].line") && Contains("outline"));
  CHECK_THAT(scenes::refusal("block", square.overrides({"traction=[{face='top', pressure=1}]"})),
             Contains("points from a file") && Contains("line"));
}

TEST_CASE("a rigid plate touches all of the side that a file's points show it") {
  const FileBody square([](double x, double y) { return x < 1 && y < 1; });
  for (const std::string more : {"title=''", "grid.basis=quadratic", "phase.max_motion=0.1"}) {
    CAPTURE(more);
    const auto phase = make_phase(scenes::load(
        "block", square.overrides({"traction=[]", "rigid=[{name='plate', half_plane=[[0, 0.99], [0, -1]]}]", more})));
    const ContactReport plate = phase->supports().contacts(0, std::vector<double>(phase->size(), 0.0)).at(0);
    CHECK(plate.area == Approx(1).epsilon(1e-12));
    CHECK(plate.penetration == Approx(0.1));  // [cells]
    CHECK(plate.force[1] < 0);
    CHECK(std::abs(plate.force[0]) < 1e-12 * -plate.force[1]);
  }
}
