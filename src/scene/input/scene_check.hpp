// What the checks of a scene share: where problems go, and the boxes that places lie in.
#pragma once

#include <stillpoint/scene.hpp>

#include <optional>
#include <string>
#include <vector>

namespace stillpoint {

class SceneCheck {
 public:
  SceneCheck(Scene& scene, std::vector<Problem>& problems) : scene_(scene), problems_(problems) {}

  Scene& scene() { return scene_; }
  std::vector<Problem>& problems() { return problems_; }

  void add(const std::string& key, const std::string& message);
  bool written(const std::string& key) const { return scene_.where.contains(key); }

  /// The key of body k: "body.min", or "body[1].min" where there is an array of them.
  std::string body_key(std::size_t k, const std::string& key) const;
  /// The key of one coordinate of a place: "grid.max", in more dimensions "grid.max[1]".
  std::string axis_key(const std::string& key, std::size_t axis) const;

  /// A cell's length along an axis; 0 where the cells are not known.
  double cell_length(std::size_t axis) const;
  /// Moves a face that misses a grid line by a sliver of a cell onto it: points in the sliver would have next to no
  /// mass.
  void snap_to_grid(std::vector<double>& place) const;
  /// True where place lies in a box, after moving a place that misses it by a sliver onto its border.
  bool inside(std::vector<double>& place, const std::vector<double>& min, const std::vector<double>& max,
              const std::string& box, const std::string& key);

 private:
  Scene& scene_;
  std::vector<Problem>& problems_;
};

/// A share of a cell that is taken for none.
inline constexpr double kSliver = 1e-6;

/// The box around all bodies.
struct BodyBox {
  std::vector<double> min, max;
  std::string name;  // "body", or "bodies"
};

/// True where the grid is a box that can be divided into its cells.
bool check_grid(SceneCheck& check);
/// Bodies and their materials; the box around them where all of them are in order.
std::optional<BodyBox> check_bodies(SceneCheck& check, bool grid);
/// The number of material points where the bodies fill whole cells; 0 where that depends on the placement.
long known_points(SceneCheck& check);
/// Supports, walls, loads and initial stress.
void check_loads(SceneCheck& check, bool grid, const std::optional<BodyBox>& body);
/// When phases end, and what scenes of more than one phase can have.
void check_phases(SceneCheck& check);
/// What is written out.
void check_output(SceneCheck& check, const std::optional<BodyBox>& body);

/// A law whose stress depends on more than the deformation.
bool has_history(const MaterialSpec& material);
/// A law that is written for this state; true also where the law itself is not known.
bool has_state(const MaterialSpec& material, StressState state);

}  // namespace stillpoint
