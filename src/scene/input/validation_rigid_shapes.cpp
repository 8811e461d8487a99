// Checks of the shapes of rigid bodies: one each, with the keys that it needs, which the geometry takes.
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scene/input/keys.hpp"
#include "scene/input/scene_check.hpp"
#include "scene/rigid_body.hpp"

namespace stillpoint {
namespace {

enum class Use { none, may, must };

/// A shape of a rigid body, and the keys that go with it.
struct ShapeRow {
  const char* key;   // its first key
  const char* keys;  // all of its keys
  Dims dims;
  bool (*has_value)(const RigidSpec&);
  Use radius, angle, rounding;
};

const std::array kShapeRows{
    ShapeRow{"half_plane", "half_plane", kNotLine, [](const RigidSpec& spec) { return !spec.half_plane.empty(); },
             Use::none, Use::none, Use::none},
    ShapeRow{"min", "min and max", kNotLine,
             [](const RigidSpec& spec) { return !spec.min.empty() || !spec.max.empty(); }, Use::none, Use::none,
             Use::may},
    ShapeRow{"polygon", "polygon", kPlane, [](const RigidSpec& spec) { return !spec.polygon.empty(); }, Use::none,
             Use::none, Use::may},
    ShapeRow{"disc", "disc", kPlane, [](const RigidSpec& spec) { return !spec.disc.empty(); }, Use::must, Use::none,
             Use::none},
    ShapeRow{"wedge", "wedge", kPlane, [](const RigidSpec& spec) { return !spec.wedge.empty(); }, Use::may, Use::must,
             Use::may},
    ShapeRow{"sphere", "sphere", kSpace, [](const RigidSpec& spec) { return !spec.sphere.empty(); }, Use::must,
             Use::none, Use::none},
    ShapeRow{"cylinder", "cylinder", kSpace, [](const RigidSpec& spec) { return !spec.cylinder.empty(); }, Use::must,
             Use::none, Use::may},
    ShapeRow{"cone", "cone", kSpace, [](const RigidSpec& spec) { return !spec.cone.empty(); }, Use::may, Use::must,
             Use::may},
    ShapeRow{"stl", "stl", kSpace, [](const RigidSpec& spec) { return !spec.stl.empty(); }, Use::none, Use::none,
             Use::none},
};

/// Why a rigid body of a scene of this many dimensions has no shape; empty if it has one.
std::string why_no_shape(const RigidSpec& spec, int dim, bool axisymmetric) {
  try {
    if (dim == 2) {
      rigid_shape<2>(spec, axisymmetric);
    } else {
      rigid_shape<3>(spec, axisymmetric);
    }
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

/// The checks of the shape of one rigid body.
class ShapeCheck {
 public:
  ShapeCheck(SceneCheck& check, std::size_t k)
      : check_(check), spec_(check.scene().rigid[k]), table_(fmt::format("rigid[{}]", k)) {}

  void run() {
    if (const ShapeRow* const row = shape(); row && keys_go_with(*row) && is_in_order(*row)) check_geometry(*row);
  }

 private:
  std::string key(const std::string& name) const { return table_ + "." + name; }
  int dim() const { return check_.scene().dim; }
  bool axisymmetric() const { return check_.scene().state == StressState::axisymmetric; }

  bool is_in_scene(const ShapeRow& row) const { return (row.dims & dims_of(dim())) != 0; }

  /// A key of another dimension was told to be unknown as the file was read; a program may have given it.
  bool is_given(const ShapeRow& row) const {
    if (!is_in_scene(row)) return row.has_value(spec_);
    return check_.given(key(row.key), row.has_value(spec_)) || (row.key == kBox && check_.written(key("max")));
  }

  /// The only shape; null with a report if there is none, or another one besides.
  const ShapeRow* shape() {
    const ShapeRow* found = nullptr;
    std::vector<std::string> known;
    for (const ShapeRow& row : kShapeRows) {
      if (is_in_scene(row)) known.emplace_back(row.keys);
      if (!is_given(row)) continue;
      const std::string name = check_.written(key(row.key)) || row.key != kBox ? row.key : "max";
      if (check_.wrong_if(!is_in_scene(row), key(name), "there is none in a scene with dim = {}", dim()))
        return nullptr;
      if (check_.wrong_if(found != nullptr, key(name), "does not go with {}; a rigid body has one shape",
                          found ? found->keys : ""))
        return nullptr;
      found = &row;
    }
    // What could not be read, or is misspelt, may have been the shape.
    check_.wrong_if(!found && check_.sound(table_), table_, "needs a shape: {}", either(known));
    return found;
  }

  /// The keys of the shapes that have a use for one, for a message.
  std::string users_of(Use ShapeRow::*use) const {
    std::vector<std::string> users;
    for (const ShapeRow& row : kShapeRows)
      if (row.*use != Use::none && is_in_scene(row)) users.emplace_back(row.keys);
    return either(users);
  }

  /// True if the shape has all keys that it needs, and no other.
  bool keys_go_with(const ShapeRow& row) {
    struct Size {
      const char *name, *with_article;
      Use ShapeRow::*use;
      double value;
    };
    bool right = true;
    for (const Size& size : {Size{"radius", "a radius", &ShapeRow::radius, spec_.radius},
                             {"angle", "an angle", &ShapeRow::angle, spec_.angle},
                             {"rounding", "a rounding", &ShapeRow::rounding, spec_.rounding}}) {
      const bool given = check_.given(key(size.name), size.value != 0);
      const bool missing =
          check_.wrong_if(!given && row.*size.use == Use::must, key(row.key), "needs {}", size.with_article);
      const bool unused = check_.wrong_if(given && row.*size.use == Use::none, key(size.name),
                                          "does not go with {}, but with {}", row.keys, users_of(size.use));
      right = right && !missing && !unused && check_.sound(key(size.name));
    }
    return right;
  }

  /// True if a position has a value for each coordinate; one from a file was counted as it was read.
  bool is_position(const std::string& path, const std::vector<double>& x) {
    return !check_.wrong_if(x.size() != static_cast<std::size_t>(dim()), path, "expected {} coordinates, found {}",
                            dim(), x.size());
  }

  bool are_positions(const std::string& path, const std::vector<std::vector<double>>& list) {
    for (std::size_t k = 0; k < list.size(); ++k)
      if (!is_position(fmt::format("{}[{}]", path, k), list[k])) return false;
    return true;
  }

  /// True if a list is a position and a direction.
  bool is_ray(const std::string& path, const std::vector<std::vector<double>>& list, const char* expected) {
    if (check_.wrong_if(list.size() != 2, path, "must be a position and a direction, {}, not {}", expected,
                        list.size()) ||
        !are_positions(path, list))
      return false;
    double square = 0;
    for (const double component : list[1]) square += component * component;
    return !check_.wrong_if(!(square > 0 && std::isfinite(square)), path + "[1]", "({}) is no direction",
                            fmt::join(list[1], ", "));
  }

  bool is_box() {
    bool right = true;
    for (const auto& [name, corner] : {std::pair("min", &spec_.min), {"max", &spec_.max}})
      right = !check_.wrong_if(!check_.given(key(name), !corner->empty()), table_,
                               "the key '{}' is missing: a box has min and max", name) &&
              check_.sound(key(name)) && is_position(key(name), *corner) && right;
    for (std::size_t axis = 0; right && axis < spec_.min.size(); ++axis)
      right = !check_.wrong_if(!(spec_.max[axis] > spec_.min[axis]), check_.axis_key(key("max"), axis),
                               "must be greater than {} = {}, not {}", check_.axis_key(key("min"), axis),
                               spec_.min[axis], spec_.max[axis]);
    return right;
  }

  bool is_polygon() {
    const std::size_t n = spec_.polygon.size();
    constexpr std::size_t most = 1000;  // that can be compared two by two
    return !check_.wrong_if(n < 3 || n > most, key("polygon"), "needs from 3 to {} corners, not {}", most, n) &&
           are_positions(key("polygon"), spec_.polygon);
  }

  /// True if the shape's own key can be made a shape of.
  bool is_in_order(const ShapeRow& row) {
    const std::string path = key(row.key);
    if (row.key == kBox) return is_box();
    if (!check_.sound(path)) return false;
    if (!spec_.half_plane.empty()) return is_ray(path, spec_.half_plane, "[point, normal]");
    if (!spec_.polygon.empty()) return is_polygon();
    if (!spec_.wedge.empty()) return is_ray(path, spec_.wedge, "[tip, direction]");
    if (!spec_.cone.empty()) return is_ray(path, spec_.cone, "[tip, direction]");
    if (!spec_.cylinder.empty())
      return check_.two_positions(path, spec_.cylinder) && are_positions(path, spec_.cylinder);
    if (!spec_.disc.empty() || !spec_.sphere.empty())
      return is_position(path, spec_.disc.empty() ? spec_.sphere : spec_.disc);
    // Triangles were checked as their file was read; else there is a list with nothing in it.
    check_.wrong_if(spec_.stl.empty(), path, "holds nothing");
    return false;
  }

  /// What the geometry refuses; it is the rounding's fault if there is such a shape with sharp edges.
  void check_geometry(const ShapeRow& row) {
    RigidSpec sharp = spec_;
    sharp.rounding = 0;
    const std::string why = why_no_shape(sharp, dim(), axisymmetric());
    if (check_.wrong_if(!why.empty(), key(row.key), "{}", why) || spec_.rounding == 0) return;
    const std::string why_not_rounded = why_no_shape(spec_, dim(), axisymmetric());
    check_.wrong_if(!why_not_rounded.empty(), key("rounding"), "{}", why_not_rounded);
  }

  static constexpr std::string_view kBox = "min";

  SceneCheck& check_;
  const RigidSpec& spec_;
  std::string table_;
};

}  // namespace

void check_rigid_shape(SceneCheck& check, std::size_t k) { ShapeCheck(check, k).run(); }

}  // namespace stillpoint
