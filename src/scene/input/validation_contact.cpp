// Checks of what touches: the bodies that rigid bodies and contacts name, and what contact does not go with.
#include <algorithm>

#include <fmt/format.h>

#include "base/text.hpp"
#include "scene/input/scene_check.hpp"

namespace stillpoint {
namespace {

void check_contact(SceneCheck& check, std::size_t k) {
  const std::vector<ContactSpec>& contacts = check.scene().contacts;
  const std::string key = fmt::format("contact[{}].bodies", k);
  if (!check.sound(fmt::format("contact[{}]", k)) || !check.sound(key)) return;
  const std::vector<std::string>& bodies = contacts[k].bodies;
  if (check.wrong_if(bodies.size() != 2, key, "must be two bodies, not {}", bodies.size())) return;
  check_body_names(check, key, bodies);
  const auto here = contacts.begin() + static_cast<std::ptrdiff_t>(k);
  const auto before = std::find_if(contacts.begin(), here, [&](const ContactSpec& other) {
    return other.bodies.size() == 2 && std::ranges::is_permutation(other.bodies, bodies);
  });
  check.wrong_if(before != here, key, "{} and {} have a contact already", in_quotes(bodies[0]), in_quotes(bodies[1]));
}

bool is_touched(const Scene& scene, const std::string& body) {
  return std::ranges::any_of(scene.rigid, [&](const RigidSpec& rigid) { return rigid.touches(body); }) ||
         std::ranges::any_of(scene.contacts,
                             [&](const ContactSpec& contact) { return std::ranges::count(contact.bodies, body) > 0; });
}

template <class Spec>
void check_shear(SceneCheck& check, const char* kind, const std::vector<Spec>& specs) {
  for (std::size_t k = 0; k < specs.size(); ++k)
    check.wrong_if(specs[k].shear.adhesion > 0 && !specs[k].shear.ends(), fmt::format("{}[{}].adhesion", kind, k),
                   "adds nothing to friction = \"rough\", which has no limit; leave out one of the two");
}

/// What contact does not go with.
void check_company(SceneCheck& check) {
  const Scene& scene = check.scene();
  check.wrong_if(scene.mass.kind == MassKind::multigrid, "mass.kind",
                 "'multigrid' does not know the stiffness of contact yet; take \"lumped\"");
  check.wrong_if(scene.grid.basis == BasisKind::hermite && scene.dim == 2, "grid.basis",
                 "'hermite' has slopes as unknowns, which no contact acts on yet; take linear, quadratic or cubic");
  // Where they would be touched is not known.
  for (std::size_t k = 0; k < scene.bodies.size(); ++k)
    check.wrong_if(scene.dim == 3 && !scene.bodies[k].file.empty() && is_touched(scene, scene.bodies[k].name),
                   check.body_key(k, "file"),
                   "points in space have no surface that could be touched; take a shape, or leave this body out of "
                   "'bodies'");
  check.wrong_if(scene.load.has_value(), "load",
                 "a displacement that drives loads and contact cannot be had together yet; move rigid bodies or "
                 "supports, or give the loads as formulas of t");
}

}  // namespace

void check_body_names(SceneCheck& check, const std::string& key, const std::vector<std::string>& bodies) {
  std::vector<std::string> names = check.scene().named_bodies;  // of all stages
  for (const BodySpec& body : check.scene().bodies)
    if (!body.name.empty() && !check.scene().phase.at_stages) names.push_back(body.name);
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const std::string one = fmt::format("{}[{}]", key, k), &name = bodies[k];
    const auto here = bodies.begin() + static_cast<std::ptrdiff_t>(k);
    if (check.wrong_if(std::find(bodies.begin(), here, name) != here, one, "{} is there already", in_quotes(name)) ||
        check.wrong_if(names.empty(), one, "no body has a name; give one of them name = {}", in_quotes(name)))
      continue;
    if (std::ranges::find(names, name) == names.end()) check.add_unknown(one, "body", "[[body]]", name, names);
  }
}

void check_contacts(SceneCheck& check) {
  const Scene& scene = check.scene();
  if (!scene.may_touch()) return;
  if (!scene.contacts.empty() &&
      check.wrong_if(scene.dim == 1, "contact[0]", "there is none in a scene with dim = {}", scene.dim))
    return;
  for (std::size_t k = 0; k < scene.contacts.size(); ++k) check_contact(check, k);
  check_shear(check, "rigid", scene.rigid);
  check_shear(check, "contact", scene.contacts);
  if (scene.dim > 1) check_company(check);
}

}  // namespace stillpoint
