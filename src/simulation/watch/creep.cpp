#include "simulation/watch/creep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "output/point_fields.hpp"
#include "scene/grid_lines.hpp"
#include "simulation/advice/notes.hpp"

namespace stillpoint {
namespace {

constexpr double default_way_left = 5e-3;       // equilibrium takes so much, relative to the largest displacement
constexpr double steady_exponent = 0.1;         // a steady motion slows down by no more than 7 % as its time doubles
constexpr std::size_t largest_sample = 20'000;  // [points]

// With more than critical damping the slowest mode dies out like e^{−s t},  s ≈ ω₁²/c.
double longest_period(const Model& model) {
  constexpr double two_pi = 2 * std::numbers::pi, longest = 100;
  if (!model.omega_1) return (model.multigrid ? 5 : 100) * two_pi / model.omega_max;
  const double period = two_pi / *model.omega_1;
  const double c = model.damping->linear().mass;
  return period * std::clamp(2 * c / (*model.omega_1 * two_pi), 1.0, longest);
}

}  // namespace

Creep::Creep(const RunState& run)
    : problem_(run.scene),
      phase_(*run.model.phase),
      dim_(static_cast<std::size_t>(phase_.dim())),
      giving_way_(run.giving_way),
      way_left_(problem_.stop.distance > 0 ? problem_.stop.distance.value() : default_way_left) {
  const StopSpec& stop = problem_.stop;
  const bool told_not_to_look = stop.distance == 0 && stop.distance.is_asked();
  watches_ = giving_way_.is_possible() && stop.wants_equilibrium() && !run.model.static_method && !told_not_to_look;
  may_slide_away_ = !phase_.info().updated_lagrangian;
  if (!watches_) return;
  period_ = shortest_period_ = longest_period(run.model);
  cell_ = longest_cell(problem_.grid);
  stride_ = (phase_.points() + largest_sample - 1) / largest_sample;
}

void Creep::observe(RunState& run) {
  if (!watches_ || !run.options.stops || run.t < next_) return;
  // A body that slides for ever is never near balance, and its multipliers are never taken: it is looked at before as
  // well.
  const Contact* const contact = phase_.contact();
  const bool settled = run.loads_stay() && (!contact || contact->is_settled());
  const bool begins = std::exchange(contact_is_settled_, run.contact_settled) != run.contact_settled;
  if (begins) has_given_ = gives_ = false;
  sample(run.t, run.motion->u(), settled && !begins);
  publish(run);
}

// What was found of an earlier motion goes with it: else a body that slid and came to rest would wait for ever.
void Creep::publish(RunState& run) const {
  run.measured.creeping =
      has_given_ ? Measurements::Creeping{way_left_.relative(), way_left_.small()} : Measurements::Creeping{};
}

Verdict Creep::judge(RunState& run) {
  if (!slides_away()) return {};
  return {RunStatus::step_limit, description(run.t, run.motion->u())};
}

void Creep::explain(RunState& run, Verdict& verdict) {
  const std::string slides = description(run.t, run.motion->u());
  if (verdict.status == RunStatus::failed) {
    if (!slides.empty()) verdict.reason += "; " + slides;
    return;
  }
  if (!slides.empty() && !verdict.reason.starts_with(slides)) verdict.reason = slides + "; " + verdict.reason;
  if (!problem_.stop.wants_equilibrium()) return;
  const std::string flows = creep(problem_, phase_);
  verdict.reason += "; " + (flows.empty() ? furthest_from_rest(*run.motion, run.t) : flows);
}

void Creep::sample(double t, ConstVec u, bool settled) {
  next_ = t + period_ / 4;
  if (!std::exchange(begun_, true)) plastic_strain_ = giving_way_.plastic_strain();
  if (!settled || loads_have_changed(t) || sum_.empty()) {
    way_left_.begin(t);
    begun_at_ = last_t_ = t;
    steady_since_ = -1;
    begin_block(t);
    return;
  }
  last_t_ = t;
  std::vector<double> of_points(dim_ * phase_.points());
  phase_.fields().point_displacement(t, u, of_points);
  for (std::size_t k = 0; k < sum_.size(); ++k) sum_[k] += of_points[dim_ * stride_ * (k / dim_) + k % dim_];
  sum_t_ += t;
  ++samples_;
  if (std::vector<std::string> along = giving_way_.slides_along(t, u); !along.empty()) {
    slid_ = true;
    slid_along_ = std::move(along);
  }
  if (t >= block_end_ - period_ / 8) close_block();
}

void Creep::begin_block(double t) {
  sum_.assign(dim_ * ((phase_.points() + stride_ - 1) / stride_), 0.0);
  samples_ = sum_t_ = 0;
  block_end_ = t + period_;
  slid_ = false;
}

void Creep::close_block() {
  for (double& value : sum_) value /= samples_;
  way_left_.add(sum_t_ / samples_, dim_, sum_);
  const double now = giving_way_.plastic_strain();
  const bool gives = now > plastic_strain_ || slid_ || !giving_way_.shows();
  plastic_strain_ = std::max(plastic_strain_, now);
  if (!slid_) slid_along_.clear();
  has_given_ = has_given_ || gives;
  gives_ = gives;
  if (!(way_left_.exponent() <= steady_exponent)) {
    steady_since_ = -1;
  } else if (gives && steady_since_ < 0) {
    steady_since_ = last_t_;
    steady_blocks_ = giving_blocks_ = 0;
  }
  ++steady_blocks_;
  if (gives) ++giving_blocks_;
  begin_block(last_t_);
}

// In a run with an open end nobody knows from when on loads stay, so that they are compared from sample to sample.
bool Creep::loads_have_changed(double t) const {
  if (problem_.stop.time > 0 || !loads_vary(problem_)) return false;
  constexpr std::size_t positions = 8;
  constexpr double tolerance = 1e-9;  // relative
  const std::vector<double> x = phase_.fields().point_data().initial_positions;
  bool changed = false;
  problem_.for_each_formula([&](const std::string&, const Expression& formula) {
    if (changed || !formula.uses('t')) return;
    for (std::size_t k = 0; k < positions && !changed; ++k) {
      const ConstVec at = ConstVec(x).subspan(dim_ * (k * (phase_.points() - 1) / (positions - 1)), dim_);
      const double before = formula(at, last_t_), now = formula(at, t);
      changed = !(std::abs(now - before) <= tolerance * std::max(std::abs(now), std::abs(before)));
    }
  });
  return changed;
}

// True if a steady motion has gone on for long enough, and over more than a cell in a single phase: nothing stops it.
// Near its friction a body sticks now and then.
bool Creep::slides_away() const {
  constexpr double least_giving = 0.5;  // of the blocks
  const double since = steady_since_ - begun_at_, now = last_t_ - begun_at_;
  return may_slide_away_ && steady_since_ >= 0 && now >= 2 * since + 8 * period_ && gives_ &&
         giving_blocks_ >= least_giving * steady_blocks_ && way_left_.way() > cell_;
}

// "it slides: …", at (t, u), if the body has given way until now, in a motion whose way left is not known; else empty.
std::string Creep::description(double t, ConstVec u) const {
  if (!watches_ || !gives_ || !(way_left_.exponent() <= 1)) return "";
  const std::vector<double> v = way_left_.velocities(), x = current_positions(phase_, t, u);
  const std::size_t points = v.size() / dim_;
  if (points == 0) return "";
  const std::vector<double> speed = lengths_of(v, dim_);
  const auto fastest = static_cast<std::size_t>(std::ranges::max_element(speed) - speed.begin());
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<double> low(dim_, infinity), high(dim_, -infinity);
  std::size_t moving = 0;
  for (std::size_t k = 0; k < points; ++k) {
    if (speed[k] < speed[fastest] / 2) continue;
    ++moving;
    for (std::size_t i = 0; i < dim_; ++i) {
      low[i] = std::min(low[i], x[dim_ * stride_ * k + i]);
      high[i] = std::max(high[i], x[dim_ * stride_ * k + i]);
    }
  }
  const std::string along = slid_along_.empty() ? "" : fmt::format("along {}, ", fmt::join(slid_along_, " and "));
  const double q = way_left_.exponent();
  const std::string decay =
      q <= steady_exponent ? "which does not decay"
                           : fmt::format("which falls by {:.0f} % as the time doubles", 100 * (1 - std::pow(2.0, -q)));
  return fmt::format(
      "it slides: {}{:.0f} % of the body, between ({:.3g}) and ({:.3g}), by {:.3g} m in the last {:.3g} s; "
      "fastest is {} at {:.3g} m/s, {}",
      along, 100 * static_cast<double>(moving) / static_cast<double>(points), fmt::join(low, ", "),
      fmt::join(high, ", "), way_left_.way(), way_left_.span(),
      to_string(phase_.diagnosis().of_point(stride_ * fastest)), speed[fastest], decay);
}

void Creep::archive(const StateArchive& state, RunState& run) {
  if (!watches_) return;
  way_left_.archive(state.part("way_left"));
  state("period", period_, "sum", sum_);
  const std::size_t expected = dim_ * ((phase_.points() + stride_ - 1) / stride_);
  for (const std::size_t size : {sum_.size(), way_left_.size_of_block()})
    if (size != 0 && size != expected) throw StateError("the creep is that of another number of points");
  state("samples", samples_, "sum_t", sum_t_, "block_end", block_end_, "next", next_, "last_t", last_t_,
        "plastic_strain", plastic_strain_, "slid_along", slid_along_, "begun", begun_, "has_given", has_given_, "gives",
        gives_, "slid", slid_, "steady_since", steady_since_, "steady_blocks", steady_blocks_, "giving_blocks",
        giving_blocks_, "begun_at", begun_at_, "contact_is_settled", contact_is_settled_);
  publish(run);
}

}  // namespace stillpoint
