// The border of bodies as points at which they may be touched: its pieces and patches (border_patches.hpp).
//
// A patch answers a penetration with the stiffness κ of a cell [N/m³], as WeakSupports: with G_a ≥ Σ_b |K_ab|
//
//   κ = β mean (Σ_a w_a² / Σ_a (w_a²/G_a)) / A_cell,   β = 1, or ½,
//
// a mean over the patch by area, A_cell the face of the patch's cell. With β = 1 the critical step falls to about 0.6
// of what it is without contact, with ½ to 0.8. The half is enough where multipliers come to their places in any case,
// on a way to rest without friction: friction remembers how far a body gave way before, a motion whose loads go on
// shows it, and a static solver has no critical step. κ is that of the first phase, so that forces continue from phase
// to phase.
#pragma once

#include <stillpoint/material.hpp>
#include <stillpoint/problem.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "space/boundary/border_chains.hpp"
#include "space/boundary/border_patches.hpp"
#include "space/boundary/patch_neighbours.hpp"
#include "space/boundary/stiffness_at.hpp"
#include "space/grid/matrix_entries.hpp"

namespace stillpoint {

template <Kinematics K>
class ContactSurface {
  static constexpr int dim = dimensions(K);

 public:
  using Parts = PhaseParts<dim>;
  using Entry = typename CarriedPoint<dim>::Entry;

  using Patch = SurfacePatch;

  /// touched: whether a body may be touched, (bodies); grid: that of the first phase.
  ContactSurface(const Problem& problem, const std::vector<char>& touched, const Grid<dim>& grid);

  bool empty() const { return pieces_.empty(); }
  /// Whether all laws of the present phase are of small strain.
  bool is_of_small_strain() const { return is_of_small_strain_; }
  std::span<const Patch> patches() const { return patches_; }
  std::size_t size() const { return pieces_.size(); }
  /// The length from corner to corner of the grid of the first phase [m].
  double extent() const { return extent_; }
  /// The functions that move the pieces, each once, by the numbers of their first unknowns; and those of the patches,
  /// by their places in that list.
  const std::vector<int>& functions() const { return functions_; }
  const std::vector<int>& functions_of_patches() const { return of_patches_; }
  std::span<const BorderPiece<K>> pieces() const { return pieces_; }
  const BorderPiece<K>& piece(std::size_t s) const { return pieces_[s]; }
  /// The patches around each of them, in the present phase.
  const PatchNeighbours& neighbours() const { return neighbours_; }
  /// The area of piece s when the phase began [m²], and its normal, outwards.
  double area(std::size_t s) const { return area_[s]; }
  Point<dim> normal(std::size_t s) const {
    Point<dim> n;
    for (std::size_t d = 0; d < dim; ++d) n[d] = pieces_[s].vector[d] / area_[s];
    return n;
  }
  /// The position of piece s when the phase began [m].
  Point<dim> start(std::size_t s) const { return pieces_[s].place(); }
  /// The position of piece s at u, over the grid's functions [m].
  Point<dim> position(std::size_t s, const double* u) const {
    Point<dim> x = start(s);
    for (std::size_t e = begin_[s]; e < begin_[s + 1]; ++e) {
      const double* const of_function = u + weights_[e].first_unknown;
      for (int i = 0; i < dim; ++i) x[i] += weights_[e].w * of_function[i];
    }
    return x;
  }
  /// The change of that position in the direction du.
  Point<dim> motion(std::size_t s, const double* du) const {
    Point<dim> dx{};
    for (std::size_t e = begin_[s]; e < begin_[s + 1]; ++e) {
      for (int i = 0; i < dim; ++i) dx[i] += weights_[e].w * du[weights_[e].first_unknown + i];
    }
    return dx;
  }
  /// Adds the force f at piece s to R, (n), and to the reactions of supports that hold its functions, (prescribed or
  /// more); those may be empty.
  void add(std::size_t s, const Point<dim>& f, Vec R, Vec reactions) const {
    for (std::size_t e = sources_begin_[s]; e < sources_begin_[s + 1]; ++e) {
      const Source& source = sources_[e];
      const auto dof = static_cast<std::size_t>(source.dof);
      if (dof < R.size()) {
        R[dof] += source.w * f[source.component];
      } else if (dof - R.size() < reactions.size()) {
        reactions[dof - R.size()] += source.w * f[source.component];
      }
    }
  }
  /// Appends the entries of the matrix of a spring with the stiffness S at piece s [N/m].
  template <class Matrix>
  void add_entries(std::size_t s, const Matrix& S, MatrixEntries& entries) const {
    for_free(s, [&](int i, int row, double w_row) {
      for_free(s, [&](int j, int column, double w_column) {
        if (S(i, j) != 0) entries.emplace_back(row, column, w_row * S(i, j) * w_column);
      });
    });
  }
  /// The product with du, and the entries, of springs that hold each piece in all directions, with A κ.
  void add_product_held(const double* du, Vec dR) const;
  void add_entries_held(MatrixEntries& entries) const;
  /// Calls visit(component, degree of freedom, weight) for what is free at piece s.
  template <class Visit>
  void for_free(std::size_t s, const Visit& visit) const {
    for (std::size_t e = sources_begin_[s]; e < sources_begin_[s + 1]; ++e)
      if (sources_[e].dof < free_) visit(sources_[e].component, sources_[e].dof, sources_[e].w);
  }

  /// Freezes the pieces; in the first phase their stiffness is found.
  void begin_phase(const Parts& phase, const StiffnessBound& stiffness_bound);
  /// From now on and up to the end of the phase positions are relative to others: x_s − Σ w_m u_m, with the entries of
  /// each piece's partner, (pieces). The pieces themselves move on with the body.
  void move_relative_to(const Parts& phase, const std::vector<std::vector<Entry>>& partners) {
    take_weights(phase, &partners);
    take_functions();
  }
  /// Sets κ of each patch to that of itself and another stiffness in series.
  void put_in_series(double stiffness);
  /// The mean of κ by area.
  double mean_stiffness() const;
  /// Finds growth() anew, once the phase has begun.
  void take_growth(const Parts& phase);
  /// The factor by which ω_max² may have grown through the springs of all pieces since the first phase.
  double growth() const { return growth_; }
  /// Moves the pieces at the end of a phase; in_place: of a stage of small strain, whose points stay where they are. u:
  /// over the grid's functions.
  void end_phase(const double* u, bool in_place);
  /// Before the first phase: moves the borders of bodies that another run has left from where they were placed, and
  /// cuts them anew.
  void leave_placed(const WaysSincePlaced<dim>& ways);
  /// Moves them by ways of their own besides, (pieces) or empty [m].
  template <class Position>
  void move(const std::vector<Position>& ways) {
    for (std::size_t s = 0; s < ways.size(); ++s)
      for (int i = 0; i < dim; ++i) pieces_[s].at.x[static_cast<std::size_t>(i)] += ways[s][i];
  }
  /// Cuts borders in the plane anew where they have stretched or shrunk (border_chain.hpp); after they have moved.
  /// Where the pieces come from, (pieces); empty if they are what they were.
  std::vector<PieceOrigin> cut_anew() { return chains_.cut_anew(pieces_, patches_); }
  /// By how much a piece has been drawn out; 1 where borders are cut anew.
  double stretch(std::size_t s) const {
    return chains_.empty() ? std::pow(pieces_[s].size() / pieces_[s].area, 1.0 / std::max(1, dim - 1)) : 1;
  }
  /// The part of the surface that is the border of a body.
  struct Part {
    std::size_t body, number;  // in the present stage, and in all of them
    std::size_t first_patch, end_patch;
    std::size_t first_piece, end_piece;
  };
  /// In the order of the bodies, without those that may not be touched.
  std::vector<Part> parts() const;
  static std::string name_of(const Part& part);
  void archive(const StateArchive& state) { archive_parts(state, /*some_are_new=*/false); }
  /// Before the first phase of a stage: takes over the borders that the stage before had, as archive() saved them.
  void take_over(const StateArchive& state);

 private:
  using Partners = std::vector<std::vector<Entry>>;
  struct Weight {
    int first_unknown;  // dim × function
    double w;
  };
  struct Source {
    int component, dof;  // dof: free or prescribed, as numbered by DegreesOfFreedom
    double w;
  };

  void archive_parts(const StateArchive& state, bool some_are_new);
  void freeze(const Parts& phase);
  void take_weights(const Parts& phase, const Partners* partners);
  void take_functions();
  void choose_stiffness(const std::vector<double>& G);
  double bound_of_frequency(const Parts& phase) const;

  bool phases_end_, has_begun_ = false, is_of_small_strain_ = false;
  double beta_;
  std::vector<std::size_t> number_of_body_;  // (bodies)
  std::vector<char> has_stiffness_;          // likewise; from the stage before
  int free_ = 0;                             // n
  std::vector<BorderPiece<K>> pieces_;
  std::vector<Patch> patches_;
  std::vector<std::size_t> group_;  // of each patch, those of a cell, where these are domains; else empty
  PatchNeighbours neighbours_;
  BorderChains<K> chains_;             // of all patches, in the plane and with material points; else empty
  std::vector<double> area_;           // (pieces) [m²]
  std::vector<std::size_t> begin_{0};  // first weight of each piece
  std::vector<Weight> weights_;        // of the functions that material reaches
  std::vector<std::size_t> sources_begin_{0};
  std::vector<Source> sources_;
  std::vector<int> functions_, of_patches_;
  double first_bound_ = -1, growth_ = 1, extent_ = 0;
};

}  // namespace stillpoint
