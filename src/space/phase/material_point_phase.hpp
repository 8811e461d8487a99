// Lagrangian phases for one basis and one kinematics: the parts of a phase. Its functions are defined in
// phase_forces.hpp, phase_points.hpp, phase_inertia.hpp, phase_change.hpp, phase_cut_cells.hpp and phase_diagnosis.hpp.
#pragma once

#include <stillpoint/damping.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "linalg/sparse_cholesky.hpp"
#include "scene/controlled_loads.hpp"
#include "scene/throw_scene_error.hpp"
#include "space/boundary/conditions.hpp"
#include "space/grid/extended_functions.hpp"
#include "space/grid/grid_functions.hpp"
#include "space/grid/layout_of_unknowns.hpp"
#include "space/grid/scene_grid.hpp"
#include "space/kernels/cell_assembly.hpp"
#include "space/kernels/elastic_cells.hpp"
#include "space/kernels/nodal_force.hpp"
#include "space/kernels/nodal_inertia.hpp"
#include "space/kernels/nodal_totals.hpp"
#include "space/kernels/spline_means.hpp"
#include "space/kernels/velocity_transfer.hpp"
#include "space/phase/body_account.hpp"
#include "space/phase/deformation_from_positions.hpp"
#include "space/phase/free_parts.hpp"
#include "space/phase/grid_faces.hpp"
#include "space/phase/lagrangian_phase.hpp"
#include "space/phase/law_gradients.hpp"
#include "space/points/body.hpp"
#include "space/points/next_cells.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
class MaterialPointPhase final : public LagrangianPhase,
                                 private Tangents,
                                 private PhaseControl,
                                 private PhaseDiagnosis {
  static constexpr int Dim = dimensions(K);
  static constexpr int per_cell = PointWeights<B, K>::per_cell;
  static constexpr int components = stillpoint::gradient_components(K);
  using Basis = TensorBasis<B, Dim>;
  using Block = PointBlock<K>;
  static constexpr bool has_elastic_cells =
      (K == Kinematics::plane || K == Kinematics::space) && std::same_as<B, BSpline<1>>;

 public:
  explicit MaterialPointPhase(const Problem& problem)
      : problem_(without_reference_loads(problem)),
        grid_(grid_at<Dim>(problem, 0)),
        body_(make_body<K>(problem, grid_, problem.phase.ends())),
        transfer_(problem.phase, !is_undamped(problem.damping.strategy)),
        inertia_(problem.mass, problem.phase.ends()),
        conditions_(problem_, problem, grid_, body_, account().shortest_time()),
        depths_(problem_) {
    info_ = account().describe(conditions_.hold_by_springs());
    history_dependent_ =
        std::ranges::any_of(body_.materials, [](const auto& law) { return law->info().history_dependent; });
    depths_.begin(body_.first_number, origin_);
    extend_into_slivers();
    if (updated_lagrangian()) origin_ = account().positions(points());
    if (problem_.geostatic) set_geostatic_stress(problem_, body_);
    if (updated_lagrangian()) set_initial_velocity(problem_, body_);
    begin_phase(0);
  }

  // --- SemiDiscrete, see phase_forces.hpp ----------------------------------------------------------
  std::size_t size() const override { return dofs_->size(); }
  const Mass& mass() const override { return *mass_; }
  void external_force(double t, ConstVec u, Vec F) const override;
  bool loads_are_constant() const override { return conditions_.loads_are_constant(); }
  std::unique_ptr<TrialState> make_trial() const override;
  bool internal_force(double t, ConstVec u, Vec R, TrialState& trial) const override;
  void commit(TrialState& trial) override;
  bool history_dependent() const override { return history_dependent_; }
  const Tangents& tangents() const override { return *this; }
  const PhaseDiagnosis& diagnosis() const override { return *this; }
  void add_support_inertia(double t, double c, Vec Q) const override;
  const Contact* contact() const override { return conditions_.contact(); }
  Contact* contact() override { return conditions_.contact(); }

  // --- LagrangianPhase, see phase_points.hpp -------------------------------------------------------
  Discretisation discretisation() const override;
  NodalLayout layout() const override { return layout_of(functions_, *dofs_); }
  PointData point_data() const override { return account().point_data(points(), origin_); }
  void point_field(PointQuantity quantity, double t, ConstVec nodal, Vec out) const override;
  void point_history(const std::string& name, Vec out) const override { account().history(name, out); }
  std::unique_ptr<PlaceReader> read_places(double t, ConstVec u, ConstVec v) const override;  // phase_places.hpp
  double null_space_stress(double t, ConstVec u) const override;
  std::optional<OverStress> over_stress() const override;  // over_stress.hpp
  std::vector<double> initial_displacement(double t) const override;
  std::vector<double> initial_velocity(double t) override;
  std::vector<WallReaction> wall_reactions(double t) const override { return conditions_.wall_reactions(t); }
  std::vector<double> support_displacements(double t) const override {
    return conditions_.support_displacements(held_, t);
  }
  std::vector<SupportReaction> support_reactions(double t, ConstVec u, ConstVec reactions) const override {
    spread(t, u, grid_u_);
    return conditions_.support_reactions(parts(), t, grid_u_.data(), reactions);
  }
  std::vector<WeakSupport> weak_supports(double t, ConstVec u) const override {
    spread(t, u, grid_u_);
    return conditions_.weak_supports(t, grid_u_.data());
  }
  std::optional<LoadState> load_state(double t, ConstVec u) const override {
    if (!conditions_.are_driven()) return std::nullopt;
    spread(t, u, grid_u_);
    return conditions_.load_state(t, grid_u_.data());
  }
  std::vector<FreePart> free_parts() const override;
  std::vector<BodyGap> body_gaps() const override;  // phase_bodies.hpp
  std::vector<HeldAxes> held_bodies() const override;
  double stiffening(double t, ConstVec u) const override;
  PhaseControl& control() override { return *this; }
  const PhaseControl& control() const override { return *this; }

 private:
  // The arrays of a trial. Two are enough for any run: one that evaluations write to, one that is committed.
  struct TrialArrays {
    std::vector<double> u;                     // over the grid's functions, (functions × Dim)
    std::vector<std::vector<double>> history;  // of each material
    std::vector<double> averages;              // effect of MeanDilatation on each point, if points share their
                                               // dilatation
  };
  struct Trial final : TrialState {
    const MaterialPointPhase* of = nullptr;
    long phase = 0;
    bool evaluated = false;
    double motion = 0;          // the largest motion [cells], if it ends the phase
    bool keeps_history = true;  // false if the trial holds nothing that was not committed before
    std::shared_ptr<TrialArrays> arrays;
  };
  Trial& own(TrialState& trial) const {
    const auto mine = dynamic_cast<Trial*>(&trial);
    if (!mine || mine->of != this || mine->phase != phase_)
      throw std::logic_error("a trial state that was made for another phase");
    return *mine;
  }

  // --- the law of a block of points, phase_dilatation.hpp ------------------------------------------
  bool averages_dilatation() const { return Dim > 1 && problem_.phase.dilatation != Dilatation::points; }
  bool means_over_splines() const {
    return Dim > 1 && problem_.phase.dilatation == Dilatation::splines && B::degree > 1;
  }
  template <class Use>
  auto with_means(std::size_t m, const Block& block, const typename SplinePass<B, K>::Known& known,
                  const Use& use) const;
  void average_dilatation(std::size_t m, Block& block) const;
  void begin_means();
  void take_means(const double* u) const;
  void take_rates_of_means(const double* u, const double* du) const;
  void take_shares(const double* u, double dt) const;
  void add_means_of(const Block& block, typename Block::Row& x) const;
  bool add_shared_forces(const double* u, Vec R, Vec reactions) const;
  SharedDilatation<B, K> shared_dilatation(const double* u) const;
  template <bool Increments>
  double stress(std::size_t m, Block& block, double dt, double* history, double* averages) const;
  void tangent(Tangent kind, std::size_t m, Block& block, double dt) const;

  // --- the matrix of that law, phase_dilatation_matrix.hpp -----------------------------------------
  SparseMatrix matrix_of_means(Tangent kind, double dt) const;
  SparseMatrix matrix_of_spline_means(Tangent kind, double dt) const;
  template <class Visit>
  void for_parts_of_cell(std::size_t k, Block& block, const Visit& visit) const;
  void take_unit(std::size_t k, int b, int i, Block& block) const;
  template <class Mean, class Direct, class Take>
  void answer_columns(Tangent kind, double dt, std::size_t k, Block& block, Mean& mean, int columns,
                      const Direct& direct, const Take& take) const;

  // --- linear elastic cells, phase_forces.hpp ------------------------------------------------------
  void take_elastic_moments();
  auto of_elastic_cells(const std::vector<double>& grid_u) const;
  double* scratch_history(std::size_t m) const;
  bool stands_as_committed(double t, const std::vector<double>& grid_u) const;

  // --- Tangents, see phase_forces.hpp --------------------------------------------------------------
  void apply(Tangent kind, double t, ConstVec u, ConstVec du, Vec dR) const override;
  SparseMatrix matrix(Tangent kind, double t, ConstVec u) const override;
  SparseMatrix of_loads(double t, ConstVec u) const override;

  // --- PhaseControl, see phase_change.hpp ----------------------------------------------------------
  double progress(double t, ConstVec u) override;
  std::vector<double> begin_next(double t, ConstVec u, ConstVec v) override;
  TransferErrors transfer_errors() const override {
    const auto& kept = transfer_.conservation();
    return {kept.mass(), kept.momentum(), kept.angular_momentum(), inertia_.largest_added_mass()};
  }

  void archive(const StateArchive& state) override;  // phase_archive.hpp

  // --- PhaseDiagnosis, see phase_diagnosis.hpp -----------------------------------------------------
  std::string refusal(TrialState& trial) const override;
  PlaceInBody of_unknown(std::size_t k) const override;
  PlaceInBody of_point(std::size_t number) const override;
  std::string refusal_of_motion(ConstVec u) const;
  std::string refusal_at_points(Trial& trial) const;

  bool updated_lagrangian() const { return info_.updated_lagrangian; }
  BodyAccount<K> account() const { return {problem_, grid_, body_}; }
  void extend_into_slivers();
  void begin_phase(double t);
  void place_functions(double t);
  void make_forces(double t);
  std::vector<double> wave_moduli() const;
  void take_saved_grid();
  void resume_phase(double t);
  void make_weights();
  HeldUnknowns take_hold(double t, const std::vector<char>& reached) {
    const FaceGaps<Dim> gaps(functions_, body_.points, weights_, depths_);
    return conditions_.hold(t, functions_, body_.points, weights_, reached, gaps);
  }
  std::vector<char> active_functions() const;
  bool follows_positions();
  void weigh_motion();
  void take_deformation_from_positions();

  std::vector<double> bound_of_functions() const;
  void make_mass();
  std::vector<char> untouched_functions() const;
  std::vector<RelativeInertia> relative_inertia() const;
  bool projects() const { return !problem_.initial_u.empty() || !problem_.initial_v.empty(); }
  std::vector<double> project(const std::vector<Expression>& field, const std::vector<double>& held) const;

  std::vector<double> velocity_from_points(double t);
  void begin_motion(double t, Vec v) { conditions_.begin_motion(parts(), t, v); }

  std::vector<double> nodal_velocity(double t, ConstVec v) const;
  bool is_free() const;
  std::vector<double> impulse(const std::vector<double>& grid_v) const;
  void keep_spin(const std::vector<double>& grid_v);
  bool move_points(const Grid<Dim>& next_grid, const GridFaces<Dim>& faces, const std::vector<double>& grid_v);
  void end_phase(const std::vector<double>& grid_v);
  void move_corners(std::size_t k, std::size_t p);
  void halve_domains();
  void refuse_folded_domains() const;
  void take_materials(const std::vector<int>& from);

  bool is_within_phase(double motion, const double* grid_u) const;
  double largest_motion(ConstVec u) const;
  double spread_and_measure(double t, ConstVec u, std::vector<double>& grid) const;
  double largest_strain(const double* grid_u) const;

  PhaseParts<Dim> parts() const {
    return {grid_, functions_, body_.points, weights_, held_, *dofs_, inertia_.mass(), *mass_, history_dependent_};
  }

  // --- values at the grid's functions and at the points --------------------------------------------
  const PointMaterial<K>& material_of(std::size_t k) const {
    return *body_.materials[static_cast<std::size_t>(body_.points.material_of_cell(k))];
  }
  // Sets the grid's displacements from the free unknowns and the supports at time t.
  void spread(double t, ConstVec u, std::vector<double>& grid) const {
    for_each_index(u.size(),
                   [u, to = grid.data(), number = dofs_->free.data()](std::size_t k) { to[number[k]] = u[k]; });
    spread_others(t, grid);
  }
  // Sets the grid's displacements that are not free from those that are.
  void spread_others(double t, std::vector<double>& grid) const {
    for (std::size_t s = 0; s < dofs_->prescribed.size(); ++s) {
      grid[static_cast<std::size_t>(dofs_->prescribed[s])] = held_.displacement(s, t);
    }
    dofs_->extend(grid.data());
  }
  /// Calls visit(occupied cell, point, number of the point) for all points.
  template <class Visit>
  void for_points(const Visit& visit) const {
    for (std::size_t k = 0; k < body_.points.cells(); ++k) {
      for (std::size_t p = body_.points.begin(k); p < body_.points.end(k); ++p) {
        visit(k, p, static_cast<std::size_t>(body_.points.number[p]));
      }
    }
  }
  /// Writes value_at(occupied cell, point), an array, to out at each point's number; for a point in parts their mean.
  template <class ValueAt>
  void write_points(Vec out, const ValueAt& value_at) const {
    if (body_.points.size() > points()) return write_means(out, value_at);
    for_points([&](std::size_t k, std::size_t p, std::size_t number) {
      const auto value = value_at(k, p);
      std::copy(value.begin(), value.end(), out.begin() + static_cast<std::ptrdiff_t>(value.size() * number));
    });
  }
  template <class ValueAt>
  void write_means(Vec out, const ValueAt& value_at) const {
    std::vector<double> mass(points(), 0);
    for_points([&](std::size_t, std::size_t p, std::size_t number) { mass[number] += body_.points.mass[p]; });
    std::ranges::fill(out, 0.0);
    for_points([&](std::size_t k, std::size_t p, std::size_t number) {
      const auto value = value_at(k, p);
      const double share = body_.points.mass[p] / mass[number];
      for (std::size_t i = 0; i < value.size(); ++i) out[value.size() * number + i] += share * value[i];
    });
  }

  const Problem problem_;
  bool history_dependent_ = false;
  double grid_moved_ = 0;  // displacement of the wall that the grid follows [m]
  Grid<Dim> grid_;
  const FunctionsOfBasis<B, Dim> functions_{grid_};
  Body<K> body_;
  VelocityTransfer<B, K> transfer_;
  NodalInertia<B, K> inertia_;
  Conditions<K> conditions_;
  PointOrder<Dim> order_;
  // Positions at the start of the run, by the points' numbers, (P × Dim); empty if points do not move on.
  std::vector<double> origin_;
  long looks_ = 0;  // number of times that progress() looked at the strain
  SurfaceDepths<Dim> depths_;
  DeformationFromPositions<B, K> deformation_;
  double motion_since_deformation_ = 0;  // since the deformation was taken from the positions, at most [cells]

  ExtendedFunctions extension_;  // into slivers of a body with a single phase

  // The present phase:
  long phase_ = 0;
  PointWeights<B, K> weights_;
  NodalTotals<B, K> totals_;                                 // sums over the points when the phase begins
  ElasticCells<has_elastic_cells ? Dim : 2> elastic_cells_;  // for a linear body in bilinear or trilinear cells
  HeldUnknowns held_;
  std::vector<char> reached_, untouched_;  // whether reached by a point, and whether touched by neither support nor
                                           // wall, (functions)
  std::optional<DegreesOfFreedom> dofs_;
  std::vector<double> motion_weight_;      // motion of points per unit of each unknown, at most, in cells, (n) [1/m]
  std::vector<double> constant_force_;     // constant part of F, (n)
  std::optional<SplitMatrix> consistent_;  // M as assembled, if projections or moving supports need it
  std::optional<Mass> mass_;
  std::vector<double> start_velocity_;  // over the grid's functions, (functions × Dim)
  std::vector<double> committed_u_;     // u of the last commit over the grid's functions, (functions × Dim)
  double committed_t_ = 0, committed_motion_ = 0;
  // If points share their change of volume: V/W of cells, or splines, and the effect of averaging in the committed
  // state.
  std::vector<double> volume_share_, committed_averages_;
  SplineMeans<B, K> splines_;

  // Work arrays, sized once a phase; they keep evaluations of one phase from running in several threads at once.
  mutable NodalForce<B, K> nodal_force_;
  mutable std::vector<double> grid_u_, grid_du_;  // (functions × Dim)
  // Coefficients of means over splines: of the state, its shares, and their derivatives.
  mutable std::vector<double> means_, shares_, rates_of_means_, rates_of_shares_;
  mutable std::vector<double> shared_forces_;                 // (n + supports)
  mutable std::shared_ptr<TrialArrays> spare_;                // arrays of the first trial, kept for that of the next
                                                              // phase
  mutable std::vector<std::vector<double>> scratch_history_;  // for each material, a history that is written but never
                                                              // read
  mutable double undeformed_bound_ = 0;
};

}  // namespace stillpoint
