// Launchers of MPI, which start copies of a program side by side.
#pragma once

namespace stillpoint::command {

/// The copies of this program that a launcher has started.
struct Copies {
  const char *launcher = "", *size = "";  // its name, and the variable by which it tells their number
  int count = 1;
  int rank = 0;  // of this one, from 0
};
Copies launched_copies();

/// True, with a message on standard error by the first of them, if there are several copies: all would write into the
/// same folder. instead: what to take, "one copy, whose --threads …".
bool refuses(const Copies& copies, const char* instead);

}  // namespace stillpoint::command
