// The factor of safety of ground by strength reduction [Zienkiewicz, Humpheson and Lewis 1975; Griffiths and Lane
// 1999]: the largest F for which the body is at rest with c/F, tan φ/F, σ_t/F and ψ no larger than the reduced φ.
#pragma once

#include <stillpoint/scene.hpp>
#include <stillpoint/study_progress.hpp>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace stillpoint {

struct SafetyOptions {
  double from = 1, to = 3;  // the factors between which the answer is looked for, 0 < from < to
  double width = 0.01;      // of the bracket
  int threads = 0;          // 0: as many as OpenMP would take
  std::function<bool()> interrupted{};
  std::function<void(const StudyProgress&)> progress{};
  /// Describes the fault of the options; empty if there is none.
  std::string validate() const;
};

enum class SafetyVerdict {
  rests,     // an equilibrium was found
  moves,     // the residual stays what it is while the body moves on steadily
  undecided  // neither was seen
};
std::string to_string(SafetyVerdict verdict);

/// One factor. Each begins at the equilibrium that the body has with the first one.
struct SafetyTrial {
  double factor = 1;
  SafetyVerdict verdict = SafetyVerdict::undecided;
  std::string reason{};
  double displacement = 0;  // largest of a material point since that equilibrium [m]
  long evaluations = 0;     // of the internal force
  double wall_s = 0;
};

/// The material points at the first factor that moves, after the motion by which that was seen.
struct Mechanism {
  int dim = 2;
  double factor = 0;
  GridSpec grid{};
  std::vector<double> positions{};       // at the equilibrium that the trial began with, (P × dim) [m]
  std::vector<double> displacement{};    // since then, (P × dim) [m]
  std::vector<double> plastic_strain{};  // likewise, (P)
  std::vector<double> stress{};          // (P × stress components) [Pa]
};

struct SafetyStudy {
  std::string scene, title;
  std::string scene_text{};              // contents of the scene's file
  std::vector<std::string> overrides{};  // laid over it
  double width = 0.01;                   // that was asked for
  std::optional<double> factor_low{};    // the largest that rests
  std::optional<double> factor_high{};   // the least that moves, above factor_low; empty: none was found
  std::vector<SafetyTrial> trials{};     // in the order in which they were made
  std::optional<Mechanism> mechanism{};  // at factor_high
  std::vector<std::string> notes{};
  double wall_s = 0;
  bool interrupted = false;

  /// Whether the bracket is no wider than was asked.
  bool is_found() const;
};

/// Brackets the factor of safety. With each factor the body begins at its equilibrium under the strength of
/// options.from, in a single phase, and goes to rest by Newton's method or, if that finds no equilibrium, in a
/// critically damped motion. Throws SceneError if the scene does not come to an equilibrium with options.from, if its
/// loads still vary then, or if no material's strength has a name, and std::invalid_argument if an option is out of
/// range.
SafetyStudy safety(const Scene& scene, const SafetyOptions& options = {});

/// The text of safety.json.
std::string to_json(const SafetyStudy& study);
/// Writes safety.json, safety.csv and report.html into a folder.
void write_safety(const SafetyStudy& study, const std::filesystem::path& folder);

}  // namespace stillpoint
