// What is frozen when a phase begins: the grid, the points, the weights of the grid's functions at them, and which of
// the grid's unknowns are free.
#pragma once

#include <stillpoint/problem.hpp>

#include <algorithm>
#include <utility>
#include <vector>

#include "parallel/of_all.hpp"
#include "space/grid/extended_functions.hpp"
#include "space/grid/grid_functions.hpp"
#include "space/grid/scene_grid.hpp"
#include "space/kernels/corner_sum.hpp"
#include "space/kernels/extended_sums.hpp"
#include "space/kernels/nodal_totals.hpp"
#include "space/kernels/point_weights.hpp"
#include "space/phase/body_account.hpp"
#include "space/phase/initial_state.hpp"
#include "space/phase/phase_unknowns.hpp"
#include "space/points/make_body.hpp"
#include "space/points/migration.hpp"
#include "space/points/numbered_cells.hpp"
#include "space/points/rank_cells.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
struct PhaseFrame {
  static constexpr int dim = dimensions(K);
  using Basis = TensorBasis<B, dim>;

  /// Places the bodies, or takes those that a stage has left; the problem and the ranks must outlive this object. All
  /// points are here until they are shared out.
  PhaseFrame(const Problem& of, const CarriedBodyOf<K>* carried, const Ranks* of_ranks)
      : problem(of),
        ranks(of_ranks),
        grid_moved(carried ? carried->grid_moved() : 0),
        grid(NumberedCells<dim>::around_shapes(of, saved_grid_at<dim>(of, grid_moved), carried != nullptr)),
        body(make_body<K>(of, grid, of.phase.ends(), carried)),
        remembers(std::ranges::any_of(body.materials, [](const auto& law) { return law->info().history_dependent; })),
        total_mass(account().total_mass()),
        phase(carried ? carried->phase() : 0) {
    if (moves_on()) origin = account().positions();
    if (carried) take_ways(*carried);
    if (begins_from_other_run(carried)) where_placed_ = account().positions();
    set_initial_state(problem, body, origin);
    if (!carried) notes = notes_on_initial_stress(problem, body);
    for (const auto& material : body.materials) wave_moduli.push_back(material->wave_modulus());
  }
  PhaseFrame(const PhaseFrame&) = delete;
  PhaseFrame& operator=(const PhaseFrame&) = delete;

  /// Whether what it is given are the points of another run, and not of a stage of this one.
  bool begins_from_other_run(const CarriedBodyOf<K>* carried) const {
    return carried && carried->phase() == 0 && !problem.initial_from.empty();
  }
  /// Leaves each rank with its own points.
  void share_out_points() {
    if (!ranks) return;
    cells_of_ranks = RankCells<dim>(grid, ranks->count());
    Migration<K>(*ranks, body).share_out(cells_of_ranks, grid);
  }

  /// Calls take() while each rank has the points of all, as one process would have them.
  template <class Take>
  void with_points_of_all(const Take& take) {
    if (ranks) Migration<K>(*ranks, body).gather(grid);
    take();
    if (ranks) Migration<K>(*ranks, body).keep_own(cells_of_ranks, grid);
  }

  /// Evaluates the weights of the points where they are now, and the sums over the points at the grid's functions.
  void make_weights() {
    totals.begin(grid, body.points, weights, wave_moduli);
    number_corners();
    totals.sum(corner_sum);
  }
  /// Whether a point gives a function mass or stiffness, (functions).
  std::vector<char> reached_functions() const {
    std::vector<char> reached(functions_of_grid());
    for (std::size_t f = 0; f < reached.size(); ++f) reached[f] = static_cast<char>(totals.reaches(f));
    return reached;
  }

  /// The positions of the points to which the shapes of the scene's bodies belong, as `origin` has them: bodies of
  /// another run are where they are, however they have come there.
  const std::vector<double>& within_shapes() const { return where_placed_.empty() ? origin : where_placed_; }

  std::size_t functions_of_grid() const { return static_cast<std::size_t>(functions.count()); }
  bool moves_on() const { return problem.phase.ends(); }
  /// Whether the laws are those of small strain, whose positions stay what they are.
  bool is_of_small_strain() const {
    return std::ranges::none_of(
        body.materials, [](const auto& law) { return law->info().finite_strain || law->info().history_dependent; });
  }
  std::size_t size() const { return unknowns.size(); }
  const DegreesOfFreedom& dofs() const { return unknowns.dofs(); }
  const HeldUnknowns& held() const { return unknowns.held(); }
  BodyAccount<K> account() const { return {problem, grid, body, ranks}; }
  const PointMaterial<K>& material_of(std::size_t k) const {
    return *body.materials[static_cast<std::size_t>(body.points.material_of_cell(k))];
  }
  /// The stiffness bound of each function, with that of extended functions added to their sources, (functions) [N/m].
  std::vector<double> bound_of_functions() const {
    if (extension.empty()) return totals.bound();
    return stiffness_bound<B, K>(body.points, weights, corner_sum, wave_moduli, extension);
  }

  /// Calls visit(occupied cell, point, number of the point) for all points.
  template <class Visit>
  void for_points(const Visit& visit) const {
    stillpoint::for_points(body.points, visit);
  }

  const Problem& problem;
  const Ranks* const ranks;  // that share the points; null: this one has them all
  RankCells<dim> cells_of_ranks;
  double grid_moved;  // displacement of the wall that the grid follows [m]
  Grid<dim> grid;
  Body<K> body;
  const FunctionsOfBasis<B, dim> functions{grid, body.fields};
  const bool remembers;     // whether some of the points have a history
  const double total_mass;  // Σ_p m_p at the start of the stage [kg]
  /// The wave modulus of each material when the stage begins, by which masses are chosen; if the ground becomes
  /// stiffer, the step becomes shorter [Pa].
  std::vector<double> wave_moduli;
  // Positions at the start of the run, by the points' numbers, (P × dim); empty if points do not move on.
  std::vector<double> origin;
  // Where bodies were placed, likewise, if displacements count from later on, as another run has forgotten them; else
  // empty.
  std::vector<double> placed;
  // The ways that points of small strain have gone before, which stay where they are, likewise [m]; else empty.
  std::vector<double> gone;
  std::vector<std::string> notes;  // on the stress that the points begin with
  long phase;                      // number of the phase
  PointWeights<B, K> weights;
  CornerSum corner_sum;
  NodalTotals<B, K> totals;     // sums over the points when the phase begins
  ExtendedFunctions extension;  // into slivers of a body with a single phase
  PhaseUnknowns unknowns{dim};

 private:
  void take_ways(const CarriedBodyOf<K>& carried) {
    const std::vector<double> now = origin;
    if (carried.has_forgotten()) {
      placed = now;
      carried.take_placed(problem, body.first_number, placed);
    }
    carried.take_origin(problem, body.first_number, origin);
    if (!carried.is_in_place()) return;
    gone = now;
    for (std::size_t i = 0; i < gone.size(); ++i) gone[i] -= placed.empty() ? origin[i] : placed[i];
  }
  // The corners are sorted anew only if some cell has other functions than before.
  void number_corners() {
    constexpr int per_cell = Basis::per_cell;
    const MaterialPoints<dim>& points = body.points;
    const std::size_t count = functions_of_grid();
    bool as_before = corner_sum.functions() == count && function_of_corner_.size() == per_cell * points.cells();
    function_of_corner_.resize(per_cell * points.cells());
    for (std::size_t k = 0; k < points.cells(); ++k) {
      for (int a = 0; a < per_cell; ++a) {
        const int function = weights.function(k, a);
        as_before =
            std::exchange(function_of_corner_[per_cell * k + static_cast<std::size_t>(a)], function) == function &&
            as_before;
      }
    }
    if (is_so_for_all(ranks, as_before)) return;
    corner_sum.rebuild(function_of_corner_, count, ranks, ranks ? places_of_cells(points) : std::vector<CellPlace>());
  }

  std::vector<double> where_placed_;     // of bodies of another run: within_shapes(); else empty
  std::vector<int> function_of_corner_;  // (cells × per_cell)
};

}  // namespace stillpoint
