// From a problem as it was asked for to a complete one.
#pragma once

#include <stillpoint/catalogue.hpp>
#include <stillpoint/problem.hpp>

#include <string>
#include <vector>

namespace stillpoint {

/// A fault of a file that a body names.
struct FileMistake {
  std::size_t body;
  std::string key;  // the key of the body that names the file: "stl"
  Mistake mistake;  // where.line 0: with the file as a whole
};

/// Makes each choice that is open, moves positions that miss a grid line, the grid or a body by a sliver onto it, and
/// cuts the boxes of bodies to what lies in them. Files that bodies name are read. What is not in order stays as it is,
/// for the checks to find; of files what is wrong is returned.
std::vector<FileMistake> resolve(Problem& problem, const Catalogue& catalogue);

}  // namespace stillpoint
