// The explicit Butcher tables of the installed ARKODE, and the built-in ones that it does not have.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "linalg/sundials.hpp"
#include "solvers/integrators/butcher.hpp"

namespace stillpoint {

struct NamedTable {
  ButcherTable table;
  std::string source;  // who published it, or SUNDIALS' name
};
std::vector<NamedTable> erk_tables();

using ArkodeTable = std::unique_ptr<ARKodeButcherTableMem, decltype(&ARKodeButcherTable_Free)>;

/// A copy of the table in ARKODE's format.
ArkodeTable to_arkode(ButcherTable table);

/// The table of the method "erk:<name>". Throws std::invalid_argument if there is no table of that name.
ButcherTable erk_table(const std::string& method);

}  // namespace stillpoint
