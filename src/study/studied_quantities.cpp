#include <stillpoint/integrator.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "plan/catalogue.hpp"
#include "study/level_run.hpp"
#include "study/observed_order.hpp"
#include "study/refinement.hpp"

namespace stillpoint {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// ‖a − b‖/‖b‖ over the points, or places, with weights V_p, and the ratio of their largest components; entries that are
// NaN in a or b are left out.
struct RelativeDifference {
  double l2 = none, max = none;
};
RelativeDifference difference(const std::vector<double>& a, const std::vector<double>& b,
                              const std::vector<double>& volume) {
  if (a.size() != b.size() || volume.empty()) return {};
  const std::size_t components = b.size() / volume.size();
  double squares = 0, all = 0, most = 0, largest = 0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (std::isnan(a[i]) || std::isnan(b[i])) continue;
    const double V = volume[i / components];
    squares += V * (a[i] - b[i]) * (a[i] - b[i]);
    all += V * b[i] * b[i];
    most = std::max(most, std::abs(a[i] - b[i]));
    largest = std::max(largest, std::abs(b[i]));
  }
  if (!(all > 0)) return {};
  return {std::sqrt(squares / all), most / largest};
}

// The value of this name; NaN if a level has none.
double value_of(const std::vector<std::pair<std::string, double>>& values, const std::string& name) {
  const auto found = std::ranges::find(values, name, &std::pair<std::string, double>::first);
  return found == values.end() ? none : found->second;
}

class Gathering {
 public:
  Gathering(const Problem& problem, const std::vector<LevelRun>& runs, ConvergenceStudy& study)
      : problem_(problem), runs_(runs), study_(study), same_points_(has_same_points(study.refined)) {
    for (const ConvergenceLevel& level : study.levels) sizes_.push_back(level.size);
  }

  // If space is refined, errors are measured relative to the exact solution. Otherwise the finest level has the same
  // points and is the reference, so that the error of space, which all levels share, does not hide the refined one.
  void gather() {
    const auto any = std::ranges::find_if(runs_, &LevelRun::is_there);
    if (any == runs_.end()) return;
    if (same_points_) {
      study_.reference = "the finest level";
      add_fields();
    } else if (!any->norms.empty()) {
      study_.reference = "the exact solution";
      for (const auto& [name, value] : any->norms) add_norm(name);
      if (!any->no_energy.empty()) study_.notes.push_back("u_energy is not reported: " + any->no_energy);
    } else {
      add_against_finest(*any);
    }
    for (std::size_t p = 0; p < any->probes.size(); ++p) add_probe(p, any->probes[p].first);
    if (study_.quantities.empty())
      study_.notes.emplace_back("there is nothing to study; expected [exact], a [[probe]] or [load]");
  }

 private:
  void add_fields() {
    add_field("u_l2", &LevelRun::u, &RelativeDifference::l2);
    add_field("u_max", &LevelRun::u, &RelativeDifference::max);
    add_field("stress_l2", &LevelRun::stress, &RelativeDifference::l2);
  }

  void add_against_finest(const LevelRun& any) {
    constexpr const char* probes = "Richardson's extrapolation of single figures";
    if (any.u.empty()) {
      study_.reference = probes;
      study_.notes.push_back(fmt::format(
          "only single figures are studied: {}",
          !problem_.exact.known() ? "there is no exact solution, and later phases know no place of the start at which "
                                    "levels could be compared; expected a single phase"
                                  : "the exact displacement vanishes; expected another moment, stop.time"));
      return;
    }
    study_.reference = fmt::format("the finest level, and {}", probes);
    study_.notes.emplace_back(
        "the scene has no exact solution: u and stress, read as probes read them, are compared with the finest level's "
        "at the same places; expected [exact] for errors");
    add_fields();
  }

  void add_norm(const std::string& name) {
    StudiedQuantity norm{.name = name};
    for (const LevelRun& run : runs_) norm.values.push_back(value_of(run.norms, name));
    norm.errors = norm.values;
    norm.order = order_of(name, norm.errors, floors(1));
    norm.theory = theory(name);
    study_.quantities.push_back(std::move(norm));
  }

  void add_field(const char* name, std::vector<double> LevelRun::*field, double RelativeDifference::*norm) {
    const auto between = [&](std::size_t a, std::size_t b) {
      const LevelRun &one = runs_[a], &other = runs_[b];
      return a == b ? none : difference(one.*field, other.*field, other.volume).*norm;
    };
    StudiedQuantity quantity{.name = name};
    const std::size_t finest = runs_.size() - 1;
    std::vector<double> steps;  // changes from a level to the next
    for (std::size_t k = 0; k <= finest; ++k) {
      quantity.values.push_back(between(k, finest));
      steps.push_back(between(k, std::min(k + 1, finest)));
    }
    quantity.errors = quantity.values;
    quantity.order = order_of(name, steps, floors_of_steps(1));
    quantity.theory = theory(name);
    study_.quantities.push_back(std::move(quantity));
  }

  void add_probe(std::size_t index, const std::string& name) {
    StudiedQuantity probe{.name = name};
    std::vector<double> exact_errors;
    for (const LevelRun& run : runs_) {
      probe.values.push_back(value_of(run.probes, name));
      exact_errors.push_back(index < run.probe_errors.size() ? run.probe_errors[index] : none);
    }
    const bool has_exact =
        !same_points_ && std::ranges::any_of(exact_errors, [](double e) { return std::isfinite(e); });
    const double size = size_of_probe(name);
    probe.order = has_exact ? order_of(name, exact_errors, floors(size))
                            : order_of(name, differences(probe.values), floors_of_steps(size));
    const std::size_t n = probe.values.size();
    if (probe.order && probe.order->order > 0.2 && n > 1) {
      const double finest = extrapolated(probe.values[n - 2], probe.values[n - 1], study_.ratio, probe.order->order);
      if (std::isfinite(finest) && !has_exact) probe.extrapolated = finest;
    }
    for (std::size_t k = 0; k < n; ++k) {
      const double against_limit = probe.extrapolated ? std::abs(probe.values[k] - *probe.extrapolated) : none;
      probe.errors.push_back(has_exact ? exact_errors[k] : against_limit);
    }
    probe.theory = theory(name.substr(name.find('.') + 1));
    study_.quantities.push_back(std::move(probe));
  }

  // The part of a quantity's error that is not due to the level; size: that of the quantity.
  std::vector<double> floors(double size) const {
    std::vector<double> of_levels;
    for (const LevelRun& run : runs_) of_levels.push_back(run.floor * size);
    return of_levels;
  }
  // The same floors for changes from a level to the next.
  std::vector<double> floors_of_steps(double size) const {
    std::vector<double> of_steps = floors(size);
    for (std::size_t k = 0; k + 1 < of_steps.size(); ++k) of_steps[k] = std::max(of_steps[k], of_steps[k + 1]);
    return of_steps;
  }

  // The largest magnitude over all components of the probed field, as one of them may vanish.
  double size_of_probe(const std::string& name) const {
    const std::size_t last = name.rfind('.');
    const std::string field = last > name.find('.') ? name.substr(0, last + 1) : name;
    double size = 0;
    for (const LevelRun& run : runs_)
      for (const auto& [other, value] : run.probes)
        if (other.starts_with(field) && std::isfinite(value)) size = std::max(size, std::abs(value));
    return size;
  }

  std::optional<ObservedOrder> order_of(const std::string& name, const std::vector<double>& errors,
                                        const std::vector<double>& floors) {
    std::vector<std::size_t> at_floor;
    double floor = 0;
    for (std::size_t k = 0; k < errors.size(); ++k) {
      if (!(errors[k] <= floors[k]) || errors[k] == 0) continue;
      at_floor.push_back(k + 1);
      floor = std::max(floor, floors[k]);
    }
    const std::optional<ObservedOrder> order = observed_order(sizes_, errors, floors);
    if (!at_floor.empty())
      study_.notes.push_back(fmt::format(
          "{}: {} {} {} left out of its order, as {} are no more than the {:.1e} that rounding and the solver's stop "
          "leave{}",
          name, at_floor.size() > 1 ? "levels" : "level", fmt::join(at_floor, ", "), at_floor.size() > 1 ? "are" : "is",
          at_floor.size() > 1 ? "errors" : "its errors", floor,
          order ? "" : "; nothing is left of which there is one"));
    return order;
  }

  // The theoretical order for smooth solutions; empty if none is known.
  std::optional<double> theory(const std::string& of) const {
    const bool of_stress = of.starts_with("stress") || of.starts_with("strain") || of == "u_energy";
    const bool of_u = of == "u_l2" || of == "u_max" || of == "u" || of.starts_with("u.");
    if (!of_stress && !of_u) return std::nullopt;
    const double degree = degree_of(problem_.grid.basis);
    if (study_.refined.front() == Refinement::h) return of_stress ? degree : degree + 1;
    const StrategyInfo* strategy = catalogue().strategy(problem_.damping.strategy);
    const bool smooth =
        is_transient(problem_) && strategy && !strategy->is_local && !strategy->is_relaxation && !problem_.phase.ends();
    if (study_.refined.front() != Refinement::step || !smooth) return std::nullopt;
    return find_method(problem_.integrator.method, problem_.integrator.treatment).order;
  }

  const Problem& problem_;
  const std::vector<LevelRun>& runs_;
  ConvergenceStudy& study_;
  bool same_points_;
  std::vector<double> sizes_;
};

}  // namespace

bool has_same_points(const std::vector<Refinement>& refine) {
  return std::ranges::none_of(refine, [](Refinement r) { return r == Refinement::h || r == Refinement::points; });
}

void gather_quantities(const Problem& problem, const std::vector<LevelRun>& runs, ConvergenceStudy& study) {
  Gathering(problem, runs, study).gather();
}

std::string figure_of_sources(const std::vector<Refinement>& refine, const LevelRun& run) {
  if (!has_same_points(refine) && !run.norms.empty()) return run.norms.front().first;
  return run.probes.empty() ? "u" : run.probes.front().first;
}

double change(const std::string& figure, const LevelRun& a, const LevelRun& b) {
  if (!a.is_there || !b.is_there) return none;
  if (figure == "u") return difference(a.u, b.u, b.volume).l2;
  const auto moved = [&](const auto& of_a, const auto& of_b) {
    return std::abs(value_of(of_a, figure) - value_of(of_b, figure));
  };
  const double of_norm = moved(a.norms, b.norms);
  return std::isfinite(of_norm) ? of_norm : moved(a.probes, b.probes);
}

}  // namespace stillpoint
