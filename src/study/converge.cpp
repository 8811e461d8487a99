#include <stillpoint/converge.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "base/stopwatch.hpp"
#include "base/thread_team.hpp"
#include "scene/grid_lines.hpp"
#include "scene/throw_scene_error.hpp"
#include "study/common_places.hpp"
#include "study/kept_runs.hpp"
#include "study/level_run.hpp"
#include "study/refinement.hpp"
#include "study/side_by_side.hpp"

namespace stillpoint {
namespace {

/// One of the independent runs that are done side by side; results do not depend on how many there are.
struct Job {
  Settings set;             // in addition to what the user has set
  std::string doing, name;  // progress text; name under which the run is kept
  LevelRun run{};
  bool is_done = false;
};

Settings both(Settings first, const Settings& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

// A name for a file, made from the varied settings.
std::string file_name_of(const std::vector<std::string>& varied) {
  std::string name;
  for (const std::string& set : varied) name += set + "-";
  for (char& letter : name)
    if (std::isalnum(static_cast<unsigned char>(letter)) == 0 && letter != '.') letter = '-';
  return name;
}

/// One series of levels.
class Converging {
 public:
  Converging(const VariedScene& of, const ConvergeOptions& options)
      : options_(options), scene_(of.scene), kept_(options_.keep, options_.resumes, scene_) {
    study_.scene = scene_.name;
    study_.title = scene_.title;
    study_.scene_text = scene_.text;
    study_.overrides.assign(scene_.overrides.begin(), scene_.overrides.end() - std::ssize(of.varied));
    study_.varied = of.varied;
    study_.refined = options_.refine;
    study_.ratio = options_.ratio;
    for (int k = 0; k < options_.levels; ++k) {
      Settings set;
      for (const Refinement refinement : options_.refine)
        std::ranges::move(located(scene_, [&] { return refined(scene_, refinement, std::pow(options_.ratio, k)); }),
                          std::back_inserter(set));
      levels_.push_back(
          {.set = std::move(set), .doing = fmt::format("level {}", k + 1), .name = fmt::format("level-{}", k + 1)});
    }
    add_sources();
    study_.runs = levels_.size() + sources_.size();
    choose_places();
    for (std::vector<Job>* jobs : {&levels_, &sources_})
      for (Job& job : *jobs) find_kept(job);
  }

  std::size_t runs() const { return study_.runs; }

  /// Runs all levels; done: called after each run with a description of it.
  ConvergenceStudy converge(const std::function<void(const std::string&)>& done) {
    for (const std::vector<Job>* jobs : {&levels_, &sources_})
      for (const Job& job : *jobs) kept_.begin(job.name);
    run(levels_, done);
    gather_levels();
    run(sources_, done);
    if (stopped(levels_) || stopped(sources_)) {
      study_.interrupted = true;
      study_.notes.emplace_back("interrupted by the user before all runs were done");
    }
    std::vector<LevelRun> runs;
    for (const Job& job : levels_) runs.push_back(job.run);
    gather_quantities(scene_, runs, study_);
    gather_sources();
    tell_of_orders();
    return std::move(study_);
  }

 private:
  // Chooses places in the cells of the finest level at which they are not too many to read: for a single norm fewer.
  void choose_places() {
    if (has_same_points(options_.refine)) return;
    const double most = scene_.exact.known() ? 2e4 : 2e5;
    for (auto level = levels_.rbegin(); level != levels_.rend() && !places_; ++level)
      if (const Scene scene = with(scene_, level->set); count_of_places(scene) <= most) places_ = common_places(scene);
    if (!places_) places_ = common_places(scene_);
  }

  static bool stopped(const std::vector<Job>& jobs) {
    return std::ranges::any_of(jobs, [](const Job& job) { return job.run.level.status == RunStatus::interrupted; });
  }

  void find_kept(Job& job) {
    job.name = file_name_of(study_.varied) + job.name;
    auto kept = kept_.find(job.name, texts_of(job.set));
    const bool at_other_places =
        kept && places_ && !kept->volume.empty() && kept->volume.size() != places_->size();  // of other levels
    if (!kept || at_other_places) return;
    job.run = std::move(*kept);
    job.is_done = true;
  }

  // Runs the finest level first, which takes longest.
  void run(std::vector<Job>& jobs, const std::function<void(const std::string&)>& done) {
    side_by_side(options_.threads > 0 ? options_.threads : loop_threads(), jobs.size(), [&](std::size_t k) {
      Job& job = jobs[jobs.size() - 1 - k];
      if (!job.is_done && !is_interrupted()) {
        job.run = run_level(with(scene_, job.set), places_ ? &*places_ : nullptr, options_.interrupted);
        job.run.level.set = texts_of(job.set);
        kept_.keep(job.name, job.run);
        job.is_done = job.run.is_there;
      }
      job.run.level.set = texts_of(job.set);
      done(job.doing);
    });
    study_.finished_runs += static_cast<std::size_t>(std::ranges::count_if(jobs, &Job::is_done));
  }

  void gather_levels() {
    for (Job& job : levels_) {
      ConvergenceLevel& level = job.run.level;
      const Scene scene = with(scene_, job.set);
      level.h = longest_mean_cell(scene.grid);
      level.size = size_of(scene, options_.refine.front(), level.step);
      study_.levels.push_back(level);
      if (!job.run.is_there && level.status != RunStatus::interrupted) {
        study_.notes.push_back(fmt::format("level {} is left out, it ended as {}: {}", study_.levels.size(),
                                           to_string(level.status), level.reason));
      }
    }
    const LevelRun& finest = levels_.back().run;
    std::ranges::copy(finest.notes, std::back_inserter(study_.notes));
  }

  // --- the largest source of error ---

  // Adds the runs in which one source of error at a time is refined, at the finest level but one.
  void add_sources() {
    if (!options_.finds_dominant || levels_.size() < 2) return;
    const Settings& base = levels_[levels_.size() - 2].set;
    for (const RefinedSource& source : other_sources(with(scene_, base), options_.refine)) {
      sources_.push_back({.set = both(base, source.set),
                          .doing = source.name,
                          .name = fmt::format("level-{}-source-{}", levels_.size() - 1, sources_.size() + 1)});
    }
  }

  void gather_sources() {
    if (sources_.empty() || std::ranges::none_of(levels_, [](const Job& job) { return job.run.is_there; })) return;
    const LevelRun &finest = levels_.back().run, &base = levels_[levels_.size() - 2].run;
    study_.source_quantity = figure_of_sources(options_.refine, finest);
    const auto add = [&](const std::string& name, const LevelRun& run) {
      const double by = change(study_.source_quantity, base, run);
      if (std::isfinite(by)) study_.sources.push_back({name, by});
    };
    add(source_of(options_.refine.front()), finest);
    for (const Job& job : sources_) add(job.doing, job.run);
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

  const ConvergeOptions& options_;
  const Scene& scene_;
  KeptRuns kept_;
  std::vector<Job> levels_, sources_;
  std::optional<CommonPlaces> places_;  // common places of the levels; empty: the points themselves, or no comparison
  ConvergenceStudy study_;
};

void check(const ConvergeOptions& options) {
  const auto refuse_if = [](bool condition, const std::string& message) {
    if (condition) throw std::invalid_argument(message);
  };
  refuse_if(options.refine.empty(), "refine: expected something to refine");
  refuse_if(options.levels < 2, fmt::format("levels: expected at least 2, found {}", options.levels));
  refuse_if(!(options.ratio > 1), fmt::format("ratio: expected more than 1, found {}", options.ratio));
}

}  // namespace

std::vector<ConvergenceStudy> converge_varied(const std::vector<VariedScene>& scenes, const ConvergeOptions& options) {
  check(options);
  std::vector<std::unique_ptr<Converging>> all;
  std::size_t total = 0;
  for (const VariedScene& scene : scenes) {
    all.push_back(std::make_unique<Converging>(scene, options));
    if (!scene.varied.empty()) check_set_up(scene.scene, options.interrupted);
    total += all.back()->runs();
  }
  const Stopwatch wall;
  std::mutex telling;
  int runs = 0;
  const auto done = [&](const std::string& what) {
    const std::scoped_lock lock(telling);
    ++runs;
    if (options.progress) options.progress({runs, static_cast<int>(total), what, wall.seconds()});
  };
  std::vector<ConvergenceStudy> series;
  for (const auto& one : all) series.push_back(one->converge(done));
  return series;
}

ConvergenceStudy converge(const Scene& scene, const ConvergeOptions& options) {
  return std::move(converge_varied({VariedScene{scene, {}}}, options).front());
}

}  // namespace stillpoint
