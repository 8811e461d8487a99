// What there is at a time, as one stage follows another, and what a stage says of it that cannot be.
#pragma once

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "scene/controlled_loads.hpp"
#include "scene/input/scene_check.hpp"

namespace stillpoint {

/// The names of those that have one, now and later.
template <class Part>
std::vector<std::string> named(const std::vector<Part>& present, const std::vector<Part>& later) {
  std::vector<std::string> names;
  for (const auto* parts : {&present, &later})
    for (const Part& part : *parts)
      if (!part.name.empty()) names.push_back(part.name);
  return names;
}

/// The names of the bodies, rigid bodies, supports or loads that there are at a time, as one stage follows another.
class Presence {
 public:
  template <class Part>
  Presence(SceneCheck& check, const std::string& what, const std::vector<Part>& present, const std::vector<Part>& later)
      : check_(check), what_(what), all_(named(present, later)) {
    for (const Part& part : present) now_.insert(part.name);
    for (const Part& part : later) later_.insert(part.name);
  }

  /// Each of these looks at one name of a list.
  void begin(const std::string& key, const std::vector<std::string>& names, std::size_t k) {
    check_one(key, names, k, "{} {} comes twice", [&](const std::string& name) {
      const bool is_first = came_.insert(name).second;
      return now_.insert(name).second && is_first;
    });
  }
  void end(const std::string& key, const std::vector<std::string>& names, std::size_t k) {
    check_one(key, names, k, why_not_there(names[k]), [&](const std::string& name) { return now_.erase(name) > 0; });
  }
  void expect(const std::string& key, const std::vector<std::string>& names, std::size_t k) {
    check_one(key, names, k, why_not_there(names[k]), [&](const std::string& name) { return now_.contains(name); });
  }
  bool none_is_left() const { return now_.empty(); }
  const std::vector<std::string>& all() const { return all_; }
  bool knows(const std::string& name) const { return std::ranges::find(all_, name) != all_.end(); }

 private:
  const char* why_not_there(const std::string& name) const {
    if (!later_.contains(name) || came_.contains(name)) return "{} {} is not there then";
    return "{} {} comes with a later stage, and is not there before; what was taken away cannot come back, so that "
           "what comes needs a name of its own";
  }

  /// Reports a name that nothing has, and with this message one that is not in order.
  template <class IsInOrder>
  void check_one(const std::string& key, const std::vector<std::string>& names, std::size_t k, const char* message,
                 const IsInOrder& is_in_order) {
    const std::string one = fmt::format("{}[{}]", key, k);
    if (!knows(names[k])) {
      check_.add_unknown(one, what_, "[[" + what_ + "]] with a name", names[k], all_);
    } else if (!is_in_order(names[k])) {
      check_.add(one, fmt::format(fmt::runtime(message), what_, in_quotes(names[k])));
    }
  }

  SceneCheck& check_;
  std::string what_;
  std::vector<std::string> all_;
  std::set<std::string> now_, later_, came_;
};

/// The bodies and the rigid bodies that there are, which come and go by the same keys.
class BodyPresence {
 public:
  explicit BodyPresence(SceneCheck& check)
      : check_(check),
        bodies_(check, "body", check.scene().bodies, check.scene().later_bodies),
        rigid_(check, "rigid body", check.scene().rigid, check.scene().later_rigid) {}

  void end(const std::string& key, const std::vector<std::string>& names) {
    check_one_by_one(key, names, &Presence::end);
  }
  void begin(const std::string& key, const std::vector<std::string>& names) {
    check_one_by_one(key, names, &Presence::begin);
  }
  void expect(const std::string& key, const std::vector<std::string>& names) {
    for (std::size_t k = 0; k < names.size(); ++k) {
      const std::string one = fmt::format("{}[{}]", key, k);
      if (!check_.wrong_if(rigid_.knows(names[k]), one, "{} is a rigid body, which has no material",
                           in_quotes(names[k])))
        bodies_.expect(key, names, k);
    }
  }
  bool no_body_is_left() const { return bodies_.none_is_left(); }

 private:
  void check_one_by_one(const std::string& key, const std::vector<std::string>& names,
                        void (Presence::*check)(const std::string&, const std::vector<std::string>&, std::size_t)) {
    for (std::size_t k = 0; k < names.size(); ++k) {
      const bool is_rigid = rigid_.knows(names[k]);
      if (!check_.wrong_if(is_rigid && bodies_.knows(names[k]), fmt::format("{}[{}]", key, k),
                           "a body and a rigid body have the name {}; give each one of its own", in_quotes(names[k])))
        ((is_rigid ? rigid_ : bodies_).*check)(key, names, k);
    }
  }

  SceneCheck& check_;
  Presence bodies_, rigid_;
};

/// The supports and the loads that there are, which begin and end by the same keys.
class HeldPresence {
 public:
  explicit HeldPresence(SceneCheck& check)
      : check_(check),
        supports_(check, "support", check.scene().supports, check.scene().later_supports),
        tractions_(check, "load", check.scene().tractions, check.scene().later_tractions),
        forces_(check, "load", check.scene().forces, check.scene().later_forces) {}

  void end(const std::string& key, const std::vector<std::string>& names) {
    check_one_by_one(key, names, &Presence::end);
  }
  void begin(const std::string& key, const std::vector<std::string>& names) {
    check_one_by_one(key, names, &Presence::begin);
  }

 private:
  void check_one_by_one(const std::string& key, const std::vector<std::string>& names,
                        void (Presence::*check)(const std::string&, const std::vector<std::string>&, std::size_t)) {
    for (std::size_t k = 0; k < names.size(); ++k) {
      const std::string one = fmt::format("{}[{}]", key, k);
      Presence* const known = that_knows(names[k]);
      if (!known) {
        refuse_unknown(one, names[k]);
      } else if (!check_.wrong_if(drives(names[k]), one,
                                  "load {} is one of those that [load] drives, which begin together, by load.at; "
                                  "expected load.of without it",
                                  in_quotes(names[k]))) {
        (known->*check)(key, names, k);
      }
    }
  }
  Presence* that_knows(const std::string& name) {
    for (Presence* const one : {&supports_, &tractions_, &forces_})
      if (one->knows(name)) return one;
    return nullptr;
  }
  void refuse_unknown(const std::string& key, const std::string& name) {
    const Scene& scene = check_.scene();
    const bool is_body = std::ranges::count(scene.named_bodies, name) > 0,
               is_rigid =
                   std::ranges::find(scene.rigid_as_written, name, &RigidSpec::name) != scene.rigid_as_written.end();
    if (check_.wrong_if(!name.empty() && (is_body || is_rigid), key,
                        "{} is a {}, which add and remove name; here stand names of supports and loads",
                        in_quotes(name), is_body ? "body" : "rigid body"))
      return;
    std::vector<std::string> names;
    for (const Presence* const one : {&supports_, &tractions_, &forces_})
      names.insert(names.end(), one->all().begin(), one->all().end());
    check_.add_unknown(key, "support or load", "[[support]], [[traction]] or [[force]] with a name", name, names);
  }
  /// Whether [load] drives a load of this name.
  bool drives(const std::string& name) const {
    const Scene& scene = check_.scene();
    const auto any = [&](const auto& loads) {
      return std::ranges::any_of(
          loads, [&](const auto& load) { return load.name == name && is_driven(scene, name_of_load(load)); });
    };
    return any(scene.tractions) || any(scene.later_tractions) || any(scene.forces) || any(scene.later_forces);
  }

  SceneCheck& check_;
  Presence supports_, tractions_, forces_;
};

}  // namespace stillpoint
