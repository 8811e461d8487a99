// What holds, pushes and moves the bodies of a scene.
#include <map>

#include <fmt/format.h>

#include "scene/input/schema_parts.hpp"

namespace stillpoint {
namespace {

Words<Face> faces(int dim) {
  Words<Face> words = {{"left", Face::left}, {"right", Face::right}};
  if (dim > 1) words.insert(words.end(), {{"bottom", Face::bottom}, {"top", Face::top}});
  return words;
}

/// Faces of the grid, each with the support or wall that stands there.
class TakenFaces {
 public:
  /// Reports the face of a table where something stands there already; owner: "support[0]".
  void take(TableReader& table, Face face, const std::string& owner) {
    const auto [before, free] = owners_.emplace(face, owner);
    if (!free) table.problem("face", fmt::format("{} stands on this face already", before->second));
  }

 private:
  std::map<Face, std::string> owners_;
};

void read_support(TableReader support, Scene& scene, TakenFaces& taken) {
  const std::string name = fmt::format("support[{}]", scene.supports.size());
  SupportSpec& spec = scene.supports.emplace_back();
  assign(spec.at, support.numbers("at", count_of_axes(scene)));
  assign(spec.face, support.choice("face", faces(scene.dim)));
  assign(spec.component, support.integer("component", 0, scene.dim - 1));
  assign(spec.roller, support.choice("kind", Words<bool>{{"fixed", false}, {"roller", true}}));
  assign(spec.motion, support.formula("u", "t"));
  if (spec.face) {
    spec.component = axis_of(*spec.face);
    taken.take(support, *spec.face, name);
  }

  if (support.has("at") && support.has("face")) support.problem("face", "give either at or face, not both");
  if (!support.has("at") && !support.has("face")) support.problem("", "give at, a place, or face, a side of the grid");
  if (!support.has("face") && support.has("kind"))
    support.problem("kind", "goes with a face; at a place, component says what is held");
  if (!support.has("at") && support.has("component"))
    support.problem("component", "goes with a place; on a face, u is the motion along its normal");
  support.report_unknown_keys();
}

void read_wall(TableReader wall, Scene& scene, TakenFaces& taken) {
  const std::string name = fmt::format("wall[{}]", scene.walls.size());
  WallSpec& spec = scene.walls.emplace_back();
  wall.require({"name", "face"});
  assign(spec.name, wall.name("name"));
  if (const auto face = wall.choice("face", faces(scene.dim))) {
    spec.face = *face;
    taken.take(wall, *face, name);
  }
  assign(spec.motion, wall.formula("motion", "t"));
  if (wall.is_word("friction", "rough")) {
    spec.friction = kInfinity;
  } else {
    assign(spec.friction, wall.number("friction", kNotNegative));
  }
  if (scene.dim == 1 && spec.friction > 0) wall.problem("friction", "there is none in one dimension");
  wall.report_unknown_keys();
}

void read_traction(TableReader traction, Scene& scene) {
  TractionSpec& spec = scene.tractions.emplace_back();
  traction.require({"face"});
  assign(spec.face, traction.choice("face", faces(scene.dim)));
  assign(spec.value, traction.formulas("value", count_of_axes(scene), "t"));
  assign(spec.pressure, traction.formula("pressure", "t"));
  if (traction.has("value") && traction.has("pressure"))
    traction.problem("pressure", "give either value, which keeps its direction, or pressure, which follows the face");
  if (traction.written() && !traction.has("value") && !traction.has("pressure"))
    traction.problem("", "give value, which keeps its direction, or pressure, which follows the face");
  traction.report_unknown_keys();
}

}  // namespace

void read_loads(TableReader& root, Scene& scene) {
  const std::size_t axes = count_of_axes(scene);
  TakenFaces taken;
  for (TableReader& support : root.tables("support")) read_support(std::move(support), scene, taken);
  for (TableReader& wall : root.tables("wall")) read_wall(std::move(wall), scene, taken);
  for (TableReader& force : root.tables("force")) {
    PointForceSpec& spec = scene.forces.emplace_back();
    force.require({"at", "value"});
    assign(spec.at, force.numbers("at", axes));
    assign(spec.value, force.formulas("value", axes, "t"));
    force.report_unknown_keys();
  }
  for (TableReader& traction : root.tables("traction")) read_traction(std::move(traction), scene);
  TableReader body_force = root.table("body_force");
  body_force.require({"value"});
  assign(scene.body_force, body_force.formulas("value", axes, coordinates(scene) + "t"));
  body_force.report_unknown_keys();
}

void read_fields(TableReader& root, Scene& scene) {
  const std::size_t axes = count_of_axes(scene);
  TableReader initial = root.table("initial");
  assign(scene.initial_u, initial.formulas("u", axes, coordinates(scene)));
  assign(scene.initial_v, initial.formulas("v", axes, coordinates(scene)));
  if (TableReader geostatic = initial.table("geostatic"); geostatic.written()) {
    GeostaticSpec& spec = scene.geostatic.emplace();
    geostatic.require({"K0", "surface"});
    assign(spec.K0, geostatic.number("K0", kPositive));
    assign(spec.surface, geostatic.number("surface"));
    geostatic.report_unknown_keys();
  }
  initial.report_unknown_keys();
  TableReader exact = root.table("exact");
  assign(scene.exact_u, exact.formulas("u", axes, coordinates(scene) + "t"));
  assign(scene.exact_stress, exact.formula("stress", coordinates(scene) + "t"));
  if (scene.dim > 1 && exact.has("stress")) {
    exact.problem("stress", "in one dimension only");
  } else if (exact.has("stress") && !exact.has("u")) {
    exact.problem("stress", "needs exact.u beside it");
  }
  exact.report_unknown_keys();
}

}  // namespace stillpoint
