#include "simulation/setup/ranks_refusal.hpp"

#include <string>

#include "scene/throw_scene_error.hpp"

namespace stillpoint {

void refuse_what_ranks_lack(const Problem& problem) {
  const auto refuse_if = [](bool lacking, const std::string& key, const std::string& what) {
    if (lacking) throw_scene_error(key, what + "; expected one copy of the command, with --threads");
  };
  refuse_if(!problem.own_load.empty(), "body_force.own", "loads of a program's own are not shared among ranks");
  refuse_if(problem.phase.ends() && problem.phase.quadrature == Quadrature::domains, "phase.quadrature",
            "domains are not shared among ranks yet: take \"points\"");
}

}  // namespace stillpoint
