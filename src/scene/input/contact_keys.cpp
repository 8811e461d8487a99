// The tables of the rigid bodies that bodies touch, and of contact between bodies.
#include "scene/input/scene_keys.hpp"

namespace stillpoint {
namespace {

/// What a rigid body or a contact bears along the border.
template <class Spec>
void add_shear(Rows<Spec>& rows) {
  const auto friction = [](Spec& spec) -> double& { return spec.shear.friction; };
  const auto adhesion = [](Spec& spec) -> double& { return spec.shear.adhesion; };
  rows.key("friction", friction, "Coulomb's coefficient; rough: no slip", {.range = kNotNegative, .words = {"rough"}},
           [](Spec& spec) { spec.shear.friction = kInfinity; })
      .key("adhesion", adhesion, "shear stress that is borne besides, as long as there is a pressure",
           {.range = kNotNegative, .unit = "Pa"});
}

}  // namespace

[[gnu::no_sanitize_address]] void add_contact(Tables& tables) {
  constexpr Range below_half_turn{0, 180, false, false};
  auto rigid = tables.add({.path = "rigid",
                           .help = "a rigid body of one shape, at rest or moving, that pushes and never holds back",
                           .repeat = Repeat::array,
                           .dims = kNotLine},
                          &Scene::rigid);
  rigid.key("name", &RigidSpec::name, "for history.csv and summary.json", {.required = true})
      .key("half_plane", &RigidSpec::half_plane,
           "[point, normal]: a position on its border and a direction out of it; in space a half-space",
           {.unit = "m", .list = true})
      .key("min", &RigidSpec::min, "lower corner of a box", {.unit = "m"})
      .key("max", &RigidSpec::max, "upper corner", {.unit = "m"})
      .key("polygon", &RigidSpec::polygon, "corners in order", {.unit = "m", .list = true, .dims = kPlane})
      .key("disc", &RigidSpec::disc, "the centre of a disc", {.unit = "m", .dims = kPlane})
      .key("wedge", &RigidSpec::wedge, "[tip, direction]: where it begins and the way in which it widens",
           {.unit = "m", .list = true, .dims = kPlane})
      .key("sphere", &RigidSpec::sphere, "the centre of a sphere", {.unit = "m", .dims = kSpace})
      .key("cylinder", &RigidSpec::cylinder, "[from, to], the centres of a cylinder's ends",
           {.unit = "m", .list = true, .dims = kSpace})
      .key("cone", &RigidSpec::cone, "[tip, direction]: where it begins and the way in which it widens",
           {.unit = "m", .list = true, .dims = kSpace})
      .key("stl", &RigidSpec::stl, "STL file of a closed surface of triangles, in metres", {.dims = kSpace})
      .key("radius", &RigidSpec::radius,
           "of a disc, sphere or cylinder; a wedge or cone goes on as a shaft without end from where it is this far "
           "from its axis",
           {.range = kPositive, .unit = "m", .fallback = "needed by disc, sphere and cylinder; otherwise no shaft"})
      .key("angle", &RigidSpec::angle, "of a wedge or cone, from flank to flank",
           {.range = below_half_turn, .unit = "degrees", .fallback = "needed by both"})
      .key("rounding", &RigidSpec::rounding,
           "radius of the edges and corners of a box, polygon, wedge, cylinder or cone; its flat faces stay where they "
           "are",
           {.range = kNotNegative, .unit = "m"})
      .key("motion", &RigidSpec::motion, "displacement; in an axisymmetric scene along the axis alone",
           {.unit = "m", .variables = "t", .fallback = "0"})
      .key("rotation", &RigidSpec::rotation,
           "in the plane the angle, counter-clockwise; in space the rotation vector: the axis times the angle",
           {.unit = "rad", .variables = "t", .fallback = "0", .of_turn = true})
      .key("about", &RigidSpec::about,
           "position about which it turns and its moment is taken, and which its motion moves",
           {.unit = "m", .fallback = "the origin"})
      .key("free", &RigidSpec::free,
           "true: not moved by formulas, but to where its weight and its force balance what it touches; it does not "
           "turn")
      .key("mass", &RigidSpec::mass, "of a free one, for its weight by the body force",
           {.range = kNotNegative, .unit = "kg"})
      .key("force", &RigidSpec::force, "on a free one, components", {.unit = "N", .variables = "t", .fallback = "0"});
  add_shear(rigid);
  rigid.key("bodies", &RigidSpec::bodies, "names of the bodies that it touches", {.fallback = "all", .list = true});

  auto contact =
      tables.add({.path = "contact",
                  .help = "two bodies that push each other where they meet, and never hold back; others are bonded "
                          "where they meet",
                  .repeat = Repeat::array,
                  .dims = kNotLine},
                 &Scene::contacts);
  contact.key("bodies", &ContactSpec::bodies,
              "names of the two; contact is looked for along the border of the first, the shorter one if they differ",
              {.required = true, .list = true});
  add_shear(contact);
}

}  // namespace stillpoint
