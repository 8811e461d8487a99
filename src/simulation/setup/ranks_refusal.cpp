#include "simulation/setup/ranks_refusal.hpp"

#include <string>

#include "scene/point_sums.hpp"
#include "scene/throw_scene_error.hpp"

namespace stillpoint {

void refuse_what_ranks_lack(const Problem& problem) {
  const auto refuse_if = [](bool lacking, const std::string& key, const std::string& what) {
    if (lacking) throw_scene_error(key, what + "; expected one copy of the command, with --threads");
  };
  refuse_if(!problem.own_load.empty(), "body_force.own", "loads of a program's own are not shared among ranks");
  refuse_if(problem.phase.ends() && problem.phase.quadrature == Quadrature::domains, "phase.quadrature",
            "domains are not shared among ranks yet: take \"points\"");
  refuse_if(means_over_splines(problem), "phase.dilatation",
            "means over splines are not shared among ranks yet: take \"cells\"");
  refuse_if(problem.phase.rest > 0, "phase.rest", "parts do not rest where ranks share the points yet");
  refuse_if(problem.checkpoint.wanted() && averages_dilatation(problem), "checkpoint",
            "means of points are not saved where ranks share these yet: leave out [checkpoint]");
}

}  // namespace stillpoint
