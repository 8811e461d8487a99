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
#include "scene/grid_lines.hpp"
#include "scene/input/toml_value.hpp"
#include "scene/resolve.hpp"

namespace stillpoint {

class SceneCheck {
 public:
  SceneCheck(const Scene& scene, Reading& reading, const Catalogue& catalogue)
      : scene_(scene), reading_(reading), catalogue_(catalogue) {}

  const Catalogue& catalogue() const { return catalogue_; }
  const Scene& scene() const { return scene_; }
  const std::vector<Mistake>& problems() const { return reading_.problems; }

  /// Reports a key, or a table, as wrong.
  void add(const std::string& key, const std::string& message) { reading_.problem(scene_.location(key), key, message); }
  /// Reports what is wrong in another file.
  void add(Mistake problem) { reading_.add(std::move(problem)); }
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

  /// A key of a table, and whether the problem has its value; one that was written and could not be read counts too.
  struct Given {
    const char* key;
    bool has_value;
  };
  bool given(const std::string& key, bool has_value) const { return has_value || written(key); }
  /// Of two keys of a table exactly one is to be given.
  void one_of(const std::string& table, const Given& a, const Given& b, const std::string& both,
              const std::string& neither) {
    const bool has_a = given(fmt::format("{}.{}", table, a.key), a.has_value);
    const bool has_b = given(fmt::format("{}.{}", table, b.key), b.has_value);
    if (has_a && has_b) add(fmt::format("{}.{}", table, b.key), both);
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
  double cell_length(std::size_t axis) const { return known_cell_length(scene_.grid, axis); }
  /// True if a position lies in a box.
  bool inside(const std::vector<double>& position, const std::vector<double>& min, const std::vector<double>& max,
              const std::string& box, const std::string& key);

 private:
  const Scene& scene_;
  Reading& reading_;
  const Catalogue& catalogue_;
};

/// The box around all bodies.
struct BodyBox {
  std::vector<double> min, max;
  std::string name;  // "body", or "bodies"
};

/// True if the grid is a box that can be divided into its cells.
bool check_grid(SceneCheck& check);
/// Bodies, their materials and files; the box around them if all of them are in order.
std::optional<BodyBox> check_bodies(SceneCheck& check, bool grid, const std::vector<FileMistake>& files);
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
