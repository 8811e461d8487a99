#include <stillpoint/scene.hpp>

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

#include "scene/dimensions.hpp"
#include "scene/own_loads.hpp"

namespace stillpoint {

std::string_view to_string(StressState state) {
  switch (state) {
    case StressState::uniaxial_stress:
      return "uniaxial-stress";
    case StressState::uniaxial_strain:
      return "uniaxial-strain";
    case StressState::plane_strain:
      return "plane-strain";
    case StressState::plane_stress:
      return "plane-stress";
    case StressState::axisymmetric:
      return "axisymmetric";
    case StressState::space:
      return "space";
  }
  return "";
}

Location Scene::location(const std::string& key) const {
  for (std::string around = key; !around.empty();) {
    if (const auto found = where.find(around); found != where.end()) return found->second;
    // "support[0].at" lies in "support[0]", which lies in "support".
    const auto end = around.find_last_of(".[");
    around.resize(end == std::string::npos ? 0 : end);
  }
  const auto has_no_file = [](const auto& written) { return written.second.file.empty(); };
  if (where.empty() || std::ranges::any_of(where, has_no_file)) return {};  // a program's own scene
  return {file.string(), 1, 1};
}

SceneError Scene::located(const SceneError& error) const {
  std::vector<Mistake> mistakes = error.problems();
  for (Mistake& mistake : mistakes) {
    if (mistake.key.empty() && mistake.where.file.empty()) mistake.where.file = this->file.string();
    const Location found = location(mistake.key);
    if (mistake.key.empty() || found.file.empty()) continue;
    mistake.where = found;
    mistake.key.clear();
  }
  return SceneError(std::move(mistakes));
}

bool loads_vary(const Problem& problem) {
  bool any = own_load_varies(problem);
  problem.for_each_formula([&](const std::string&, const Expression& formula) { any = any || formula.uses('t'); });
  return any;
}

std::vector<std::string> probe_fields(int dim) {
  if (dim == 1) return {"u", "v", "strain", "stress"};
  const std::vector<std::string> axes = axis_names(dim), stresses = stress_names(dim == 3 ? 6 : 4);
  std::vector<std::string> fields;
  const auto add = [&](std::string_view figure, const std::vector<std::string>& components) {
    std::ranges::move(component_names(figure, components), std::back_inserter(fields));
  };
  add("u", axes);
  add("v", axes);
  add("stress", stresses);
  add("strain", gradient_names(dim, dim * dim));
  fields.insert(fields.end(), {"plastic_strain", "pore_pressure", "pc", "void_ratio"});
  add("effective_stress", stresses);
  return fields;
}

std::vector<std::string> body_fields(int dim) {
  std::vector<std::string> fields = {"volume"};
  std::ranges::move(component_names("momentum", axis_names(dim)), std::back_inserter(fields));
  std::ranges::move(component_names("angular_momentum", turn_names(dim)), std::back_inserter(fields));
  return fields;
}

}  // namespace stillpoint
