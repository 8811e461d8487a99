#include <stillpoint/safety.hpp>

#include <fmt/format.h>

#include "base/atomic_file.hpp"
#include "base/json.hpp"
#include "output/report/body_picture.hpp"
#include "output/report/report_page.hpp"
#include "study/csv_text.hpp"

namespace stillpoint {
namespace {

std::string csv(const SafetyStudy& study) {
  std::string text = "factor,verdict,displacement,evaluations,wall_s,reason\n";
  for (const SafetyTrial& trial : study.trials)
    text += fmt::format("{:.17g},{},{:.17g},{},{:.6g},{}\n", trial.factor, to_string(trial.verdict), trial.displacement,
                        trial.evaluations, trial.wall_s, quoted(trial.reason));
  return text;
}

Json json(const SafetyStudy& study) {
  Json verdicts = Json::array();
  for (const SafetyTrial& trial : study.trials)
    verdicts.push_back({{"factor", number(trial.factor)},
                        {"verdict", to_string(trial.verdict)},
                        {"reason", trial.reason},
                        {"displacement", number(trial.displacement)},
                        {"evaluations", trial.evaluations},
                        {"wall_s", number(trial.wall_s)}});
  return {{"scene", study.scene},
          {"title", study.title},
          {"factor_low", number(study.factor_low)},
          {"factor_high", number(study.factor_high)},
          {"width", study.width},
          {"found", study.is_found()},
          {"verdicts", verdicts},
          {"wall_s", number(study.wall_s)},
          {"notes", study.notes},
          {"versions", versions_of_libraries()}};
}

Json json(const Mechanism& m) {
  std::vector<double> positions = m.positions;
  for (std::size_t i = 0; i < positions.size(); ++i) positions[i] += m.displacement[i];
  const BodyMoment moment{.dim = m.dim,
                          .points = m.plastic_strain.size(),
                          .history_names = {"plastic_strain"},
                          .field = [&](const std::string& name) {
                            return name == "position"         ? positions
                                   : name == "u"              ? m.displacement
                                   : name == "stress"         ? m.stress
                                   : name == "plastic_strain" ? m.plastic_strain
                                                              : std::vector<double>(positions.size());
                          }};
  BodyPicture picture(m.grid, moment, 1, {positions});
  picture.add(moment);
  return {{"factor", m.factor}, {"picture", picture.json()}};
}

}  // namespace

std::string to_json(const SafetyStudy& study) { return file_text(json(study)); }

void write_safety(const SafetyStudy& study, const std::filesystem::path& folder) {
  write_file(folder / "safety.csv", csv(study));
  const Json whole = json(study);
  write_file(folder / "safety.json", file_text(whole));
  const std::string page = report_page(study.title.empty() ? study.scene : study.title,
                                       {{"kind", "safety"},
                                        {"study", whole},
                                        {"mechanism", study.mechanism ? json(*study.mechanism) : Json(nullptr)},
                                        {"scene", {{"text", study.scene_text}, {"set", study.overrides}}}});
  write_file(folder / report_name, page);
}

}  // namespace stillpoint
