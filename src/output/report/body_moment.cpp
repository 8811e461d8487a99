#include <algorithm>
#include <array>

#include "output/point_fields.hpp"
#include "output/report/body_picture.hpp"

namespace stillpoint {
namespace {

// The first columns of an array (rows × columns).
std::vector<double> leading_columns(const std::vector<double>& array, std::size_t rows, std::size_t wanted) {
  const std::size_t columns = array.size() / rows;
  std::vector<double> leading(rows * wanted);
  for (std::size_t row = 0; row < rows; ++row)
    std::copy_n(array.begin() + static_cast<std::ptrdiff_t>(row * columns), wanted,
                leading.begin() + static_cast<std::ptrdiff_t>(row * wanted));
  return leading;
}

// A stress in the plane or in space is stored component by component.
std::vector<double> stored_stress(const Hdf5File& fields, const std::string& frame, std::size_t points, int dim) {
  constexpr std::array components = {"_xx", "_yy", "_zz", "_xy", "_yz", "_zx"};
  if (dim == 1) return fields.read(frame + "/stress");
  const std::size_t width = dim == 2 ? 4 : 6;
  std::vector<double> stress(points * width);
  for (std::size_t k = 0; k < width; ++k) {
    const std::vector<double> component = fields.read(frame + "/stress" + components[k]);
    for (std::size_t p = 0; p < points; ++p) stress[p * width + k] = component[p];
  }
  return stress;
}

bool is_always_there(const std::string& name) {
  return name == "place" || name == "u" || name == "v" || name == "material" || name.starts_with("stress");
}

}  // namespace

BodyMoment moment_of(const LagrangianPhase& phase, double t, ConstVec u, ConstVec v) {
  return {.t = t,
          .dim = phase.dim(),
          .points = phase.points(),
          .history_names = phase.info().history_names,
          .field = [&phase, t, u, v](const std::string& name) {
            return name == "position" ? current_positions(phase, t, u) : point_field(phase, name, t, u, v);
          }};
}

BodyMoment moment_of(const Hdf5File& fields, const std::string& frame) {
  BodyMoment moment{.t = fields.read_attribute(frame, "t"),
                    .dim = static_cast<int>(fields.read_attribute(frame, "dim")),
                    .points = fields.rows_of(frame + "/place"),
                    .history_names = fields.names_in(frame),
                    .field = {}};
  std::erase_if(moment.history_names, is_always_there);
  moment.field = [&fields, frame, dim = moment.dim, points = moment.points](const std::string& name) {
    if (name == "stress") return stored_stress(fields, frame, points, dim);
    const std::vector<double> stored = fields.read(frame + "/" + (name == "position" ? "place" : name));
    const bool is_vector = name == "position" || name == "u" || name == "v";
    return is_vector ? leading_columns(stored, points, static_cast<std::size_t>(dim)) : stored;
  };
  return moment;
}

}  // namespace stillpoint
