// The part of a face that is held or loaded.
#pragma once

#include <string>

#include "scene/input/scene_check.hpp"
#include "scene/support_kind.hpp"

namespace stillpoint {

/// Of part k of a face along one of its axes: "support[0].from", in space "support[0].from[1]".
std::string end_key(const SceneCheck& check, const std::string& name, const char* end, std::size_t k);

/// The ends of a part of the face of a box from min to max: in order, and on it. True if they are.
bool check_interval(SceneCheck& check, const std::string& name, const FaceInterval& part, std::size_t k, double min,
                    double max, const char* box);

}  // namespace stillpoint
