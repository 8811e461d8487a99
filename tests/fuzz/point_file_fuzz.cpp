// A file of points gives as many positions on each axis as volumes, all of them in the grid, or problems.
#include <array>
#include <cmath>

#include "fuzz_target.hpp"
#include "scene/point_file.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using namespace stillpoint::fuzz;

namespace {

const std::vector<double> kMin = {-1, 0}, kMax = {8, 4};

void read(const std::filesystem::path& file, std::size_t dim) {
  const std::vector<double> min(kMin.begin(), kMin.begin() + dim), max(kMax.begin(), kMax.begin() + dim);
  std::vector<Mistake> problems;
  const PointFile points = read_point_file(file, min, max, problems);
  require_clear(problems);
  if (!problems.empty()) return;
  require(!points.volume.empty() && points.x.size() == dim, "a file without a problem has points");
  for (const double volume : points.volume) require(volume > 0 && std::isfinite(volume), "volumes are positive");
  for (std::size_t axis = 0; axis < dim; ++axis) {
    require(points.x[axis].size() == points.volume.size(), "every point has a position");
    for (const double x : points.x[axis]) require(x >= min[axis] && x <= max[axis], "points lie in the grid");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const test::TemporaryFolder folder;
  const auto file = folder.write("points.csv", text_of(data, size));
  read(file, 1);
  read(file, 2);
  return 0;
}
