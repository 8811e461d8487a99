// What the files that read the tables of a scene share.
#pragma once

#include <stillpoint/scene.hpp>

#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "scene/input/toml_reader.hpp"

namespace stillpoint {

template <class T>
using Words = std::vector<std::pair<std::string, T>>;

inline constexpr std::int64_t kNoLimit = std::numeric_limits<std::int64_t>::max();

inline std::size_t count_of_axes(const Scene& scene) { return static_cast<std::size_t>(scene.dim); }

/// The coordinates that formulas of this scene may use: "x", "xy" or "xyz".
inline std::string coordinates(const Scene& scene) { return std::string("xyz").substr(0, count_of_axes(scene)); }

template <class Infos>
std::vector<std::string> names_of(const Infos& infos) {
  std::vector<std::string> names;
  for (const auto& info : infos) names.emplace_back(info.name);
  return names;
}

/// [body] or [[body]]; the grid must have been read.
void read_bodies(TableReader& root, Scene& scene);
/// [material.<name>].
void read_materials(TableReader& root, Scene& scene);
/// [[support]], [[wall]], [[force]], [[traction]] and [body_force].
void read_loads(TableReader& root, Scene& scene);
/// [initial] and [exact].
void read_fields(TableReader& root, Scene& scene);

}  // namespace stillpoint
