#include <stillpoint/converge.hpp>
#include <stillpoint/integrator.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <mutex>
#include <utility>

#include <fmt/format.h>

#include "base/stopwatch.hpp"
#include "scene/longest_cell.hpp"
#include "simulation/catalogue.hpp"
#include "study/error_sources.hpp"
#include "study/level_run.hpp"
#include "study/observed_order.hpp"
#include "study/refinement.hpp"
#include "study/side_by_side.hpp"

namespace stillpoint {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Runs that are independent, side by side; results do not depend on how many there are.
struct Job {
  std::vector<std::string> set;  // beside what the user has set
  std::string doing;
  LevelRun run{};
};

// ‖a − b‖/‖b‖ over the points with weights V_p, and by the largest components.
struct RelativeDifference {
  double l2 = none, max = none;
};
RelativeDifference difference(const std::vector<double>& a, const std::vector<double>& b,
                              const std::vector<double>& volume) {
  if (a.size() != b.size() || volume.empty()) return {};
  const std::size_t components = b.size() / volume.size();
  double squares = 0, all = 0, most = 0, largest = 0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    const double V = volume[i / components];
    squares += V * (a[i] - b[i]) * (a[i] - b[i]);
    all += V * b[i] * b[i];
    most = std::max(most, std::abs(a[i] - b[i]));
    largest = std::max(largest, std::abs(b[i]));
  }
  if (!(all > 0)) return {};
  return {std::sqrt(squares / all), most / largest};
}

class Converging {
 public:
  Converging(std::filesystem::path file, std::vector<std::string> overrides, const ConvergeOptions& options)
      : file_(std::move(file)), overrides_(std::move(overrides)), options_(options), scene_(load({})) {
    study_.scene = scene_.name;
    study_.title = scene_.title;
    study_.refined = options_.refine;
    study_.ratio = options_.ratio;
    for (int k = 0; k < options_.levels; ++k) {
      std::vector<std::string> set;
      for (const Refinement refinement : options_.refine)
        std::ranges::move(refined(scene_, refinement, std::pow(options_.ratio, k)), std::back_inserter(set));
      levels_.push_back({.set = std::move(set), .doing = fmt::format("level {}", k + 1)});
    }
  }

  ConvergenceStudy converge() {
    std::vector<Job> sources = source_jobs();
    total_ = levels_.size() + sources.size();
    run(levels_);
    gather_levels();
    run(sources);
    gather_quantities();
    gather_sources(sources);
    tell_of_orders();
    return std::move(study_);
  }

 private:
  Scene load(const std::vector<std::string>& more) const {
    std::vector<std::string> all = overrides_;
    all.insert(all.end(), more.begin(), more.end());
    return load_scene(file_, all);
  }

  // The finest first, which take longest.
  void run(std::vector<Job>& jobs) {
    side_by_side(options_.threads > 0 ? options_.threads : omp_get_max_threads(), jobs.size(), [&](std::size_t k) {
      Job& job = jobs[jobs.size() - 1 - k];
      if (!is_interrupted()) job.run = run_level(load(job.set), options_.interrupted);
      job.run.level.set = job.set;
      tell(job.doing);
    });
  }

  void gather_levels() {
    for (Job& job : levels_) {
      ConvergenceLevel& level = job.run.level;
      const Scene scene = load(job.set);
      level.h = longest_cell(scene.grid);
      level.size = size_of(scene, options_.refine.front(), level.step);
      study_.levels.push_back(level);
      sizes_.push_back(level.size);
      if (!job.run.is_there && !is_interrupted()) {
        study_.notes.push_back(fmt::format("level {} is left out, it ended as {}: {}", study_.levels.size(),
                                           to_string(level.status), level.reason));
      }
    }
    if (is_interrupted()) study_.notes.emplace_back("interrupted by the user before all runs were done");
    const LevelRun& finest = levels_.back().run;
    std::ranges::copy(finest.notes, std::back_inserter(study_.notes));
  }

  // --- what is studied ---

  bool has_same_points() const {
    return std::ranges::none_of(options_.refine,
                                [](Refinement r) { return r == Refinement::h || r == Refinement::points; });
  }

  // Of two values by their names; NaN where a level has none.
  static double value_of(const std::vector<std::pair<std::string, double>>& values, const std::string& name) {
    const auto found = std::ranges::find(values, name, &std::pair<std::string, double>::first);
    return found == values.end() ? none : found->second;
  }

  const LevelRun* first_there() const {
    const auto found = std::ranges::find_if(levels_, [](const Job& job) { return job.run.is_there; });
    return found == levels_.end() ? nullptr : &found->run;
  }

  // Where space is refined errors are measured against the exact solution; otherwise the finest level has the same
  // points, and the error of space, which all levels share, does not hide the one that is refined.
  void gather_quantities() {
    const LevelRun* any = first_there();
    if (!any) return;
    if (has_same_points()) {
      study_.reference = "the finest level";
      add_field("u_l2", &LevelRun::u, &RelativeDifference::l2);
      add_field("u_max", &LevelRun::u, &RelativeDifference::max);
      add_field("stress_l2", &LevelRun::stress, &RelativeDifference::l2);
    } else if (!any->norms.empty()) {
      study_.reference = "the exact solution";
      for (const auto& [name, value] : any->norms) add_norm(name);
      if (!any->no_energy.empty()) study_.notes.push_back("u_energy is not reported: " + any->no_energy);
    } else {
      study_.reference = "Richardson's extrapolation of the probes";
      study_.notes.emplace_back("the scene has no exact solution: only its probes are studied; expected [exact]");
    }
    for (std::size_t p = 0; p < any->probes.size(); ++p) add_probe(p, any->probes[p].first);
    if (study_.quantities.empty())
      study_.notes.emplace_back("there is nothing to study; expected [exact] or a [[probe]]");
  }

  void add_norm(const std::string& name) {
    StudiedQuantity norm{.name = name};
    for (const Job& job : levels_) norm.values.push_back(value_of(job.run.norms, name));
    norm.errors = norm.values;
    norm.order = observed_order(sizes_, norm.errors);
    norm.theory = theory(name);
    study_.quantities.push_back(std::move(norm));
  }

  void add_field(const char* name, std::vector<double> LevelRun::*field, double RelativeDifference::*norm) {
    const auto between = [&](std::size_t a, std::size_t b) {
      const LevelRun &one = levels_[a].run, &other = levels_[b].run;
      return a == b ? none : difference(one.*field, other.*field, other.volume).*norm;
    };
    StudiedQuantity quantity{.name = name};
    const std::size_t finest = levels_.size() - 1;
    std::vector<double> steps;  // from a level to the next
    for (std::size_t k = 0; k <= finest; ++k) {
      quantity.values.push_back(between(k, finest));
      steps.push_back(between(k, std::min(k + 1, finest)));
    }
    quantity.errors = quantity.values;
    quantity.order = observed_order(sizes_, steps);
    quantity.theory = theory(name);
    study_.quantities.push_back(std::move(quantity));
  }

  void add_probe(std::size_t index, const std::string& name) {
    StudiedQuantity probe{.name = name};
    std::vector<double> exact_errors;
    for (const Job& job : levels_) {
      probe.values.push_back(value_of(job.run.probes, name));
      exact_errors.push_back(index < job.run.probe_errors.size() ? job.run.probe_errors[index] : none);
    }
    const bool has_exact =
        !has_same_points() && std::ranges::any_of(exact_errors, [](double e) { return std::isfinite(e); });
    probe.order = observed_order(sizes_, has_exact ? exact_errors : differences(probe.values));
    const std::size_t n = probe.values.size();
    if (probe.order && probe.order->order > 0.2 && n > 1) {
      const double finest = extrapolated(probe.values[n - 2], probe.values[n - 1], options_.ratio, probe.order->order);
      if (std::isfinite(finest) && !has_exact) probe.extrapolated = finest;
    }
    for (std::size_t k = 0; k < n; ++k) {
      const double against_limit = probe.extrapolated ? std::abs(probe.values[k] - *probe.extrapolated) : none;
      probe.errors.push_back(has_exact ? exact_errors[k] : against_limit);
    }
    probe.theory = theory(name.substr(name.find('.') + 1));
    study_.quantities.push_back(std::move(probe));
  }

  // For smooth solutions; empty where none is known.
  std::optional<double> theory(const std::string& of) const {
    const bool of_stress = of.starts_with("stress") || of.starts_with("strain") || of == "u_energy";
    const bool of_u = of == "u_l2" || of == "u_max" || of == "u" || of.starts_with("u.");
    if (!of_stress && !of_u) return std::nullopt;
    const double degree = degree_of(scene_.grid.basis);
    if (options_.refine.front() == Refinement::h) return of_stress ? degree : degree + 1;
    const StrategyInfo* strategy = catalogue().strategy(scene_.damping.strategy);
    const bool smooth = is_transient(scene_) && strategy && !strategy->is_local && !strategy->is_relaxation &&
                        !scene_.phase.max_motion && !scene_.phase.max_strain;
    if (options_.refine.front() != Refinement::step || !smooth) return std::nullopt;
    return find_method(scene_.integrator.method, scene_.integrator.treatment).order;
  }

  // --- which error is the largest ---

  // At the finest level but one.
  std::vector<Job> source_jobs() const {
    std::vector<Job> jobs;
    if (!options_.finds_dominant || levels_.size() < 2) return jobs;
    const std::vector<std::string>& base = levels_[levels_.size() - 2].set;
    for (const RefinedSource& source : other_sources(load(base), options_.refine)) {
      Job job{.set = base, .doing = source.name};
      job.set.insert(job.set.end(), source.set.begin(), source.set.end());
      jobs.push_back(std::move(job));
    }
    return jobs;
  }

  // The figure that sources are told by: the error in u, or the first probe, or how far u itself moves.
  std::string figure_of_sources(const LevelRun& run) const {
    if (!has_same_points() && !run.norms.empty()) return run.norms.front().first;
    return run.probes.empty() ? "u" : run.probes.front().first;
  }

  static double change(const std::string& figure, const LevelRun& a, const LevelRun& b) {
    if (!a.is_there || !b.is_there) return none;
    if (figure == "u") return difference(a.u, b.u, b.volume).l2;
    const auto moved = [&](const auto& of_a, const auto& of_b) {
      return std::abs(value_of(of_a, figure) - value_of(of_b, figure));
    };
    const double of_norm = moved(a.norms, b.norms);
    return std::isfinite(of_norm) ? of_norm : moved(a.probes, b.probes);
  }

  void gather_sources(const std::vector<Job>& jobs) {
    if (jobs.empty() || !first_there()) return;
    const LevelRun &finest = levels_.back().run, &base = levels_[levels_.size() - 2].run;
    study_.source_quantity = figure_of_sources(finest);
    const auto add = [&](const std::string& name, const LevelRun& run) {
      const double by = change(study_.source_quantity, base, run);
      if (std::isfinite(by)) study_.sources.push_back({name, by});
    };
    add(source_of(options_.refine.front()), finest);
    for (const Job& job : jobs) add(job.doing, job.run);
    std::ranges::stable_sort(study_.sources, std::ranges::greater(), &ErrorSource::change);
  }

  void tell_of_orders() {
    constexpr double little = 0.1;
    for (const StudiedQuantity& quantity : study_.quantities) {
      if (!quantity.order || !quantity.theory) continue;
      const ObservedOrder& order = *quantity.order;
      const double most = std::isfinite(order.high) ? order.high : order.order;
      if (most >= *quantity.theory - little) continue;
      const bool other = !study_.sources.empty() && study_.sources.front().name != source_of(options_.refine.front());
      study_.notes.push_back(fmt::format(
          "{}: order {:.2f}, below the {:g} of smooth solutions: {}", quantity.name, order.order, *quantity.theory,
          other ? "the error of " + study_.sources.front().name + " is larger than that of what is refined"
                : "expected a smooth solution, whole cells, and points that integrate what the basis needs"));
    }
  }

  bool is_interrupted() const { return options_.interrupted && options_.interrupted(); }
  void tell(const std::string& what) {
    const std::scoped_lock lock(telling_);
    ++done_;
    if (options_.progress) options_.progress({done_, static_cast<int>(total_), what, wall_.seconds()});
  }

  std::filesystem::path file_;
  std::vector<std::string> overrides_;
  const ConvergeOptions& options_;
  Scene scene_;
  std::vector<Job> levels_;
  std::vector<double> sizes_;
  ConvergenceStudy study_;
  Stopwatch wall_;
  std::mutex telling_;
  int done_ = 0;
  std::size_t total_ = 0;
};

}  // namespace

ConvergenceStudy converge(const std::filesystem::path& scene, const std::vector<std::string>& overrides,
                          const ConvergeOptions& options) {
  return Converging(scene, overrides, options).converge();
}

}  // namespace stillpoint
