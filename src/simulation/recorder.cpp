#include "simulation/recorder.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include "output/run_folder.hpp"
#include "simulation/contact_figures.hpp"
#include "simulation/motion_figures.hpp"
#include "simulation/own_files.hpp"
#include "simulation/support_figures.hpp"

namespace stillpoint {
namespace {

// Time between rows: as asked; otherwise 200 rows to the end time or 20 to a period, and a whole number of steps so
// that landing on a row costs none. Steps that follow the stiffness have no whole number: to land on a row every few
// steps would shorten them, by half if each row was a step.
double output_interval(const Problem& problem, const Model& model) {
  if (problem.output.every > 0) return problem.output.every;
  const double period = model.omega_1 ? 2 * std::numbers::pi / *model.omega_1 : model.dwell;
  const double wanted = problem.stop.time > 0 ? problem.stop.time / 200 : period / 20;
  const double step = model.integrator.max_step;
  return std::max(1.0, std::round(wanted / step)) * step;
}

// A folder that cannot be written is bad input: nothing has run yet.
template <class Open>
auto open_output(const std::filesystem::path& out, const Open& open) {
  try {
    return open();
  } catch (const std::filesystem::filesystem_error& error) {
    throw_unless_of_disk(out, error);
  }
}

}  // namespace

Recorder::Recorder(RunState& run, bool resumed)
    : problem_(run.scene),
      phase_(*run.model.phase),
      options_(run.options),
      has_distance_(run.measured.has_distance()),
      probes_(problem_, phase_),
      energy_balance_(phase_),
      history_(open_output(options_.out, [&] { return History(own_folder(options_), columns(), resumed); })),
      snapshots_(open_output(
          options_.out,
          [&] { return Snapshots(problem_, phase_, !options_.out.empty(), own_folder(options_), resumed); })),
      interval_(output_interval(problem_, run.model)),
      lands_on_rows_(problem_.output.every > 0 || !run.model.initial_stiffening) {}

std::vector<std::string> Recorder::columns() const {
  std::vector<std::string> all = probes_.columns();
  std::ranges::copy(reaction_columns(problem_), std::back_inserter(all));
  std::ranges::copy(contact_columns(problem_), std::back_inserter(all));
  std::ranges::move(motion_columns(problem_), std::back_inserter(all));
  if (problem_.load || problem_.later_load) all.insert(all.end(), {"load.factor", "load.displacement"});
  std::ranges::copy(energy_balance_.columns(), std::back_inserter(all));
  if (has_distance_) all.emplace_back("distance");
  return all;
}

// A row that rounding puts next to the end is the row at the end.
double Recorder::next_row_time() const {
  const double t_row = static_cast<double>(rows_) * interval_, end = problem_.stop.time;
  return end > 0 && t_row > end - 1e-9 * interval_ ? end : t_row;
}

double Recorder::next_time() const {
  return lands_on_rows_ ? std::min(next_row_time(), snapshots_.next_time()) : snapshots_.next_time();
}

void Recorder::sample(RunState& run, bool last) {
  if ((last && run.t != last_row_) || run.t >= next_row_time()) add_row(run);
  snapshots_.sample(run.t, run.motion->u(), run.motion->v());
}

void Recorder::add_row(RunState& run) {
  const double t = run.t;
  PhaseMotion& motion = *run.motion;
  const Measurements::Figures& measured = run.measured.all();
  const HistoryRow row{t, run.steps(), run.evaluations(), measured.residual, measured.kinetic_energy};
  energy_balance_.advance(t, motion);
  std::vector<double> values = probes_.read(t, motion.u(), motion.v());
  std::ranges::copy(reaction_values(problem_, phase_, t, motion), std::back_inserter(values));
  std::ranges::copy(contact_values(problem_, phase_, t, motion.u()), std::back_inserter(values));
  std::ranges::move(motion_values(problem_, t), std::back_inserter(values));
  if (const auto load = phase_.supports().load_state(t, motion.u())) {
    values.insert(values.end(), {load->factor, load->displacement});
    if (!(load->factor <= largest_factor_)) largest_factor_ = load->factor;
  } else if (problem_.later_load) {
    values.insert(values.end(), {0, 0});
  }
  std::ranges::copy(energy_balance_.values(row.kinetic_energy), std::back_inserter(values));
  if (has_distance_) values.push_back(run.measured.distance().value_or(std::numeric_limits<double>::quiet_NaN()));
  history_.add(row, values);
  if (options_.at_row) tell(row, values);
  last_row_ = t;
  while (static_cast<double>(rows_) * interval_ <= t) ++rows_;
}

void Recorder::tell(const HistoryRow& figures, const std::vector<double>& others) const {
  std::vector<std::string> names = columns();
  names.insert(names.begin(), {"t", "steps", "rhs_evaluations", "residual", "kinetic_energy"});
  std::vector<double> row = {figures.t, static_cast<double>(figures.steps),
                             static_cast<double>(figures.rhs_evaluations), figures.residual, figures.kinetic_energy};
  row.insert(row.end(), others.begin(), others.end());
  options_.at_row(names, row);
}

void Recorder::end_phase(RunState& run) {
  probes_.end_phase(run.t, run.motion->u(), run.motion->v());
  if (!energy_balance_.watches()) return;
  run.motion->evaluate(run.t);
  energy_balance_.advance(run.t, *run.motion);
}
void Recorder::begin_phase(RunState& run) {
  probes_.begin_phase(run.t, run.motion->u(), run.motion->v());
  if (!energy_balance_.watches()) return;
  run.motion->evaluate(run.t);
  energy_balance_.begin_phase(run.t, run.motion->system);
}

void Recorder::archive(const StateArchive& state) {
  archive_files(state);
  energy_balance_.archive(state.part("energy"));
}

void Recorder::archive_files(const StateArchive& state) {
  state("rows", rows_, "interval", interval_, "last_row", last_row_, "largest_factor", largest_factor_);
  probes_.archive(state.part("probes"));
  history_.archive(state.part("history"));
  snapshots_.archive(state.part("snapshots"));
}

void Recorder::end_stage(const StateArchive& state) {
  probes_.end_stage();
  archive_files(state);
}

void Recorder::go_on(const StateArchive& state, RunState& run, double work) {
  archive_files(state);
  while (static_cast<double>(rows_) * interval_ <= run.t) ++rows_;  // a static solver goes on from one end to the next
  probes_.begin_stage(run.t, run.motion->u(), run.motion->v());
  run.motion->evaluate(run.t);
  const double begin = run.model.static_method ? run.stage.t : run.t;
  energy_balance_.go_on(work, begin, run.t, run.motion->system);
}

void Recorder::finish(double t, const PhaseMotion* motion) {
  if (motion) snapshots_.take_last(t, motion->u(), motion->v());
  history_.finish();  // first: the other needs more room
  snapshots_.finish();
}

void Recorder::fill(Summary& s, RunState& run) {
  const double t = run.t;
  const PhaseMotion& motion = *run.motion;
  if (motion.stepper->way()) energy_balance_.advance(t, motion);  // it may have come to its end without a time
  if (energy_balance_.watches()) s.external_work = energy_balance_.external_work();
  s.snapshots = snapshots_.taken();
  if (const auto load = phase_.supports().load_state(t, motion.u()))
    s.load = LoadFigures{.factor = load->factor,
                         .largest_factor = std::max(largest_factor_, load->factor),
                         .displacement = load->displacement,
                         .growth = run.load_growth};
  const std::vector<double> values = probes_.read(t, motion.u(), motion.v());
  s.probe_positions = probes_.positions();
  std::ranges::copy(probes_.notes(), std::back_inserter(s.notes));
  std::size_t column = 0;
  for (const std::string& name : probes_.columns()) {
    const std::size_t dot = name.find('.');
    if (name.substr(dot + 1) == "slope_angle") s.slope_angle = values[column];
    s.probes[name.substr(0, dot)].emplace_back(name.substr(dot + 1), values[column++]);
  }
}

}  // namespace stillpoint
