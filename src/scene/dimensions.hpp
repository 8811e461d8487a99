// The properties of a number of dimensions: names, turns, and the reported quantities. Other code asks for a property
// here, not for the number.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace stillpoint {

/// From one axis towards another, about a third.
struct Turn {
  std::size_t about, from, to;
};
inline constexpr std::array<Turn, 3> turns_in_space{{{0, 1, 2}, {1, 2, 0}, {2, 0, 1}}};

struct DimensionInfo {
  std::string_view axes;        // their names
  std::span<const Turn> turns;  // the turns of a rigid body: none on a line, in the plane about z alone
  std::size_t vertical;         // the axis that points upwards
  bool is_section;              // its points show the section of a slope
  bool watches_work;            // its history has the work of the loads beside the kinetic energy
  int moment_components;        // the number of a support's moments of reaction that are reported
};

inline constexpr std::array<DimensionInfo, 3> dimension_infos{{
    {.axes = "x", .turns = {}, .vertical = 0, .is_section = false, .watches_work = false, .moment_components = 0},
    {.axes = "xy",
     .turns = std::span(turns_in_space).last(1),
     .vertical = 1,
     .is_section = true,
     .watches_work = true,
     .moment_components = 0},
    {.axes = "xyz",
     .turns = turns_in_space,
     .vertical = 1,
     .is_section = false,
     .watches_work = true,
     .moment_components = 3},
}};

/// True if there are problems of this number of dimensions, which may be read from a damaged file.
constexpr bool is_dimension(int dim) { return dim > 0 && static_cast<std::size_t>(dim) <= dimension_infos.size(); }

/// The entry of a table for 1, 2 or 3 dimensions.
template <class T>
constexpr const T& of_dimension(const std::array<T, 3>& table, int dim) {
  return table[static_cast<std::size_t>(dim - 1)];
}
constexpr const DimensionInfo& dimension_info(int dim) { return of_dimension(dimension_infos, dim); }

/// visit<Dim>(), which returns the same type for each.
template <class Visit>
decltype(auto) with_dimension(int dim, const Visit& visit) {
  switch (dim) {
    case 1:
      return visit.template operator()<1>();
    case 2:
      return visit.template operator()<2>();
    default:
      return visit.template operator()<3>();
  }
}

/// "u.x", "u.y" of components "x", "y"; the only component of a figure has its name alone.
inline std::vector<std::string> component_names(std::string_view figure, std::span<const std::string> components,
                                                std::string_view separator = ".") {
  if (components.size() == 1) return {std::string(figure)};
  std::vector<std::string> names;
  for (const std::string& component : components)
    names.push_back(std::string(figure).append(separator).append(component));
  return names;
}

/// "x", "y", "z" as there are.
inline std::vector<std::string> axis_names(int dim) {
  std::vector<std::string> names;
  for (const char axis : dimension_info(dim).axes) names.emplace_back(1, axis);
  return names;
}
/// The names of the axes that a body can turn about.
inline std::vector<std::string> turn_names(int dim) {
  std::vector<std::string> names;
  for (const Turn& turn : dimension_info(dim).turns) names.emplace_back(1, "xyz"[turn.about]);
  return names;
}
/// The names of the components of a Cauchy stress in the order of the laws: one, four or six.
inline std::vector<std::string> stress_names(int components) {
  static constexpr std::array all{"xx", "yy", "zz", "xy", "yz", "zx"};
  return {all.begin(), all.begin() + components};
}
/// The names of the components of a displacement gradient: "xx", "xy", … row by row, and "zz" if there is an axis of
/// symmetry.
inline std::vector<std::string> gradient_names(int dim, int components) {
  std::vector<std::string> names;
  for (const char i : dimension_info(dim).axes) {
    for (const char j : dimension_info(dim).axes) names.push_back({i, j});
  }
  if (static_cast<int>(names.size()) < components) names.emplace_back("zz");
  return names;
}

}  // namespace stillpoint
