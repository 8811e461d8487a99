// Tractions on the borders of bodies, as pieces of their surface that move with the bodies.
#pragma once

#include <stillpoint/problem.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "base/work_pool.hpp"
#include "scene/throw_scene_error.hpp"
#include "space/boundary/border_piece.hpp"
#include "space/boundary/boundary_condition.hpp"
#include "space/boundary/loads_before.hpp"
#include "space/boundary/traction_pieces.hpp"

namespace stillpoint {

/// Dead loads, t(X, t) dA per undeformed area, and pressures that follow the deformed surface, −p(X, t) n da = −p
/// cof(f) N dA. X: the undeformed position. They act on pieces of the border, which store the undeformed area.
template <Kinematics K>
class Tractions final : public BoundaryCondition<dimensions(K)> {
  static constexpr int dim = dimensions(K);
  using GridOf = Grid<dim>;
  using typename BoundaryCondition<dim>::Parts;
  using Entry = typename CarriedPoint<dim>::Entry;

 public:
  Tractions(const Problem& problem, const GridOf& grid) : problem_(problem) {
    for (const TractionSpec& traction : problem.tractions) {
      TractionCutter<K>(problem, traction, grid)
          .cut([&](const auto& x, double area, const auto& normal, std::size_t body) {
            pieces_.push_back({BorderPiece<K>::make(x, area, normal), &traction, body});
          });
    }
    check_values();
  }

  void begin_phase(const Parts& phase, Vec) override {
    for (Piece& piece : pieces_) piece.at.field = phase.points.field_of(piece.body);
    if (problem_.phase.ends()) {
      freeze_carried(
          pieces_, [](Piece & piece) -> auto& { return piece.at; }, !has_begun_, phase);
      has_begun_ = true;
      return;
    }
    for (Piece& piece : pieces_)
      if (!piece.freeze_in_single_phase(phase)) throw_scene_error("traction", "there is no material at this face");
  }
  void leave_placed(const WaysSincePlaced<dim>& ways) override {
    for (Piece& piece : pieces_) {
      if (piece.goes_on) continue;
      if (const auto way = ways.at(piece.body, piece.X); way && !ways.in_place())
        piece.leave_placed(*way, /*in_place=*/false);
    }
  }
  std::string_view kind() const override { return "tractions"; }
  bool varies() const override {
    return std::ranges::any_of(problem_.tractions, [](const TractionSpec& traction) {
      return std::ranges::any_of(traction.formulas(), [](const Expression& formula) { return formula.uses('t'); });
    });
  }
  void add_load(const Parts& phase, double t, Vec F) const override {
    const auto values = evaluate(t);
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      if (!pieces_[k].traction->pressure)
        add_force(pieces_[k], phase.dofs, force_of(pieces_[k], values->of_piece[k], nullptr), F);
    }
  }
  bool follows() const override {
    return std::ranges::any_of(problem_.tractions, [](const TractionSpec& t) { return t.pressure.has_value(); });
  }
  void add_following_force(const Parts& phase, double t, const double* u, Vec F) const override {
    const auto values = evaluate(t);
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      if (pieces_[k].traction->pressure)
        add_force(pieces_[k], phase.dofs, force_of(pieces_[k], values->of_piece[k], u), F);
    }
  }
  void add_load_on_supports(const Parts& phase, double t, const double* u, Vec F_s) const override {
    const auto values = evaluate(t);
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      const auto force = force_of(pieces_[k], values->of_piece[k], u);
      pieces_[k].at.for_prescribed(
          phase.dofs, [&](const Entry& a, int i, std::size_t s, double share) { F_s[s] += force[i] * a.w * share; });
    }
  }
  // The tangent is unsymmetric.
  void add_following_tangent(const Parts& phase, double t, const double* u, MatrixEntries& K_F) const override {
    const auto values = evaluate(t);
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      const Piece& piece = pieces_[k];
      if (!piece.traction->pressure) continue;
      const double p = values->of_piece[k][0];
      piece.at.for_free(phase.dofs, [&](const Entry& b, int j, int column, double share_b) {
        const auto change = piece.area_derivative(u, b, j);
        piece.at.for_free(phase.dofs, [&](const Entry& a, int i, int row, double share_a) {
          K_F.emplace_back(row, column, -p * change[i] * share_b * a.w * share_a);
        });
      });
    }
  }
  void archive(const StateArchive& state) override {
    state.each(
        "traction_positions", pieces_, [](Piece & piece) -> auto& { return piece.at.x; });
    state.each(
        "traction_areas", pieces_, [](Piece & piece) -> auto& { return piece.vector; });
    if (problem_.phase.at_stages) LoadsBefore::archive_numbers(state, numbers_of_pieces());
  }
  // Tractions that have ended are left out, and those that begin are where the scene puts them.
  void take_over(const StateArchive& state) override {
    const LoadsBefore before(state, numbers_of_pieces());
    std::vector<double> x, vector;
    state("traction_positions", x, "traction_areas", vector);
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      const auto place = before.place_of(k);
      if (!place) continue;
      pieces_[k].goes_on = true;
      before.copy_to(pieces_[k].at.x, x, *place);
      before.copy_to(pieces_[k].vector, vector, *place);
    }
  }
  // The pieces move with the body.
  void end_phase(const double* u) override {
    for (Piece& piece : pieces_) piece.move(u);
  }

 private:
  struct Piece : BorderPiece<K> {
    const TractionSpec* traction;
    std::size_t body;      // that it is a part of the border of
    bool goes_on = false;  // whether the stage before has left it where it is
  };
  struct Values {
    double t = std::numeric_limits<double>::quiet_NaN();  // when they hold [s]
    std::vector<std::array<double, dim>> of_piece;        // the traction, or the pressure, (pieces) [Pa]
  };

  std::vector<std::size_t> numbers_of_pieces() const {
    std::vector<std::size_t> numbers;
    for (const Piece& piece : pieces_) numbers.push_back(piece.traction->number);
    return numbers;
  }
  // The values of all pieces at t: a formula of t alone is evaluated once for all pieces of a traction, and a formula
  // of the position again only if t has changed and it depends on t.
  auto evaluate(double t) const {
    auto known = values_.borrow();
    Values& values = *known;
    if (t == values.t) return known;
    const bool first = std::isnan(values.t);
    values.of_piece.resize(pieces_.size());
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      const Piece& piece = pieces_[k];
      const auto formulas = piece.traction->formulas();
      const bool same_traction = k > 0 && pieces_[k - 1].traction == piece.traction;
      for (std::size_t i = 0; i < formulas.size(); ++i) {
        if (!first && !formulas[i].uses('t')) continue;
        values.of_piece[k][i] =
            same_traction && !formulas[i].uses_position() ? values.of_piece[k - 1][i] : formulas[i](piece.X, t);
      }
    }
    values.t = t;
    return known;
  }
  // Checks the formulas of position alone at all pieces; those of t are checked elsewhere, for all times of a run at
  // some positions.
  void check_values() const {
    const auto values = evaluate(0);
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      const Piece& piece = pieces_[k];
      const auto formulas = piece.traction->formulas();
      for (std::size_t i = 0; i < formulas.size(); ++i) {
        if (formulas[i].uses('t') || std::isfinite(values->of_piece[k][i])) continue;
        throw_scene_error(
            fmt::format("traction[{}].{}", piece.traction - problem_.tractions.data(),
                        piece.traction->pressure ? "pressure" : "value"),
            fmt::format("the formula is {} at ({:.6g}); expected a finite number along the whole traction",
                        std::isnan(values->of_piece[k][i]) ? "not a number" : "infinite", fmt::join(piece.X, ", ")));
      }
    }
  }

  // The force t A, or −p n da, for which u is needed [N].
  std::array<double, dim> force_of(const Piece& piece, const std::array<double, dim>& value, const double* u) const {
    std::array<double, dim> force;
    if (piece.traction->pressure) {
      force = piece.deformed_area(u);
      for (double& along : force) along *= -value[0];
    } else {
      for (int i = 0; i < dim; ++i) force[i] = value[i] * piece.area;
    }
    return force;
  }
  static void add_force(const Piece& piece, const DegreesOfFreedom& dofs, const std::array<double, dim>& force, Vec F) {
    piece.at.for_free(dofs, [&](const Entry& a, int i, int dof, double share) {
      F[static_cast<std::size_t>(dof)] += force[i] * a.w * share;
    });
  }

  const Problem& problem_;
  std::vector<Piece> pieces_;
  WorkPool<Values> values_;  // that evaluations have found
  bool has_begun_ = false;   // whether the first phase has begun
};

}  // namespace stillpoint
