// What the checks of a scene share: where problems go, and the boxes that positions lie in.
#pragma once

#include <stillpoint/catalogue.hpp>
#include <stillpoint/scene.hpp>

#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "scene/input/toml_value.hpp"

namespace stillpoint {

class SceneCheck {
 public:
  SceneCheck(Scene& scene, Reading& reading, const Catalogue& catalogue)
      : scene_(scene), reading_(reading), catalogue_(catalogue) {}

  const Catalogue& catalogue() const { return catalogue_; }
  Scene& scene() { return scene_; }
  const Scene& scene() const { return scene_; }
  const std::vector<Problem>& problems() const { return reading_.problems; }

  /// Reports a key, or a table, as wrong.
  void add(const std::string& key, const std::string& message) { reading_.problem(scene_.location(key), key, message); }
  /// Reports what is wrong in another file.
  void add(Problem problem) { reading_.add(std::move(problem)); }
  bool written(const std::string& key) const { return scene_.where.contains(key); }
  /// Not written, or written and in order.
  bool sound(const std::string& key) const {
    const auto entry = reading_.wrong.lower_bound(key + "[");
    return !reading_.wrong.contains(key) && (entry == reading_.wrong.end() || !entry->starts_with(key + "["));
  }
  /// Reports each of these keys of a table that is written.
  void refuse(const std::string& table, std::initializer_list<const char*> keys, const std::string& why) {
    for (const char* key : keys) {
      const std::string whole = fmt::format("{}.{}", table, key);
      if (written(whole)) add(whole, why);
    }
  }

  /// Of two keys of a table exactly one is to be written.
  void one_of(const std::string& table, const std::string& a, const std::string& b, const std::string& both,
              const std::string& neither) {
    const bool has_a = written(table + "." + a), has_b = written(table + "." + b);
    if (has_a && has_b) add(table + "." + b, both);
    if (!has_a && !has_b) add(table, neither);
  }
  /// Of the entries of an array of tables no two have the same name; returns all names.
  template <class Spec>
  std::set<std::string> unique_names(const std::string& table, const std::vector<Spec>& entries) {
    std::set<std::string> names;
    for (std::size_t k = 0; k < entries.size(); ++k)
      if (const std::string& name = entries[k].name; !name.empty() && !names.insert(name).second)
        add(fmt::format("{}[{}].name", table, k), fmt::format("there is a {} {} already", table, in_quotes(name)));
    return names;
  }

  /// The key of body k: "body.min", or "body[1].min" if there is an array of them.
  std::string body_key(std::size_t k, const std::string& key) const;
  /// The key of one coordinate of a position: "grid.max", in more dimensions "grid.max[1]".
  std::string axis_key(const std::string& key, std::size_t axis) const;

  /// A cell's length along an axis; 0 if the cells are not known.
  double cell_length(std::size_t axis) const;
  /// Moves a face that misses a grid line by a sliver of a cell onto it: points in the sliver would have next to no
  /// mass.
  void snap_to_grid(std::vector<double>& position) const;
  /// True if a position lies in a box, after moving one that misses it by a sliver onto its border.
  bool inside(std::vector<double>& position, const std::vector<double>& min, const std::vector<double>& max,
              const std::string& box, const std::string& key);

 private:
  Scene& scene_;
  Reading& reading_;
  const Catalogue& catalogue_;
};

/// A share of a cell that is taken for none.
inline constexpr double kSliver = 1e-6;

/// The box around all bodies.
struct BodyBox {
  std::vector<double> min, max;
  std::string name;  // "body", or "bodies"
};

/// True if the grid is a box that can be divided into its cells.
bool check_grid(SceneCheck& check);
/// Bodies and their materials; the box around them if all of them are in order.
std::optional<BodyBox> check_bodies(SceneCheck& check, bool grid);
/// That no two bodies, all of them in order, are in the same place.
void check_overlaps(SceneCheck& check);
/// The number of material points if the bodies fill whole cells; 0 if that depends on the placement.
long known_points(SceneCheck& check);
/// Supports, walls, loads and initial stress.
void check_supports_and_walls(SceneCheck& check, bool grid);
void check_loads(SceneCheck& check, const std::optional<BodyBox>& body);
/// The exact solution. bodies: whether all of them are in order.
void check_exact(SceneCheck& check, bool bodies);
/// When phases end, and what scenes of more than one phase can have.
void check_phases(SceneCheck& check, bool grid);
/// What is written out.
void check_output(SceneCheck& check, const std::optional<BodyBox>& body);

/// What the catalogue says of a material's law; null if the law is not known.
const LawInfo* law_of(const SceneCheck& check, const MaterialSpec& material);
/// "linear, quadratic or cubic"
std::string either(const std::vector<std::string>& words);

}  // namespace stillpoint
