#include "space/boundary/trace_fit.hpp"

#include <algorithm>
#include <ranges>
#include <unordered_map>

#include <Eigen/IterativeLinearSolvers>

namespace stillpoint {
namespace {

/// Σ A w² of each function over these pieces.
template <Kinematics K, class Pieces>
std::unordered_map<int, double> squares(const ContactSurface<K>& surface, const Pieces& pieces) {
  std::unordered_map<int, double> sums;
  for (const std::size_t s : pieces)
    for (const auto& a : surface.piece(s).at.entries)
      if (a.function >= 0 && a.w != 0) sums[a.function] += surface.area(s) * a.w * a.w;
  return sums;
}

/// By functions, the share of the border they reach that is in these pieces.
template <Kinematics K>
std::unordered_map<int, double> shares(const ContactSurface<K>& surface, const std::vector<std::size_t>& pieces) {
  std::unordered_map<int, double> shares = squares(surface, pieces);
  const auto all = squares(surface, std::views::iota(std::size_t{0}, surface.size()));
  for (auto& [function, share] : shares) share /= all.at(function);
  return shares;
}

}  // namespace

template <Kinematics K>
TraceFit::TraceFit(const ContactSurface<K>& surface, const std::vector<std::size_t>& pieces)
    : area_(static_cast<Eigen::Index>(pieces.size())) {
  constexpr double sliver = 0.2;  // of the largest share of the functions at a piece
  const std::unordered_map<int, double> share = shares(surface, pieces);
  std::unordered_map<int, int> column;
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const auto row = static_cast<int>(k);
    area_[row] = surface.area(pieces[k]);
    double most = 0, sum = 0;
    const auto for_functions = [&](const auto& visit) {
      for (const auto& a : surface.piece(pieces[k]).at.entries)
        if (a.function >= 0 && a.w != 0 && share.at(a.function) >= sliver * most) visit(a);
    };
    for_functions([&](const auto& a) { most = std::max(most, share.at(a.function)); });
    for_functions([&](const auto& a) { sum += a.w; });
    for_functions([&](const auto& a) {
      const auto next = static_cast<int>(column.size());
      entries.emplace_back(row, column.try_emplace(a.function, next).first->second, a.w / sum);
    });
  }
  weights_.resize(area_.size(), static_cast<Eigen::Index>(column.size()));
  weights_.setFromTriplets(entries.begin(), entries.end());
  gram_ = weights_.transpose() * area_.asDiagonal() * weights_;
}

// Functions that the pieces cannot tell apart leave the matrix singular, and the equations consistent: conjugate
// gradients end at one of their solutions, all of which have the same trace.
Eigen::MatrixXd TraceFit::operator()(const Eigen::MatrixXd& borne) const {
  constexpr double exact = 1e-12;
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver(gram_);
  solver.setTolerance(exact);
  const Eigen::MatrixXd right = weights_.transpose() * (area_.asDiagonal() * borne);
  return weights_ * Eigen::MatrixXd(solver.solve(right));
}

template TraceFit::TraceFit(const ContactSurface<Kinematics::line>&, const std::vector<std::size_t>&);
template TraceFit::TraceFit(const ContactSurface<Kinematics::plane>&, const std::vector<std::size_t>&);
template TraceFit::TraceFit(const ContactSurface<Kinematics::axisymmetric>&, const std::vector<std::size_t>&);
template TraceFit::TraceFit(const ContactSurface<Kinematics::space>&, const std::vector<std::size_t>&);

}  // namespace stillpoint
