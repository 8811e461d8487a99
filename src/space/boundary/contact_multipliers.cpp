#include "space/boundary/contact_multipliers.hpp"

#include <span>
#include <utility>

#include "space/boundary/trace_fit.hpp"

namespace stillpoint {

template <Kinematics K>
void ContactMultipliers<K>::resize() {
  lambda_.resize(surface_.size());
  if (has_shear_) lambda_t_.resize(surface_.size());
}

template <Kinematics K>
void ContactMultipliers<K>::follow(const std::vector<PieceOrigin>& origins) {
  lambda_ = of_pieces_cut_anew(lambda_, origins);
  if (has_shear_) lambda_t_ = of_pieces_cut_anew(lambda_t_, origins);
  updates_ = 0;
  kept_.clear();
}

template <Kinematics K>
void ContactMultipliers<K>::archive(const StateArchive& state) {
  std::vector<double> kept(kept_.begin(), kept_.end());
  state("updates", updates_);
  state.none_or(surface_.size(), "kept", kept);
  kept_.assign(kept.begin(), kept.end());
}

template <Kinematics K>
void ContactMultipliers<K>::archive_part(const StateArchive& state, const typename ContactSurface<K>::Part& part) {
  const std::size_t pieces = part.end_piece - part.first_piece;
  state("lambda", Vec(lambda_).subspan(part.first_piece, pieces));
  if (!has_shear_) return;
  std::span<Position> lambda_t = std::span(lambda_t_).subspan(part.first_piece, pieces);
  state.each(
      "lambda_t", lambda_t, [](Position & of) -> auto& { return of; });
}

template <Kinematics K>
void ContactMultipliers<K>::update(const std::vector<Touch>& closed, const Eigen::Matrix<double, N, N>& Q,
                                   bool evenly) {
  constexpr long soon = 20;  // updates, after most contacts have come to their end
  if (!evenly && ++updates_ >= soon) {
    kept_.resize(surface_.size());
    for (const Touch& touch : closed) kept_[touch.piece] = 1;
  }
  const std::vector<Touch> touches = with_kept(closed);
  Eigen::MatrixXd borne(touches.size(), has_shear_ ? 1 + N : 1);  // p, τ
  Eigen::Index row = 0;
  for (const Touch& touch : touches) {
    borne(row, 0) = touch.p;
    if (has_shear_) borne.row(row).template tail<N>() = Q.transpose() * touch.tau;
    ++row;
  }
  if (evenly) {
    change_evenly(touches, std::move(borne));
  } else {
    take(touches, told(touches, borne));
  }
}

template <Kinematics K>
auto ContactMultipliers<K>::with_kept(std::vector<Touch> closed) const -> std::vector<Touch> {
  if (kept_.empty()) return closed;
  std::vector<char> open = kept_;
  for (const Touch& touch : closed) open[touch.piece] = 0;
  const auto patches = surface_.patches();
  for (std::size_t k = 0; k < patches.size(); ++k) {
    for (std::size_t s = patches[k].begin; s < patches[k].end; ++s) {
      if (!open[s]) continue;
      Touch touch{};
      touch.patch = k;
      touch.piece = s;
      touch.at.normal.setZero();
      touch.at.distance = lambda_[s] / patches[k].stiffness;
      touch.area = surface_.area(s);
      touch.kappa = patches[k].stiffness;
      closed.push_back(touch);
    }
  }
  return closed;
}

template <Kinematics K>
auto ContactMultipliers<K>::means_of_patches(const std::vector<Touch>& touches, const Eigen::MatrixXd& values) const
    -> PatchMeans {
  const std::size_t patches = surface_.patches().size();
  PatchMeans means{std::vector<double>(patches, 0.0),
                   Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(patches), values.cols())};
  Eigen::Index row = 0;
  for (const Touch& touch : touches) {
    means.area[touch.patch] += touch.area;
    means.values.row(static_cast<Eigen::Index>(touch.patch)) += touch.area * values.row(row++);
  }
  for (std::size_t k = 0; k < patches; ++k)
    if (means.area[k] > 0) means.values.row(static_cast<Eigen::Index>(k)) /= means.area[k];
  return means;
}

template <Kinematics K>
Eigen::RowVectorXd ContactMultipliers<K>::multiplier(std::size_t piece) const {
  Eigen::RowVectorXd value(has_shear_ ? 1 + N : 1);
  value[0] = lambda_[piece];
  if (has_shear_) value.template tail<N>() = lambda_t_[piece];
  return value;
}

template <Kinematics K>
void ContactMultipliers<K>::set(std::size_t piece, const Eigen::RowVectorXd& value) {
  lambda_[piece] = std::max(0.0, value[0]);
  if (has_shear_) lambda_t_[piece] = value.template tail<N>();
}

// Of bodies that deform much pieces open and close within cells, and by functions they come to no end.
template <Kinematics K>
Eigen::MatrixXd ContactMultipliers<K>::told(const std::vector<Touch>& touches, const Eigen::MatrixXd& values) const {
  if (surface_.is_of_small_strain()) {
    std::vector<std::size_t> pieces;
    for (const Touch& touch : touches) pieces.push_back(touch.piece);
    return TraceFit(surface_.pieces(), pieces)(values);
  }
  const PatchMeans means = means_of_patches(touches, values);
  Eigen::MatrixXd told(values.rows(), values.cols());
  Eigen::Index row = 0;
  for (const Touch& touch : touches) told.row(row++) = means.values.row(static_cast<Eigen::Index>(touch.patch));
  return told;
}

// A piece that is open beside others of its patch bears as they do where it closes.
template <Kinematics K>
void ContactMultipliers<K>::take(const std::vector<Touch>& touches, const Eigen::MatrixXd& borne) {
  const PatchMeans means = means_of_patches(touches, borne);
  const auto patches = surface_.patches();
  for (std::size_t k = 0; k < patches.size(); ++k)
    for (std::size_t s = patches[k].begin; s < patches[k].end; ++s)
      set(s, means.values.row(static_cast<Eigen::Index>(k)));
  Eigen::Index row = 0;
  for (const Touch& touch : touches) set(touch.piece, borne.row(row++));
}

// Instead of the changes of the patches themselves those that groups of them have in common, and their neighbours.
template <Kinematics K>
void ContactMultipliers<K>::change_evenly(const std::vector<Touch>& touches, Eigen::MatrixXd borne) {
  Eigen::Index row = 0;
  for (const Touch& touch : touches) borne.row(row++) -= multiplier(touch.piece);
  const PatchMeans means = means_of_patches(touches, borne);
  const PatchNeighbours& neighbours = surface_.neighbours();
  const Eigen::RowVectorXd none = Eigen::RowVectorXd::Zero(borne.cols());
  std::vector<double> area(neighbours.groups(), 0.0);
  std::vector<char> bears(area.size(), 0);
  std::vector<Eigen::RowVectorXd> change(area.size(), none);
  for (std::size_t k = 0; k < means.area.size(); ++k) {
    if (!(means.area[k] > 0)) continue;
    const std::size_t group = neighbours.group_of(k);
    bears[group] = 1;
    area[group] += means.area[k];
    change[group] += means.area[k] * means.values.row(static_cast<Eigen::Index>(k));
  }
  for (std::size_t group = 0; group < area.size(); ++group)
    if (bears[group]) change[group] /= area[group];
  const auto patches = surface_.patches();
  for (std::size_t k = 0; k < patches.size(); ++k) {
    const bool touches_anything = means.area[k] > 0;
    const Eigen::RowVectorXd even =
        touches_anything ? neighbours.smoothed(neighbours.group_of(k), change, bears) : none;
    for (std::size_t s = patches[k].begin; s < patches[k].end; ++s)
      set(s, touches_anything ? Eigen::RowVectorXd(multiplier(s) + even) : none);
  }
}

template class ContactMultipliers<Kinematics::line>;
template class ContactMultipliers<Kinematics::plane>;
template class ContactMultipliers<Kinematics::axisymmetric>;
template class ContactMultipliers<Kinematics::space>;

}  // namespace stillpoint
