#include "simulation/recorder.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include "output/run_folder.hpp"
#include "simulation/support_figures.hpp"

namespace stillpoint {
namespace {

// Time between rows: as asked; otherwise 200 rows to the end time or 20 to a period, and a whole number of steps so
// that landing on a row costs none. Of steps that follow the stiffness there is no whole number: to land on a row every
// few steps would shorten them, by half where a row was a step.
double output_interval(const Problem& problem, const Model& model) {
  if (problem.output.every > 0) return problem.output.every;
  const double period = model.omega_1 ? 2 * std::numbers::pi / *model.omega_1 : model.dwell;
  const double wanted = problem.stop.time > 0 ? problem.stop.time / 200 : period / 20;
  const double step = model.integrator.max_step;
  return std::max(1.0, std::round(wanted / step)) * step;
}

// The forces of (t, u), if the last evaluation was elsewhere: in a stage, or in a trial that was refused.
void evaluate_at(double t, PhaseMotion& motion) {
  if (!motion.integrator->force_is_current()) motion.system.residual(t, motion.u());
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

Recorder::Recorder(const Problem& problem, const Model& model, const std::filesystem::path& folder, bool has_distance,
                   bool resumed)
    : problem_(problem),
      phase_(*model.phase),
      has_distance_(has_distance),
      probes_(problem, *model.phase),
      energy_balance_(*model.phase),
      history_(open_output(folder, [&] { return History(folder, columns(), resumed); })),
      snapshots_(open_output(folder, [&] { return Snapshots(problem, *model.phase, folder, resumed); })),
      interval_(output_interval(problem, model)),
      lands_on_rows_(problem.output.every > 0 || !model.initial_stiffening) {}

std::vector<std::string> Recorder::columns() const {
  std::vector<std::string> all = probes_.columns();
  std::ranges::copy(reaction_columns(problem_), std::back_inserter(all));
  if (problem_.load) all.insert(all.end(), {"load.factor", "load.displacement"});
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

void Recorder::add_row(const Row& row, PhaseMotion& motion) {
  const double t = row.figures.t;
  energy_balance_.advance(t, motion.system, motion.u());
  std::vector<double> values = probes_.read(t, motion.u(), motion.v());
  std::ranges::copy(reaction_values(problem_, phase_, t, motion), std::back_inserter(values));
  if (const auto load = phase_.supports().load_state(t, motion.u())) {
    values.insert(values.end(), {load->factor, load->displacement});
    if (!(load->factor <= largest_factor_)) largest_factor_ = load->factor;
  }
  std::ranges::copy(energy_balance_.values(row.figures.kinetic_energy), std::back_inserter(values));
  if (has_distance_) values.push_back(row.distance.value_or(std::numeric_limits<double>::quiet_NaN()));
  history_.add(row.figures, values);
  if (told_) tell(row.figures, values);
  last_row_ = t;
  while (static_cast<double>(rows_) * interval_ <= t) ++rows_;
}

void Recorder::tell(const HistoryRow& figures, const std::vector<double>& others) const {
  std::vector<std::string> names = {"t", "steps", "rhs_evaluations", "residual", "kinetic_energy"};
  std::ranges::copy(columns(), std::back_inserter(names));
  std::vector<double> row = {figures.t, static_cast<double>(figures.steps),
                             static_cast<double>(figures.rhs_evaluations), figures.residual, figures.kinetic_energy};
  row.insert(row.end(), others.begin(), others.end());
  told_(names, row);
}

void Recorder::end_phase(double t, PhaseMotion& motion) {
  probes_.end_phase(t, motion.u(), motion.v());
  if (!energy_balance_.watches()) return;
  evaluate_at(t, motion);
  energy_balance_.advance(t, motion.system, motion.u());
}
void Recorder::begin_phase(double t, PhaseMotion& motion) {
  probes_.begin_phase(t, motion.u(), motion.v());
  if (!energy_balance_.watches()) return;
  evaluate_at(t, motion);
  energy_balance_.begin_phase(t, motion.system);
}

void Recorder::archive(const StateArchive& state) {
  state("rows", rows_);
  state("last_row", last_row_);
  state("largest_factor", largest_factor_);
  probes_.archive(state.part("probes"));
  energy_balance_.archive(state.part("energy"));
  history_.archive(state.part("history"));
  snapshots_.archive(state.part("snapshots"));
}

void Recorder::finish(double t, const PhaseMotion* motion) {
  if (motion) snapshots_.take_last(t, motion->u(), motion->v());
  history_.finish();  // first: the other needs more room
  snapshots_.finish();
}

void Recorder::fill(Summary& s, double t, PhaseMotion& motion) {
  if (energy_balance_.watches()) s.external_work = energy_balance_.external_work();
  s.snapshots = snapshots_.taken();
  if (const auto load = phase_.supports().load_state(t, motion.u()))
    s.load = LoadFigures{.factor = load->factor,
                         .largest_factor = std::max(largest_factor_, load->factor),
                         .displacement = load->displacement};
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
