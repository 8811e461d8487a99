#include "scene_validation.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "in_quotes.hpp"
#include "toml_reader.hpp"

namespace stillpoint {
namespace {

/// A share of a cell that is taken for none.
constexpr double kSliver = 1e-6;

/// One pass over a scene; add() gives each problem its place.
class Validation {
 public:
  Validation(Scene& scene, std::vector<Problem>& problems) : scene_(scene), problems_(problems) {}

  void run() {
    const bool grid = check_grid();
    const bool body = grid && check_body();
    check_points_of_body(body);
    check_material();
    check_supports(grid);
    for (std::size_t k = 0; k < scene_.forces.size() && body; ++k)
      check_inside(scene_.forces[k].at, scene_.bodies[0].min, scene_.bodies[0].max, "body",
                   fmt::format("force[{}].at", k));
    check_probes(body);
    check_integrator();
    check_variant_names();
  }

 private:
  void add(const std::string& key, const std::string& message) {
    problems_.push_back({scene_.location(key), key + ": " + message});
  }

  /// True where the grid is a box that can be divided into its cells.
  bool check_grid() {
    const GridSpec& grid = scene_.grid;
    if (grid.min.empty() || grid.max.empty()) return false;
    for (std::size_t axis = 0; axis < grid.min.size(); ++axis) {
      const double length = grid.max[axis] - grid.min[axis];
      if (!(length > 0)) {
        add("grid.max", fmt::format("must be greater than grid.min = {}, not {}", grid.min[axis], grid.max[axis]));
        return false;
      }
      if (!std::isfinite(length)) {
        add("grid.max", "the grid's length is not a finite number");
        return false;
      }
      // Grid lines a few roundings apart could not be told from each other.
      const double largest = std::max(std::abs(grid.min[axis]), std::abs(grid.max[axis]));
      constexpr double relative = 1e-12;
      if (!grid.cells.empty() &&
          !(length / grid.cells[axis] > relative * largest && length / grid.cells[axis] > 1e-300)) {
        add("grid.cells", fmt::format("{} cells between {} and {} are too small for double precision", grid.cells[axis],
                                      grid.min[axis], grid.max[axis]));
        return false;
      }
    }
    return true;
  }

  bool check_body() {
    BodySpec& body = scene_.bodies[0];
    if (body.min.empty() || body.max.empty()) return false;
    const bool min_inside = check_inside(body.min, scene_.grid.min, scene_.grid.max, "grid", "body.min");
    const bool max_inside = check_inside(body.max, scene_.grid.min, scene_.grid.max, "grid", "body.max");
    if (!min_inside || !max_inside) return false;
    snap_to_grid(body.min);
    snap_to_grid(body.max);
    for (std::size_t axis = 0; axis < body.min.size(); ++axis) {
      if (body.max[axis] > body.min[axis]) continue;
      add("body.max", fmt::format("must be greater than body.min = {}, not {}", body.min[axis], body.max[axis]));
      return false;
    }
    return true;
  }

  /// A cell's length along an axis; 0 where the cells are not known.
  double cell_length(std::size_t axis) const {
    const GridSpec& grid = scene_.grid;
    return axis < grid.cells.size() ? (grid.max[axis] - grid.min[axis]) / grid.cells[axis] : 0;
  }

  /// Moves a face that misses a grid line by a sliver of a cell onto it: points in the sliver would have next to no
  /// mass.
  void snap_to_grid(std::vector<double>& place) const {
    for (std::size_t axis = 0; axis < place.size(); ++axis) {
      const double h = cell_length(axis);
      if (h == 0) continue;
      const double cells = std::round((place[axis] - scene_.grid.min[axis]) / h);
      const double line = cells == scene_.grid.cells[axis] ? scene_.grid.max[axis] : scene_.grid.min[axis] + cells * h;
      if (std::abs(place[axis] - line) <= kSliver * h) place[axis] = line;
    }
  }

  void check_points_of_body(bool body_in_order) {
    if (scene_.grid.cells.empty()) return;
    constexpr double most = 5e7;  // about 10 GB of material points
    double points = 1;
    for (std::size_t axis = 0; axis < scene_.grid.cells.size(); ++axis) {
      const double share = body_in_order ? (scene_.bodies[0].max[axis] - scene_.bodies[0].min[axis]) /
                                               (scene_.grid.max[axis] - scene_.grid.min[axis])
                                         : 1;
      points *= share * scene_.grid.cells[axis] * scene_.bodies[0].points_per_cell[axis];
    }
    if (points > most)
      add("body.points_per_cell",
          fmt::format("{:.3g} material points are more than this program takes ({:g})", points, most));
  }

  /// The number of material points where the body fills whole cells; 0 where that depends on the placement.
  long known_points() const {
    if (scene_.grid.cells.empty()) return 0;
    long points = 1;
    for (std::size_t axis = 0; axis < scene_.grid.cells.size(); ++axis) {
      const double h = cell_length(axis);
      const double first = (scene_.bodies[0].min[axis] - scene_.grid.min[axis]) / h;
      const double last = (scene_.bodies[0].max[axis] - scene_.grid.min[axis]) / h;
      if (std::abs(first - std::round(first)) > kSliver || std::abs(last - std::round(last)) > kSliver) return 0;
      points *= std::lround(std::round(last) - std::round(first)) * scene_.bodies[0].points_per_cell[axis];
    }
    return points;
  }

  void check_material() {
    const std::string& name = scene_.bodies[0].material;
    if (name.empty() || scene_.materials.contains(name)) return;
    std::vector<std::string> names;
    for (const auto& material : scene_.materials) names.push_back(material.first);
    const std::string meant = nearest(name, names);
    add("body.material", fmt::format("there is no material {}{}", in_quotes(name),
                                     !meant.empty()  ? "; did you mean '" + meant + "'?"
                                     : names.empty() ? "; describe it in a table [material.<name>]"
                                                     : fmt::format("; there is {}", fmt::join(names, ", "))));
  }

  void check_supports(bool grid) {
    for (std::size_t k = 0; k < scene_.supports.size(); ++k) {
      SupportSpec& support = scene_.supports[k];
      if (grid) check_inside(support.at, scene_.grid.min, scene_.grid.max, "grid", fmt::format("support[{}].at", k));
      for (std::size_t before = 0; before < k && !support.at.empty(); ++before)
        if (scene_.supports[before].at == support.at && scene_.supports[before].component == support.component)
          add(fmt::format("support[{}].at", k), fmt::format("support[{}] holds this place already", before));
    }
  }

  void check_probes(bool body) {
    std::set<std::string> names;
    for (std::size_t k = 0; k < scene_.probes.size(); ++k) {
      ProbeSpec& probe = scene_.probes[k];
      const std::string key = fmt::format("probe[{}]", k);
      if (body) check_inside(probe.at, scene_.bodies[0].min, scene_.bodies[0].max, "body", key + ".at");
      if (body && probe.point) {
        const long points = known_points();
        if (points > 0 && *probe.point > points)
          add(key + ".point", fmt::format("there are {} material points, so {} is too large", points, *probe.point));
      }
      // The name becomes a column of history.csv.
      if (!probe.name.empty()) {
        const bool printable = std::none_of(probe.name.begin(), probe.name.end(), [](char c) {
          return static_cast<unsigned char>(c) < 0x20 || c == 0x7f || c == ',' || c == '"';
        });
        if (!printable)
          add(key + ".name", "names a column of history.csv and cannot hold a comma, a quote or a control character");
        if (!names.insert(probe.name).second)
          add(key + ".name", fmt::format("there is a probe {} already", in_quotes(probe.name)));
      }
      check_fields(probe, key);
    }
  }

  void check_fields(const ProbeSpec& probe, const std::string& key) {
    static const std::vector<std::string> known = {"u", "v", "strain", "stress"};
    for (std::size_t k = 0; k < probe.fields.size(); ++k) {
      const std::string& field = probe.fields[k];
      const std::string path = fmt::format("{}.fields[{}]", key, k);
      if (std::find(known.begin(), known.end(), field) == known.end()) {
        add(path, unknown_word("unknown field", field, known));
      } else if (std::find(probe.fields.begin(), probe.fields.begin() + static_cast<std::ptrdiff_t>(k), field) !=
                 probe.fields.begin() + static_cast<std::ptrdiff_t>(k)) {
        add(path, fmt::format("{} is there already", in_quotes(field)));
      }
    }
  }

  void check_integrator() {
    const IntegratorSpec& spec = scene_.integrator;
    if (spec.method.empty()) return;
    const bool leapfrog = spec.method == "leapfrog";
    const bool euler = spec.method == "symplectic-euler";
    const bool fits =
        spec.treatment == DampingTreatment::automatic || (leapfrog && spec.treatment == DampingTreatment::averaged) ||
        ((leapfrog || euler) && spec.treatment == DampingTreatment::lagged) ||
        (euler && (spec.treatment == DampingTreatment::implicit || spec.treatment == DampingTreatment::exact));
    if (!fits)
      add("integrator.damping", fmt::format("this treatment does not go with method '{}', which takes {}", spec.method,
                                            leapfrog ? "automatic, averaged or lagged"
                                            : euler  ? "automatic, lagged, implicit or exact"
                                                     : "automatic only"));
    if (fits && spec.treatment == DampingTreatment::exact && scene_.damping.strategy == "identity" &&
        scene_.mass.kind == MassKind::consistent)
      add("integrator.damping",
          "'exact' needs C and M diagonal together: take mass.kind = \"lumped\" or damping.strategy = \"viscous\"");
    const Method method = find_method(spec.method);
    if (spec.rtol && !method.adaptive)
      add("integrator.rtol", fmt::format("method '{}' has no error estimate; leave rtol out", spec.method));
    if (!spec.rtol && !method.fixed_step)
      add("integrator.method", fmt::format("method '{}' has no fixed step: give integrator.rtol", spec.method));
  }

  void check_variant_names() {
    std::set<std::string> names;
    for (std::size_t k = 0; k < scene_.variants.size(); ++k) {
      const std::string& name = scene_.variants[k].name;
      if (!name.empty() && !names.insert(name).second)
        add(fmt::format("variant[{}].name", k), fmt::format("there is a variant {} already", in_quotes(name)));
    }
  }

  /// True where place lies in the box, after moving a place that misses it by a sliver onto its border.
  bool check_inside(std::vector<double>& place, const std::vector<double>& min, const std::vector<double>& max,
                    const char* box, const std::string& key) {
    for (std::size_t axis = 0; axis < place.size(); ++axis) {
      constexpr double rounding = 1e-12;  // of the box and its distance from the origin
      const double slack =
          std::max(rounding * std::max({max[axis] - min[axis], std::abs(min[axis]), std::abs(max[axis])}),
                   2 * kSliver * cell_length(axis));
      if (place[axis] < min[axis] - slack || place[axis] > max[axis] + slack) {
        add(key, fmt::format("{} lies outside the {}, {} to {}", place[axis], box, min[axis], max[axis]));
        return false;
      }
      place[axis] = std::clamp(place[axis], min[axis], max[axis]);
    }
    return true;
  }

  Scene& scene_;
  std::vector<Problem>& problems_;
};

}  // namespace

void validate(Scene& scene, std::vector<Problem>& problems) { Validation(scene, problems).run(); }

}  // namespace stillpoint
