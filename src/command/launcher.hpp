// Launchers of MPI, which start copies of a program side by side.
#pragma once

namespace stillpoint::command {

/// True, with a message on standard error by the first of them, if a launcher has started several copies of this
/// program: a run is one process, and all would write into the same folder.
bool refuses_copies();

}  // namespace stillpoint::command
