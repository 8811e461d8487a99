// From a problem as it was asked for to a complete one.
#pragma once

#include <stillpoint/catalogue.hpp>
#include <stillpoint/problem.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace stillpoint {

/// A fault of a file that a body or a rigid body names.
struct FileMistake {
  enum class Owner { body, rigid };

  Owner owner;
  std::size_t number;          // of the body or of the rigid body
  std::string key;             // its key that names the file: "stl"
  std::filesystem::path file;  // the file
  Mistake mistake;             // where.line 0: with the file as a whole

  bool is_of_body(std::size_t k) const { return owner == Owner::body && number == k; }
};

/// Makes each choice that is open, moves positions that miss a grid line, the grid or a body by a sliver onto it, and
/// cuts the boxes of bodies to what lies in them. Files that bodies and rigid bodies name are read. What is not in
/// order stays as it is, for the checks to find; of files what is wrong is returned.
std::vector<FileMistake> resolve(Problem& problem, const Catalogue& catalogue);

// Its choices of [phase], in phase_choices.cpp:
/// The materials of the bodies, each once; without those whose law is not for this stress state.
std::vector<const MaterialSpec*> materials_in_use(const Problem& problem, const Catalogue& catalogue);
/// True if the law of one of these materials depends on the history.
bool any_remembers(const std::vector<const MaterialSpec*>& materials, const Catalogue& catalogue);
/// The reason why material points cannot stand for domains side by side; empty if they can.
std::string why_no_domains(const Problem& problem);
/// Makes the open choices of [phase]: the end of a phase, and the quantities that points take into the next.
void resolve_phases(Problem& problem, const Catalogue& catalogue);

}  // namespace stillpoint
