#include "solvers/integrators/arkode_tables.hpp"

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <utility>

namespace stillpoint {
namespace {

// "ARKODE_HEUN_EULER_2_1_2" → "heun-euler-2-1-2"
std::string kebab_case(const std::string& name) {
  std::string result = name.substr(name.find('_') + 1);
  for (char& c : result) c = c == '_' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

ButcherTable from_arkode(const std::string& name, const ARKodeButcherTableMem& table) {
  const auto s = static_cast<std::size_t>(table.stages);
  ButcherTable result;
  result.name = name;
  result.stages = table.stages;
  result.order = table.q;
  result.embedded_order = table.p;
  for (std::size_t i = 0; i < s; ++i) result.A.insert(result.A.end(), table.A[i], table.A[i] + s);
  result.b.assign(table.b, table.b + s);
  result.c.assign(table.c, table.c + s);
  if (table.d && table.p > 0) result.b_embedded.assign(table.d, table.d + s);
  return result;
}

}  // namespace

std::vector<NamedTable> erk_tables() {
  std::vector<NamedTable> tables;
  const auto add = [&](ButcherTable table, const std::string& source) {
    const auto same_name = [&](const NamedTable& other) { return other.table.name == table.name; };
    if (std::ranges::none_of(tables, same_name)) tables.push_back({std::move(table), source});
  };
  for (int id = ARKODE_MIN_ERK_NUM; id <= ARKODE_MAX_ERK_NUM; ++id) {
    const std::string name = sundials::table_name(id);
    const ArkodeTable table(ARKodeButcherTable_LoadERK(static_cast<ARKODE_ERKTableID>(id)), ARKodeButcherTable_Free);
    if (!name.empty() && table) add(from_arkode(kebab_case(name), *table), "SUNDIALS' " + name);
  }
  add(classical_rk4(), "Kutta 1901");
  add(sofroniou_spaletta_5_3_4(), "Sofroniou and Spaletta 2004");
  ButcherTable jameson = jameson_5();
  jameson.name = "jameson-5-2";  // named stages-order, as the other tables are
  add(std::move(jameson), "Jameson, Schmidt and Turkel 1981");
  return tables;
}

ArkodeTable to_arkode(ButcherTable table) {
  double* embedding = table.b_embedded.empty() ? nullptr : table.b_embedded.data();
  return {ARKodeButcherTable_Create(table.stages, table.order, table.embedded_order, table.c.data(), table.A.data(),
                                    table.b.data(), embedding),
          ARKodeButcherTable_Free};
}

ButcherTable erk_table(const std::string& method) {
  for (NamedTable& named : erk_tables()) {
    if ("erk:" + named.table.name == method) return std::move(named.table);
  }
  throw std::invalid_argument("there is no method '" + method + "'");
}

}  // namespace stillpoint
