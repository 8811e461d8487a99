// The tables of what holds and loads the bodies.
#include <functional>
#include <limits>
#include <vector>

#include "scene/input/scene_keys.hpp"

namespace stillpoint {

[[gnu::no_sanitize_address]] void add_boundary(Tables& tables) {
  const std::vector<Word> faces = {"left",           "right",          {"bottom", kNotLine}, {"top", kNotLine},
                                   {"back", kSpace}, {"front", kSpace}};
  tables.add({"support", "a prescribed displacement", Repeat::array}, &Scene::supports)
      .key("name", &SupportSpec::name, "for its reaction in history.csv and summary.json")
      .key("at", &SupportSpec::at, "position; or face", {.unit = "m"})
      .key("face", &SupportSpec::face, "of the grid; or at", {.words = faces})
      .key("from", &SupportSpec::from, "where the held part of the face begins, along it",
           {.unit = "m", .fallback = "the face's lower end", .on_face = true, .dims = kNotLine})
      .key("to", &SupportSpec::to, "where it ends",
           {.unit = "m", .fallback = "the face's upper end", .on_face = true, .dims = kNotLine})
      .key("component", &SupportSpec::component, "what is held and moves; r and z if there is an axis of symmetry",
           {.words = {"x", {"y", kNotLine}, {"z", kSpace}, {"r", kPlane, false}, {"z", kPlane, false}},
            .fallback = "0; on a face by kind"})
      .key("kind", &SupportSpec::roller, "on a face: a roller holds the normal component only",
           {.words = {"fixed", "roller"}})
      .key("u", &SupportSpec::motion,
           "displacement of the component; on a face by kind along its normal. It may vary along a face of a linear "
           "grid, or where a stiffness holds",
           {.unit = "m", .variables = "xt"})
      .key("stiffness", &SupportSpec::stiffness, "of a spring that holds instead: at a position N/m, on a face N/m3",
           {.range = kPositive, .fallback = "as stiff as a cell, where the basis has no value of its own"});

  tables.add({"wall", "a rigid wall that pushes and never holds back", Repeat::array}, &Scene::walls)
      .key("name", &WallSpec::name, "for grid.follow and history.csv", {.required = true})
      .key("face", &WallSpec::face, "of the grid", {.words = faces, .required = true})
      .key("motion", &WallSpec::motion, "displacement along the face's coordinate", {.unit = "m", .variables = "t"})
      .key("friction", &WallSpec::friction, "Coulomb's coefficient; rough: no slip",
           {.range = kNotNegative, .words = {"rough"}}, [](WallSpec& wall) { wall.friction = kInfinity; });

  add_contact(tables);

  tables.add({"force", "a force at a position of the material, with which it moves", Repeat::array}, &Scene::forces)
      .key("name", &PointForceSpec::name, "by which a [[stage]] begins (hold) and ends (release) it",
           {.fallback = "it acts all the time"})
      .key("at", &PointForceSpec::at, "position", {.unit = "m", .required = true})
      .key("value", &PointForceSpec::value, "components", {.unit = "N", .variables = "t", .required = true});

  tables.add({"traction", "a load on the border of a body, with which it moves", Repeat::array}, &Scene::tractions)
      .key("name", &TractionSpec::name, "by which a [[stage]] begins (hold) and ends (release) it",
           {.fallback = "it acts all the time"})
      .key("face", &TractionSpec::face, "of the body, if it is the only one and a box; or line, or surface",
           {.words = faces})
      .key("line", &TractionSpec::line,
           "[from, to], positions on one straight side of a box or of a polygon, or on the outline of a file's points; "
           "or face",
           {.unit = "m", .list = true, .dims = kPlane})
      .key(
          "surface", &TractionSpec::surface,
          "in space, of the only body that is no box: inside a hollow one; outside, of a cylinder or prism all around; "
          "the end where its axis begins; where it ends",
          {.words = {"inner", "outer", "start", "end"}, .dims = kSpace})
      .key("from", &TractionSpec::from, "where the loaded part of the face begins, along it",
           {.unit = "m", .fallback = "the face's lower end", .on_face = true, .dims = kSpace})
      .key("to", &TractionSpec::to, "where it ends",
           {.unit = "m", .fallback = "the face's upper end", .on_face = true, .dims = kSpace})
      .key("value", &TractionSpec::value,
           "per undeformed area; keeps its direction. x, y: where the material was before the motion",
           {.unit = "Pa", .variables = "xt"})
      .key("pressure", &TractionSpec::pressure, "or: per deformed area, along the normal; x, y likewise",
           {.unit = "Pa", .variables = "xt"});

  tables.add({"body_force", "a load on all bodies"}, std::identity())
      .key("value", &Scene::body_force, "per mass", {.unit = "m/s2", .variables = "xt"})
      .key("own", &Scene::own_load,
           "the name of a load that the program has added by add_load(), beside value or alone");

  tables.add({"load", "loads in one proportion, driven by a displacement to the limit load and beyond"}, &Scene::load)
      .key("displacement", &LoadSpec::displacement,
           "mean displacement along the loads, sum F u/sum |F|: how large a factor of the loads that takes is found",
           {.unit = "m", .variables = "t", .required = true})
      .key("of", &LoadSpec::of, "\"traction[0]\", \"force[1]\", \"body_force\": those that are driven",
           {.fallback = "all loads", .list = true})
      .key("at", &LoadSpec::at, "the time of the stage with which it begins; before, what it drives does not act",
           {.range = kNotNegative, .unit = "s"});
}

}  // namespace stillpoint
