#include <stillpoint/converge.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/atomic_file.hpp"
#include "base/json.hpp"
#include "output/report/report_page.hpp"
#include "study/csv_text.hpp"

namespace stillpoint {
namespace {

std::string number_or_nothing(double value) { return std::isfinite(value) ? fmt::format("{:.17g}", value) : ""; }

// The columns that every study has; a field is empty if the study has no such error.
const std::vector<std::string> norms = {"u_l2", "u_max", "u_energy", "stress_l2", "stress_read_l2"};

// The varied keys, from "key=value".
std::vector<std::string> keys_of(const ConvergenceStudy& study) {
  std::vector<std::string> keys;
  for (const std::string& set : study.varied) keys.push_back(set.substr(0, set.find('=')));
  return keys;
}
// The value of "key=value" as a field of a CSV file.
std::string value_field(const std::string& set) {
  const std::string value = set.substr(set.find('=') + 1);
  return value.find_first_of(",\"") == std::string::npos ? value : quoted(value);
}

std::string csv(const std::vector<ConvergenceStudy>& series) {
  std::string text;
  for (const std::string& key : keys_of(series.front())) text += key + ",";
  text += "level,h,points,step,evaluations,wall_s";
  std::vector<std::string> columns = norms;
  for (const ConvergenceStudy& study : series)
    for (const StudiedQuantity& quantity : study.quantities)
      if (std::ranges::find(columns, quantity.name) == columns.end()) columns.push_back(quantity.name);
  for (const std::string& column : columns) text += "," + column;
  text += ",size,status\n";
  for (const ConvergenceStudy& study : series) {
    for (std::size_t k = 0; k < study.levels.size(); ++k) {
      const ConvergenceLevel& level = study.levels[k];
      for (const std::string& set : study.varied) text += value_field(set) + ",";
      text += fmt::format("{},{:.17g},{},{:.17g},{},{:.6g}", k + 1, level.h, level.points, level.step,
                          level.evaluations, level.wall_s);
      for (const std::string& column : columns) {
        const auto found = std::ranges::find(study.quantities, column, &StudiedQuantity::name);
        text += "," + (found == study.quantities.end() ? "" : number_or_nothing(found->values[k]));
      }
      text += fmt::format(",{:.17g},{}\n", level.size, to_string(level.status));
    }
  }
  return text;
}

Json json(const ConvergenceStudy& study) {
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
  return {{"scene", study.scene},
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
          {"notes", study.notes}};
}

Json json(const std::vector<ConvergenceStudy>& series) {
  const ConvergenceStudy& first = series.front();
  Json whole = json(first);
  if (!first.varied.empty()) {
    Json all = Json::array();
    for (const ConvergenceStudy& study : series) {
      Json one = {{"set", study.varied}};
      one.update(json(study));
      all.push_back(std::move(one));
    }
    whole = {{"scene", first.scene},
             {"title", first.title},
             {"varied", keys_of(first)},
             {"refined", whole["refined"]},
             {"series", std::move(all)}};
  }
  whole["versions"] = versions_of_libraries();
  return whole;
}

}  // namespace

std::string to_json(const std::vector<ConvergenceStudy>& series) { return file_text(json(series)); }

void write_study(const ConvergenceStudy& study, const std::filesystem::path& folder) { write_studies({study}, folder); }

void write_studies(const std::vector<ConvergenceStudy>& series, const std::filesystem::path& folder) {
  const ConvergenceStudy& first = series.front();
  write_file(folder / "converge.csv", csv(series));
  const Json whole = json(series);
  write_file(folder / "converge.json", file_text(whole));
  const std::string page = report_page(
      first.title.empty() ? first.scene : first.title,
      {{"kind", "converge"}, {"study", whole}, {"scene", {{"text", first.scene_text}, {"set", first.overrides}}}});
  write_file(folder / report_name, page);
}

}  // namespace stillpoint
