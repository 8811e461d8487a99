// An STL file gives triangles that enclose a finite volume, or one problem.
#include <cmath>

#include "fuzz_target.hpp"
#include "geometry/stl_file.hpp"
#include "geometry/triangle_solid.hpp"
#include "temporary_folder.hpp"

using namespace stillpoint;
using namespace stillpoint::fuzz;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const test::TemporaryFolder folder;
  const auto file = folder.write("body.stl", text_of(data, size));
  std::vector<Mistake> problems;
  const std::vector<Facet> facets = read_stl_file(file, problems);
  require_clear(problems);
  require(problems.size() <= 1 && problems.empty() == !facets.empty(), "a file has triangles or one problem");
  if (facets.empty()) return 0;
  const TriangleSolid solid(facets);
  const SpaceBox bounds = solid.bounds();
  double volume = 0;
  for (const double weight : solid.rule(bounds, 1).weight) volume += weight;
  require(std::isfinite(volume) && bounds.volume() > 0, "triangles without a problem enclose a volume");
  require(!solid.contains({bounds.high[0] + 1, bounds.high[1], bounds.high[2]}), "what is outside is not inside");
  solid.contains(bounds.middle());
  return 0;
}
