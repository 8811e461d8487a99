#include "simulation/limit_load.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/line_fit.hpp"

namespace stillpoint {
namespace {

constexpr std::size_t most_pieces = 256;   // then two and two are joined
constexpr std::size_t fewest_pieces = 64;  // a fifth of which a slope can be fitted to

}  // namespace

// Loads may be driven either way; where q(t) turns back there is nothing new.
bool LimitLoad::observe(const LoadState& load) {
  const double driven = std::abs(load.prescribed), q = std::copysign(1, load.prescribed) * load.displacement;
  if (!std::isfinite(load.factor) || !std::isfinite(q)) return false;
  if (piece_ == 0) {
    if (driven > 0) {
      piece_ = end_ = driven;
      first_q_ = std::copysign(1, load.prescribed) * first_q_;
    } else {
      first_q_ = load.displacement;  // its sign is that of q(t) once that is known
      first_factor_ = load.factor;
    }
    return false;
  }
  if (driven <= end_ - piece_) return false;
  sum_q_ += q;
  sum_factor_ += load.factor;
  ++steps_;
  if (driven < end_) return false;
  close_piece();
  end_ = driven + piece_;
  growth_ = measured_growth();
  if (!(asked_ > 0 && growth_ && *growth_ <= asked_)) {
    flat_since_ = 0;
  } else if (flat_since_ == 0) {
    flat_since_ = driven;
  }
  return flat_since_ > 0 && driven >= confirmed_after * flat_since_;
}

void LimitLoad::close_piece() {
  if (q_.size() == most_pieces) halve();
  q_.push_back(sum_q_ / steps_);
  factor_.push_back(sum_factor_ / steps_);
  steps_ = sum_q_ = sum_factor_ = 0;
}

void LimitLoad::halve() {
  for (std::vector<double>* means : {&q_, &factor_}) {
    for (std::size_t k = 0; k < most_pieces / 2; ++k) (*means)[k] = ((*means)[2 * k] + (*means)[2 * k + 1]) / 2;
    means->resize(most_pieces / 2);
  }
  piece_ *= 2;
}

// dλ/dq by least squares.
std::optional<double> LimitLoad::measured_growth() const {
  const std::size_t count = q_.size() / 5;
  if (q_.size() < fewest_pieces) return {};
  const std::size_t first = q_.size() - count;
  const LineFit line = fit_line({&q_[first], count}, {&factor_[first], count});
  const double middle = (q_[first] + q_.back()) / 2;
  const double growth = line.slope * (middle - first_q_) / (line.at_zero + line.slope * middle - first_factor_);
  if (!std::isfinite(growth)) return {};
  return growth;
}

std::string LimitLoad::description() const {
  if (!growth_) return "too few steps to tell how the factor grows";
  return fmt::format(
      "over the last fifth of the displacement the factor grew {:.3g} times as fast as it (stop.load_growth = {:.3g})",
      *growth_, asked_);
}

void LimitLoad::archive(const StateArchive& state) {
  state("first_q", first_q_);
  state("first_factor", first_factor_);
  state("flat_since", flat_since_);
  state("q", q_);
  state("factor", factor_);
  if (q_.size() != factor_.size() || q_.size() > most_pieces) throw StateError("'factor' is not that of each 'q'");
  state("piece", piece_);
  state("sum_q", sum_q_);
  state("sum_factor", sum_factor_);
  state("steps", steps_);
  state("end", end_);
  state("growth", growth_);
}

}  // namespace stillpoint
