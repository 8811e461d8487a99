// The part that all checks of a scene share: reports of what is wrong, and the boxes that positions lie in.
#pragma once

#include <stillpoint/catalogue.hpp>
#include <stillpoint/scene.hpp>

#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "scene/grid_lines.hpp"
#include "scene/input/toml_value.hpp"
#include "scene/resolve.hpp"
#include "scene/support_kind.hpp"

namespace stillpoint {

/// A box that positions lie in.
struct NamedBox {
  std::vector<double> min, max;
  std::string name;  // "grid", "body", "bodies"
};

class SceneCheck {
 public:
  SceneCheck(const Scene& scene, Reading& reading, const Catalogue& catalogue)
      : scene_(scene), reading_(reading), catalogue_(catalogue) {}

  const Scene& scene() const { return scene_; }
  const std::vector<Mistake>& problems() const { return reading_.problems; }
  const Catalogue& catalogue() const { return catalogue_; }
  /// The law of a material by its name; null: there is no such material or law.
  const LawInfo* law_of(const std::string& material) const {
    const auto found = scene_.materials.find(material);
    return found == scene_.materials.end() ? nullptr : catalogue_.law(found->second.law);
  }

  /// Reports a key, or a table, as wrong.
  void add(const std::string& key, const std::string& message) { reading_.problem(scene_.location(key), key, message); }
  /// Reports what is wrong in another file.
  void add(Mistake problem) { reading_.add(std::move(problem)); }

  // The relations between keys are rows: a condition, the key that is wrong under it, and the message.
  /// Reports the key, written or not, under the condition, which is returned.
  template <class... Args>
  bool wrong_if(bool condition, const std::string& key, fmt::format_string<Args...> message, Args&&... args) {
    if (condition) add(key, fmt::format(message, std::forward<Args>(args)...));
    return condition;
  }
  /// Reports those keys of a table that are written, under the condition.
  template <class... Args>
  void refuse_if(bool condition, const std::string& table, std::initializer_list<const char*> keys,
                 fmt::format_string<const Args&...> message, const Args&... args) {
    if (!condition) return;
    for (const char* key : keys)
      if (const std::string path = fmt::format("{}.{}", table, key); written(path))
        add(path, fmt::format(message, args...));
  }

  bool written(const std::string& key) const { return scene_.where.contains(key); }
  /// True if a key is written, even if its value could not be read, or if the problem has its value.
  bool given(const std::string& key, bool has_value) const { return has_value || written(key); }
  /// True if a key is not written, or is written and in order.
  bool sound(const std::string& key) const {
    const auto entry = reading_.wrong.lower_bound(key + "[");
    return !reading_.wrong.contains(key) && (entry == reading_.wrong.end() || !entry->starts_with(key + "["));
  }

  /// A key of a table, and whether the problem has its value.
  struct Given {
    const char* key;
    bool has_value;
  };
  /// Exactly one of two keys of a table is to be given.
  void one_of(const std::string& table, const Given& a, const Given& b, const std::string& both,
              const std::string& neither);
  /// No two entries of an array of tables may have the same name; returns all names. what: an entry in words, if that
  /// is not the table's name.
  template <class Spec>
  std::set<std::string> unique_names(const std::string& table, const std::vector<Spec>& entries,
                                     const std::string& what = "") {
    std::set<std::string> names;
    for (std::size_t k = 0; k < entries.size(); ++k)
      if (const std::string& name = entries[k].name; !name.empty() && !names.insert(name).second)
        add(fmt::format("{}[{}].name", table, k),
            fmt::format("there is a {} {} already", what.empty() ? table : what, in_quotes(name)));
    return names;
  }
  /// Reports a name that is none of `names`. what: "wall"; heading: "[[wall]]", under which one is described.
  void add_unknown(const std::string& key, const std::string& what, const std::string& heading, const std::string& name,
                   const std::vector<std::string>& names);

  /// Checks a name that becomes a part of a column of history.csv.
  void column_name(const std::string& name, const std::string& key);
  /// Checks the name of a body or a rigid body, which history.csv joins with that of another one that it touches.
  void contact_name(const std::string& name, const std::string& key);

  /// True if a list, the value of a key, has two different positions.
  bool two_positions(const std::string& key, const std::vector<std::vector<double>>& list) {
    return !wrong_if(list.size() != 2, key, "must be two positions, [from, to], not {}", list.size()) &&
           !wrong_if(list[0] == list[1], key, "the two positions are the same");
  }

  /// The table of body k: "body", or "body[1]" if there is an array of them.
  std::string body_table(std::size_t k) const { return written("body[0]") ? fmt::format("body[{}]", k) : "body"; }
  std::string body_key(std::size_t k, const std::string& key) const { return body_table(k) + "." + key; }
  /// The key of one coordinate of a position: "grid.max", in more dimensions "grid.max[1]".
  std::string axis_key(const std::string& key, std::size_t axis) const {
    return scene_.dim == 1 ? key : fmt::format("{}[{}]", key, axis);
  }

  NamedBox grid_box() const { return {scene_.grid.min, scene_.grid.max, "grid"}; }
  /// True if a position, the value of a key, lies in a box.
  bool inside(const std::vector<double>& position, const NamedBox& box, const std::string& key);
  /// True if the ends of a part of a face, the keys from and to of a table, are in order and lie on the face of a box.
  bool check_interval(const std::string& table, const FaceInterval& part, std::size_t k, const NamedBox& box);
  /// The key of an end of the part of a face along its axis k: "support[0].from", in space "support[0].from[1]".
  std::string end_key(const std::string& table, const char* end, std::size_t k) const {
    return scene_.dim == 2 ? table + end : fmt::format("{}{}[{}]", table, end, k);
  }

 private:
  const Scene& scene_;
  Reading& reading_;
  const Catalogue& catalogue_;
};

/// Checks that the parts of a resolved scene fit together; each single value is right, or was left at its default
/// because it was wrong. files: what is wrong with those that bodies name.
void validate(const Scene& scene, const std::vector<FileMistake>& files, Reading& reading, const Catalogue& catalogue);

// The parts of validate(). grid: whether the grid is a box that can be divided into its cells; body: the box around all
// bodies, empty if one of them is not in order.
std::optional<NamedBox> check_bodies(SceneCheck& check, bool grid, const std::vector<FileMistake>& files);
void check_materials(SceneCheck& check);
/// True if the corners of a body's polygon are those of a simple polygon with an area.
bool check_corners(SceneCheck& check, std::size_t k);
/// True if a key says that body k is neither a box nor points from a file.
bool has_shape_key(const SceneCheck& check, std::size_t k);
/// True if the shape of body k, cut off where min or max is written, has a volume in the grid. Its box is in order.
bool check_solid(SceneCheck& check, std::size_t k);
/// Checks that no two bodies, all of them in order, are in the same position.
void check_overlaps(SceneCheck& check);
/// The number of material points if the bodies fill whole cells; 0 if that depends on the placement.
long known_points(SceneCheck& check);
void check_supports_and_walls(SceneCheck& check, bool grid);
void check_rigid_bodies(SceneCheck& check);
/// Checks the contacts between bodies, and what neither these nor rigid bodies go with.
void check_contacts(SceneCheck& check);
/// Checks the names of bodies that something touches, the value of a key.
void check_body_names(SceneCheck& check, const std::string& key, const std::vector<std::string>& bodies);
/// Checks that rigid body k has a shape.
void check_rigid_shape(SceneCheck& check, std::size_t k);
void check_loads(SceneCheck& check, const std::optional<NamedBox>& body);
void check_initial_stress(SceneCheck& check, const std::optional<NamedBox>& body);
/// Checks that the body force is a constant weight, for the key whose stress bears it.
void check_weight(SceneCheck& check, const std::string& key);
void check_exact(SceneCheck& check, bool bodies);
void check_phases(SceneCheck& check, bool grid);
/// Checks what a run that begins with the points of another one does not go with.
void check_other_run(SceneCheck& check);
/// Checks the stages to come, of a scene in its first one.
void check_stages(SceneCheck& check);
void check_output(SceneCheck& check, const std::optional<NamedBox>& body);

/// True for a motion that is none.
inline bool rests(const Expression& motion) { return motion.constant() && motion({}, 0) == 0; }

/// "linear, quadratic or cubic"
std::string either(const std::vector<std::string>& words);
/// "law 'hencky' has no state 'plane-stress'; it has …", if `what` is "law 'hencky'"; empty if it has the state.
std::string why_no_state(const std::string& what, const std::vector<StressState>& states, StressState state);

}  // namespace stillpoint
