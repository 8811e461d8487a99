#include "output/field_frame.hpp"

#include <set>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "scene/dimensions.hpp"

namespace stillpoint {
namespace {

constexpr int most_components = 6;

[[noreturn]] void refuse(const std::string& what) { throw std::invalid_argument("a frame of fields: " + what); }

bool is_word(const std::string& name) {
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
  return !name.empty() && name.find_first_not_of(letters) == std::string::npos;
}

}  // namespace

void validate(const FieldFrame& frame) {
  if (frame.points == 0) refuse("no points");
  if (!is_dimension(frame.dim)) refuse(fmt::format("dimension {}", frame.dim));
  const auto expect = [](const std::string& name, std::size_t size, std::size_t expected) {
    if (size != expected) refuse(fmt::format("{} has {} values, expected {}", name, size, expected));
  };
  const auto dim = static_cast<std::size_t>(frame.dim);
  expect("place", frame.position.size(), frame.points * dim);
  if (!frame.material.empty()) expect("material", frame.material.size(), frame.points);
  if (!frame.grid_lines.empty()) expect("the grid", frame.grid_lines.size(), dim);
  std::set<std::string> names = {"place", "material"};
  for (const PointField& field : frame.fields) {
    if (!is_word(field.name)) refuse(fmt::format("'{}' is no name of a field", field.name));
    if (!names.insert(field.name).second) refuse(fmt::format("there is more than one '{}'", field.name));
    if (field.components < 1 || field.components > most_components)
      refuse(fmt::format("{} has {} components, expected 1 to {}", field.name, field.components, most_components));
    expect(field.name, field.values.size(), frame.points * static_cast<std::size_t>(field.components));
  }
}

}  // namespace stillpoint
