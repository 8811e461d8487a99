// The stages of a problem. A problem is always that of one stage: its bodies, supports and materials are those that
// there are in it, and what later stages bring stands aside.
#pragma once

#include <stillpoint/scene.hpp>

#include <map>
#include <string>

namespace stillpoint {

/// Locations of keys in a scene file, as in Scene::where; the keys of what stands aside begin with "later_".
using Locations = std::map<std::string, Location>;

/// Numbers the bodies, rigid bodies, supports and loads of a problem as it was written, and sets aside those that
/// stages add or hold, and a [load] that begins with one. Only numbers them without stages; does nothing if that was
/// done before. A stage from t = 0 on becomes the present one. where: follows these numbers.
void set_later_parts_aside(Problem& problem, Locations& where);

/// When the present stage ends, at the earliest; 0: the run has one stage and no end [s].
double end_of_stage(const Problem& problem);
/// Chooses the ramps of stages that are open.
void resolve_stages(Problem& problem);

/// Turns a scene into that of its next stage, not resolved yet: bodies that stay keep their order, those that are added
/// follow them. There has to be one.
void begin_next_stage(Scene& scene);

/// The bodies of all stages that are yet to come, and of the present one.
std::vector<BodySpec> bodies_of_all_stages(const Problem& problem);

}  // namespace stillpoint
