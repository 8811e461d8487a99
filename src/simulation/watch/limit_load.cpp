#include "simulation/watch/limit_load.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/line_fit.hpp"

namespace stillpoint {
namespace {

constexpr std::size_t most_pieces = 256;   // if there are more, two and two are joined
constexpr std::size_t fewest_pieces = 64;  // a fifth of which a slope can be fitted to

}  // namespace

// The support that drives the loads is the last of all.
Verdict LimitLoad::judge(RunState& run) {
  if (!run.scene.load) return {};
  const ConstVec reactions = run.motion->system.last().trial->reactions;
  const double force = reactions.empty() ? 0 : reactions.back();
  const bool piece_is_over = take(*run.model.phase->supports().load_state(run.t, run.motion->u()), force);
  run.load_growth = growth_;
  if (!piece_is_over || asked_ <= 0) return {};
  const Measurements::Figures& measured = run.measured.all();
  const GivingWay& giving_way = run.giving_way;
  const Body body{.residual = measured.residual,
                  .kinetic_energy = measured.kinetic_energy,
                  .plastic_strain = giving_way.plastic_strain(),
                  .slides = !giving_way.shows() || !giving_way.slides_along(run.t, run.motion->u()).empty()};
  return reached(body) ? Verdict{RunStatus::limit_load, "an estimate of the limit load: " + description()} : Verdict{};
}

void LimitLoad::explain(RunState&, Verdict& verdict) {
  if (asked_ > 0 && verdict.status != RunStatus::failed) verdict.reason += "; no limit load: " + description();
}

// Loads may be driven either way; if q(t) turns back there is nothing new.
bool LimitLoad::take(const LoadState& load, double force) {
  const double driven = std::abs(load.prescribed), q = std::copysign(1, load.prescribed) * load.displacement;
  if (!std::isfinite(load.factor) || !std::isfinite(q)) return false;
  if (piece_ == 0) {
    if (driven > 0) {
      piece_ = end_ = driven;
      first_q_ = std::copysign(1, load.prescribed) * first_q_;
      last_q_ = load.displacement;
      last_force_ = force;
    } else {
      first_q_ = load.displacement;  // its sign is that of q(t) once that is known
      first_factor_ = load.factor;
    }
    return false;
  }
  work_ += (last_force_ + force) / 2 * (load.displacement - last_q_);
  last_q_ = load.displacement;
  last_force_ = force;
  if (driven <= end_ - piece_) return false;
  sum_q_ += q;
  sum_factor_ += load.factor;
  ++steps_;
  if (driven < end_) return false;
  close_piece();
  end_ = driven + piece_;
  growth_ = measured_growth();
  if (!(asked_ > 0 && is_flat())) {
    flat_since_ = 0;
  } else if (flat_since_ == 0) {
    flat_since_ = driven;
  }
  return true;
}

bool LimitLoad::reached(const Body& body) {
  residual_ = body.residual;
  kinetic_energy_.back() = body.kinetic_energy;
  giving_.back() = body.plastic_strain > plastic_strain_ || body.slides ? 1 : 0;
  plastic_strain_ = std::max(plastic_strain_, body.plastic_strain);
  const bool has_lasted = flat_since_ > 0 && end_ - piece_ >= confirmed_after * flat_since_;
  reached_ = has_lasted && residual_ <= largest_residual && inertia() <= largest_inertia && giving() >= least_giving;
  return reached_;
}

// The largest kinetic energy in the last fifth beside W. One that is not a number stays one.
double LimitLoad::inertia() const {
  double largest = 0;
  for (std::size_t k = first_of_last_fifth(); k < kinetic_energy_.size(); ++k)
    if (!(kinetic_energy_[k] <= largest)) largest = kinetic_energy_[k];
  return largest / std::abs(work_);
}

double LimitLoad::giving() const {
  const std::size_t first = first_of_last_fifth();
  double sum = 0;
  for (std::size_t k = first; k < giving_.size(); ++k) sum += giving_[k];
  return sum / static_cast<double>(giving_.size() - first);
}

void LimitLoad::close_piece() {
  if (q_.size() == most_pieces) halve();
  q_.push_back(sum_q_ / steps_);
  factor_.push_back(sum_factor_ / steps_);
  kinetic_energy_.push_back(0);
  giving_.push_back(0);
  steps_ = sum_q_ = sum_factor_ = 0;
}

void LimitLoad::halve() {
  for (std::vector<double>* means : {&q_, &factor_, &giving_}) {
    for (std::size_t k = 0; k < most_pieces / 2; ++k) (*means)[k] = ((*means)[2 * k] + (*means)[2 * k + 1]) / 2;
    means->resize(most_pieces / 2);
  }
  for (std::size_t k = 0; k < most_pieces / 2; ++k)
    kinetic_energy_[k] = std::max(kinetic_energy_[2 * k], kinetic_energy_[2 * k + 1]);
  kinetic_energy_.resize(most_pieces / 2);
  piece_ *= 2;
}

// dλ/dq by least squares.
std::optional<double> LimitLoad::measured_growth() const {
  if (q_.size() < fewest_pieces) return {};
  const std::size_t first = first_of_last_fifth(), count = q_.size() - first;
  const LineFit line = fit_line({&q_[first], count}, {&factor_[first], count});
  const double middle = (q_[first] + q_.back()) / 2;
  const double growth = line.slope * (middle - first_q_) / (line.at_zero + line.slope * middle - first_factor_);
  if (!std::isfinite(growth)) return {};
  return growth;
}

std::string LimitLoad::description() const {
  if (!growth_) return "too few steps to tell how the factor grows";
  std::string growth = fmt::format(
      "over the last fifth of the displacement the load factor grew {:.3g} times as fast as the displacement, each "
      "relative to its size (stop.load_growth = {:.3g})",
      *growth_, asked_);
  if (reached_ || !is_flat()) return growth;
  std::vector<std::string> missing;
  if (!(residual_ <= largest_residual))
    missing.push_back(
        fmt::format("the residual is {:.2g} of {:.2g} at most: what is out of balance, and what damping takes, is a "
                    "part of the factor; expected a slower displacement or a local damping",
                    residual_, largest_residual));
  if (!(inertia() <= largest_inertia))
    missing.push_back(
        fmt::format("the kinetic energy has been {:.2g} of the load's work, of {:.2g} at most: the motion is not "
                    "quasi-static; expected a slower displacement",
                    inertia(), largest_inertia));
  if (!(giving() >= least_giving)) missing.emplace_back("no point yields and nothing slides on a wall meanwhile");
  if (missing.empty())
    missing.push_back(fmt::format("it has done so only since q(t) = {:.3g}, and is to do so until {:.3g}", flat_since_,
                                  confirmed_after * flat_since_));
  return fmt::format("{}, but {}", growth, fmt::join(missing, "; "));
}

void LimitLoad::archive(const StateArchive& state) {
  state("first_q", first_q_, "first_factor", first_factor_, "flat_since", flat_since_, "q", q_, "factor", factor_);
  if (q_.size() != factor_.size() || q_.size() > most_pieces) throw StateError("'factor' is not that of each 'q'");
  state.none_or(q_.size(), "kinetic_energy", kinetic_energy_);
  state.none_or(q_.size(), "giving", giving_);
  kinetic_energy_.resize(q_.size());
  giving_.resize(q_.size());
  state("last_q", last_q_, "last_force", last_force_, "work", work_, "residual", residual_, "plastic_strain",
        plastic_strain_, "reached", reached_, "piece", piece_, "sum_q", sum_q_, "sum_factor", sum_factor_, "steps",
        steps_, "end", end_, "growth", growth_);
}

}  // namespace stillpoint
