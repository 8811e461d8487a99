#include "output/sum_probes.hpp"

#include <algorithm>
#include <stdexcept>

#include "scene/dimensions.hpp"

namespace stillpoint {

MeanInBox::MeanInBox(const LagrangianPhase& phase, const PointData& data, const ProbeSpec& spec) {
  for (const std::string& name : spec.fields) fields_.push_back(find_point_field(phase, name));
  const std::vector<double>& x = data.initial_positions;
  const auto dim = static_cast<std::size_t>(phase.dim());
  for (std::size_t p = 0; p < phase.points(); ++p) {
    bool inside = true;
    for (std::size_t d = 0; d < dim; ++d)
      inside = inside && x[dim * p + d] >= spec.min[d] && x[dim * p + d] <= spec.max[d];
    if (inside) points_.push_back(p);
  }
  if (points_.empty()) throw std::invalid_argument("there is no material point in this box");
}

void MeanInBox::read(ProbedMoment& moment, std::vector<double>& values) {
  const std::vector<double>& volume = moment.field("volume");
  for (const PointFieldComponent& field : fields_) {
    const std::vector<double>& of_points = moment.field(field.name);
    double sum = 0, all = 0;
    for (const std::size_t p : points_) {
      sum += volume[p] * of_points[field.components * p + field.component];
      all += volume[p];
    }
    values.push_back(sum / all);
  }
}

void BodySums::read(ProbedMoment& moment, std::vector<double>& values) {
  for (const std::string& name : names_) values.push_back(value(name, moment));
}

double BodySums::value(const std::string& name, ProbedMoment& moment) const {
  double sum = 0;
  if (name == "volume") {
    for (const double v : moment.field("volume")) sum += v;
    return sum;
  }
  const std::vector<double>& v = moment.field("v");
  const std::size_t dim = v.size() / mass_.size();
  const auto number_among = [&](const std::vector<std::string>& names) {
    return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
  };
  const std::span<const Turn> turns = dimension_info(static_cast<int>(dim)).turns;
  const auto turn = number_among(component_names("angular_momentum", turn_names(static_cast<int>(dim))));
  if (turn < turns.size()) {
    const std::size_t i = turns[turn].from, j = turns[turn].to;
    const std::vector<double>& x = moment.field("position");
    for (std::size_t p = 0; p < mass_.size(); ++p)
      sum += mass_[p] * (x[dim * p + i] * v[dim * p + j] - x[dim * p + j] * v[dim * p + i]);
    return sum;
  }
  const std::size_t axis = number_among(component_names("momentum", axis_names(static_cast<int>(dim))));
  if (axis == dim) throw std::invalid_argument("there is no field " + name);
  for (std::size_t p = 0; p < mass_.size(); ++p) sum += mass_[p] * v[dim * p + axis];
  return sum;
}

}  // namespace stillpoint
