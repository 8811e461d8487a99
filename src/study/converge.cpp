#include <stillpoint/converge.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <mutex>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/stopwatch.hpp"
#include "scene/longest_cell.hpp"
#include "study/common_places.hpp"
#include "study/error_sources.hpp"
#include "study/level_run.hpp"
#include "study/refinement.hpp"
#include "study/side_by_side.hpp"
#include "study/studied_quantities.hpp"

namespace stillpoint {
namespace {

/// Runs that are independent, side by side; results do not depend on how many there are.
struct Job {
  std::vector<std::string> set;  // beside what the user has set
  std::string doing;
  LevelRun run{};
};

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
    choose_places();
  }

  ConvergenceStudy converge() {
    std::vector<Job> sources = source_jobs();
    total_ = levels_.size() + sources.size();
    run(levels_);
    gather_levels();
    run(sources);
    std::vector<LevelRun> runs;
    for (const Job& job : levels_) runs.push_back(job.run);
    gather_quantities(scene_, runs, study_);
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

  // In the cells of the finest level, if they are not too many to read.
  void choose_places() {
    if (has_same_points(options_.refine) || !scene_.exact_u.empty()) return;
    constexpr double most = 2e5;
    for (auto level = levels_.rbegin(); level != levels_.rend() && !places_; ++level)
      if (const Scene scene = load(level->set); count_of_places(scene) <= most) places_ = common_places(scene);
    if (!places_) places_ = common_places(scene_);
  }

  // The finest first, which take longest.
  void run(std::vector<Job>& jobs) {
    side_by_side(options_.threads > 0 ? options_.threads : omp_get_max_threads(), jobs.size(), [&](std::size_t k) {
      Job& job = jobs[jobs.size() - 1 - k];
      if (!is_interrupted()) job.run = run_level(load(job.set), places_ ? &*places_ : nullptr, options_.interrupted);
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
      if (!job.run.is_there && !is_interrupted()) {
        study_.notes.push_back(fmt::format("level {} is left out, it ended as {}: {}", study_.levels.size(),
                                           to_string(level.status), level.reason));
      }
    }
    if (is_interrupted()) study_.notes.emplace_back("interrupted by the user before all runs were done");
    const LevelRun& finest = levels_.back().run;
    std::ranges::copy(finest.notes, std::back_inserter(study_.notes));
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

  void gather_sources(const std::vector<Job>& jobs) {
    if (jobs.empty() || std::ranges::none_of(levels_, [](const Job& job) { return job.run.is_there; })) return;
    const LevelRun &finest = levels_.back().run, &base = levels_[levels_.size() - 2].run;
    study_.source_quantity = figure_of_sources(options_.refine, finest);
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
  std::optional<CommonPlaces> places_;  // at which levels are compared; empty: at their points, or not at all
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
