#include <stillpoint/converge.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/atomic_file.hpp"
#include "base/json.hpp"

namespace stillpoint {
namespace {

std::string number_or_nothing(double value) { return std::isfinite(value) ? fmt::format("{:.17g}", value) : ""; }

// Columns that every study has, empty where it has no such error.
const std::vector<std::string> norms = {"u_l2", "u_max", "u_energy", "stress_l2"};

bool is_norm(const StudiedQuantity& quantity) { return std::ranges::find(norms, quantity.name) != norms.end(); }

std::string csv(const ConvergenceStudy& study) {
  std::string text = "level,h,points,step,evaluations,wall_s";
  for (const std::string& norm : norms) text += "," + norm;
  for (const StudiedQuantity& quantity : study.quantities)
    if (!is_norm(quantity)) text += "," + quantity.name;
  text += ",size,status\n";
  for (std::size_t k = 0; k < study.levels.size(); ++k) {
    const ConvergenceLevel& level = study.levels[k];
    text += fmt::format("{},{:.17g},{},{:.17g},{},{:.6g}", k + 1, level.h, level.points, level.step, level.evaluations,
                        level.wall_s);
    for (const std::string& norm : norms) {
      const auto found = std::ranges::find(study.quantities, norm, &StudiedQuantity::name);
      text += "," + (found == study.quantities.end() ? "" : number_or_nothing(found->values[k]));
    }
    for (const StudiedQuantity& quantity : study.quantities)
      if (!is_norm(quantity)) text += "," + number_or_nothing(quantity.values[k]);
    text += fmt::format(",{:.17g},{}\n", level.size, to_string(level.status));
  }
  return text;
}

Json numbers(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(number(value));
  return list;
}

std::string json(const ConvergenceStudy& study) {
  Json refined = Json::array(), levels = Json::array(), orders = Json::object(), quantities = Json::object(),
       sources = Json::array();
  for (const Refinement refinement : study.refined) refined.push_back(to_string(refinement));
  for (const ConvergenceLevel& level : study.levels) {
    levels.push_back({{"set", level.set},
                      {"size", number(level.size)},
                      {"h", number(level.h)},
                      {"step", number(level.step)},
                      {"points", level.points},
                      {"dofs", level.dofs},
                      {"evaluations", level.evaluations},
                      {"wall_s", number(level.wall_s)},
                      {"status", to_string(level.status)},
                      {"reason", level.reason}});
  }
  for (const StudiedQuantity& quantity : study.quantities) {
    quantities[quantity.name] = {{"values", numbers(quantity.values)},
                                 {"errors", numbers(quantity.errors)},
                                 {"extrapolated", number(quantity.extrapolated)}};
    if (!quantity.order) continue;
    orders[quantity.name] = {{"order", number(quantity.order->order)},
                             {"low", number(quantity.order->low)},
                             {"high", number(quantity.order->high)},
                             {"theory", number(quantity.theory)},
                             {"levels", {quantity.order->first + 1, quantity.order->last + 1}}};
  }
  for (const ErrorSource& source : study.sources)
    sources.push_back({{"name", source.name}, {"change", number(source.change)}});
  const Json whole = {{"scene", study.scene},
                      {"title", study.title},
                      {"refined", refined},
                      {"ratio", study.ratio},
                      {"reference", study.reference},
                      {"orders", orders},
                      {"dominant", study.sources.empty() ? Json(nullptr) : Json(study.sources.front().name)},
                      {"sources", sources},
                      {"sources_of", study.source_quantity},
                      {"levels", levels},
                      {"quantities", quantities},
                      {"notes", study.notes},
                      {"versions", versions_of_libraries()}};
  return whole.dump(1) + "\n";
}

}  // namespace

void write_study(const ConvergenceStudy& study, const std::filesystem::path& folder) {
  write_file(folder / "converge.csv", csv(study));
  write_file(folder / "converge.json", json(study));
}

}  // namespace stillpoint
