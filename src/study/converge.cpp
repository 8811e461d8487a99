#include <stillpoint/converge.hpp>
#include <stillpoint/integrator.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <mutex>
#include <utility>

#include <fmt/format.h>

#include "base/stopwatch.hpp"
#include "simulation/catalogue.hpp"
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

bool is_transient(const Scene& scene) { return !scene.solve.is_static() && !scene.stop.wants_equilibrium(); }

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
      level.h = longest_side(scene);
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
      add_fields();
    } else if (!any->norms.empty()) {
      study_.reference = "the exact solution";
      for (const auto& [name, value] : any->norms) add_norm(name);
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

  void add_fields() {
    const LevelRun& finest = levels_.back().run;
    const std::size_t n = levels_.size();
    StudiedQuantity l2{.name = "u_l2"}, max{.name = "u_max"}, stress{.name = "stress_l2"};
    std::vector<double> l2_steps(n, none), max_steps(n, none), stress_steps(n, none);  // from a level to the next
    for (std::size_t k = 0; k < n; ++k) {
      const LevelRun& run = levels_[k].run;
      const bool is_finest = k + 1 == n;
      const auto in_u = is_finest ? RelativeDifference{} : difference(run.u, finest.u, finest.volume);
      l2.values.push_back(in_u.l2);
      max.values.push_back(in_u.max);
      stress.values.push_back(is_finest ? none : difference(run.stress, finest.stress, finest.volume).l2);
      if (is_finest) break;
      const LevelRun& next = levels_[k + 1].run;
      const auto step = difference(run.u, next.u, next.volume);
      l2_steps[k] = step.l2;
      max_steps[k] = step.max;
      stress_steps[k] = difference(run.stress, next.stress, next.volume).l2;
    }
    const auto add = [&](StudiedQuantity& quantity, const std::vector<double>& steps) {
      quantity.errors = quantity.values;
      quantity.order = observed_order(sizes_, steps);
      quantity.theory = theory(quantity.name);
      study_.quantities.push_back(std::move(quantity));
    };
    add(l2, l2_steps);
    add(max, max_steps);
    add(stress, stress_steps);
  }

  void add_probe(std::size_t index, const std::string& name) {
    StudiedQuantity probe{.name = name};
    std::vector<double> exact_errors;
    for (const Job& job : levels_) {
      probe.values.push_back(value_of(job.run.probes, name));
      exact_errors.push_back(index < job.run.probe_errors.size() ? job.run.probe_errors[index] : none);
    }
    const bool has_exact = !has_same_points() && std::isfinite(exact_errors.back());
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

  // At the finest level but one, each thing alone made finer.
  std::vector<Job> source_jobs() const {
    std::vector<Job> jobs;
    if (!options_.finds_dominant || levels_.size() < 2) return jobs;
    const std::vector<std::string>& base = levels_[levels_.size() - 2].set;
    const Scene scene = load(base);
    const auto is_refined = [&](Refinement r) {
      return std::ranges::find(options_.refine, r) != options_.refine.end();
    };
    const auto add = [&](const char* name, const std::vector<std::string>& more) {
      Job job{.set = base, .doing = name};
      job.set.insert(job.set.end(), more.begin(), more.end());
      jobs.push_back(std::move(job));
    };
    const bool points_are_ours =
        std::ranges::all_of(scene.bodies, [](const BodySpec& body) { return body.file.empty(); });
    if (!is_refined(Refinement::h)) add("space", refined(scene, Refinement::h, 2));
    if (!is_refined(Refinement::points) && points_are_ours) add("quadrature", refined(scene, Refinement::points, 2));
    if (is_transient(scene) && !is_refined(Refinement::step) && !is_refined(Refinement::rtol)) {
      add("time", scene.integrator.rtol ? refined(scene, Refinement::rtol, 10) : refined(scene, Refinement::step, 2));
    }
    if (scene.phase.max_motion.value_or(0) > 0 && !is_refined(Refinement::motion))
      add("phases", refined(scene, Refinement::motion, 2));
    if (scene.stop.wants_equilibrium() && scene.stop.residual > 0) {
      constexpr double tighter = 100, tightest = 1e-12;
      const double residual = std::max(tightest, scene.stop.residual / tighter);
      add("the relaxation's stop", {fmt::format("stop.residual={:.3g}", residual)});
    }
    return jobs;
  }

  static std::string name_of_source(Refinement refinement) {
    switch (refinement) {
      case Refinement::h:
        return "space";
      case Refinement::points:
        return "quadrature";
      case Refinement::motion:
        return "phases";
      default:
        return "time";
    }
  }

  // A figure that both have: the error in u, or the first probe.
  double change(const LevelRun& a, const LevelRun& b) const {
    if (!a.is_there || !b.is_there) return none;
    if (!has_same_points() && !a.norms.empty() && !b.norms.empty())
      return std::abs(a.norms.front().second - b.norms.front().second);
    if (!a.probes.empty() && !b.probes.empty()) return std::abs(a.probes.front().second - b.probes.front().second);
    return a.u.size() == b.u.size() ? difference(a.u, b.u, b.volume).l2 : none;
  }

  void gather_sources(const std::vector<Job>& jobs) {
    if (jobs.empty() || !first_there()) return;
    const LevelRun &finest = levels_.back().run, &base = levels_[levels_.size() - 2].run;
    const auto add = [&](const std::string& name, double by) {
      if (std::isfinite(by)) study_.sources.push_back({name, by});
    };
    add(name_of_source(options_.refine.front()), change(base, finest));
    for (const Job& job : jobs) add(job.doing, change(base, job.run));
    std::ranges::stable_sort(study_.sources, std::ranges::greater(), &ErrorSource::change);
    if (!has_same_points() && !finest.norms.empty()) {
      study_.source_quantity = finest.norms.front().first;
    } else if (!finest.probes.empty()) {
      study_.source_quantity = finest.probes.front().first;
    } else {
      study_.source_quantity = "u";
    }
  }

  void tell_of_orders() {
    constexpr double little = 0.1;
    for (const StudiedQuantity& quantity : study_.quantities) {
      if (!quantity.order || !quantity.theory) continue;
      const ObservedOrder& order = *quantity.order;
      const double most = std::isfinite(order.high) ? order.high : order.order;
      if (most >= *quantity.theory - little) continue;
      const bool other =
          !study_.sources.empty() && study_.sources.front().name != name_of_source(options_.refine.front());
      study_.notes.push_back(fmt::format(
          "{}: order {:.2f}, below the {:g} of smooth solutions: {}", quantity.name, order.order, *quantity.theory,
          other
              ? "the error of " + study_.sources.front().name + " is larger than that of what is refined"
              : "expected a smooth solution, whole cells, points that integrate what the basis needs, and a probe on a "
                "material point of every level"));
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
