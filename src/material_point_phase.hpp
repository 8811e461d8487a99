// Lagrangian phases for one basis and one kind of kinematics.
#pragma once

#include <stillpoint/lagrangian_phase.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "body.hpp"
#include "boundary.hpp"
#include "cell_assembly.hpp"
#include "degrees_of_freedom.hpp"
#include "external_loads.hpp"
#include "nodal_force.hpp"
#include "nodal_inertia.hpp"
#include "prescribed_motion.hpp"
#include "reject.hpp"
#include "scene_grid.hpp"
#include "velocity_transfer.hpp"
#include "wall_contact.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
class MaterialPointPhase final : public LagrangianPhase {
  static constexpr int Dim = dimensions(K);
  static constexpr int per_cell = PointWeights<B, K>::per_cell;
  static constexpr int components = stillpoint::gradient_components(K);
  using Basis = TensorBasis<B, Dim>;
  using Block = PointBlock<K>;

 public:
  explicit MaterialPointPhase(const Scene& scene)
      : scene_(scene),
        moves_on_(scene.phase.max_motion || scene.phase.max_strain),
        grid_(grid_at<Dim>(scene, 0)),
        body_(make_body<K>(scene, grid_, moves_on_)),
        transfer_(scene.phase),
        inertia_(scene.mass, moves_on_),
        loads_(scene_, grid_),
        boundary_(scene, time_scale()) {
    for (const auto& material : body_.materials) {
      history_dependent_ = history_dependent_ || material->history_dependent();
      finite_strain_ = finite_strain_ || material->finite_strain();
    }
    initial_mass_ = total_mass();
    origin_ = places();
    if (scene_.geostatic) set_geostatic_stress();
    if (moves_on_) set_initial_point_velocity();
    begin_phase(0);
  }

  // --- SemiDiscrete -------------------------------------------------------------------------------
  std::size_t size() const override { return dofs_->size(); }
  const Mass& mass() const override { return *mass_; }
  bool history_dependent() const override { return history_dependent_; }

  void external_force(double t, Vec F) const override { loads_.evaluate(t, body_.points, weights_, *dofs_, F); }
  void add_following_force(double t, ConstVec u, Vec F) const override {
    if (!loads_.follow()) return;
    spread(t, u, grid_u_);
    loads_.add_following(t, grid_u_.data(), *dofs_, F);
  }

  bool internal_force(double t, ConstVec u, Vec R) const override {
    spread(t, u, grid_u_);
    const double* V = body_.points.volume.data();
    if (history_dependent_) {
      last_t_ = t;
      const double dt = t - committed_t_;
      const auto stress = [&, V, dt](std::size_t m, Block& block) { return body_.materials[m]->stress(block, V, dt); };
      return nodal_force_.template evaluate<true>(grid_u_.data(), committed_u_.data(), stress, *dofs_, R);
    }
    const auto stress = [&, V](std::size_t m, Block& block) { return body_.materials[m]->stress(block, V, 0); };
    return nodal_force_.template evaluate<false>(grid_u_.data(), nullptr, stress, *dofs_, R);
  }

  void tangent(double t, ConstVec u, ConstVec du, Vec dR) const override {
    spread(t, u, grid_u_);
    // u and u − du, of which the difference is the direction
    grid_work_ = grid_u_;
    for (std::size_t k = 0; k < du.size(); ++k) grid_work_[static_cast<std::size_t>(dofs_->free[k])] -= du[k];
    const double* V = body_.points.volume.data();
    const auto answer = [&, V](std::size_t m, Block& block) {
      body_.materials[m]->tangent(block, V);
      return 0.0;
    };
    nodal_force_.template evaluate<true>(grid_u_.data(), grid_work_.data(), answer, *dofs_, dR);
  }

  // K_ai,bk = Σ_p V_p G_a,i,c (∂P_c/∂H_d) G_b,k,d with H_c = Σ_a,i G_a,i,c u_a,i
  SparseMatrix tangent_matrix(double t, ConstVec u) const override {
    spread(t, u, grid_u_);
    const auto add_point = [&](std::size_t k, std::size_t p, CellMatrix<Dim, per_cell>& matrix) {
      const auto A = material_of(k).moduli(weights_.gradient(grid_u_.data(), k, p), p);
      std::array<TensorOf<K>, Dim * per_cell> G{};
      const double* dN = weights_.dN(p);
      for (int a = 0; a < per_cell; ++a) {
        for (int i = 0; i < Dim; ++i) {
          for (int j = 0; j < Dim; ++j) G[Dim * a + i][Dim * i + j] = dN[per_cell * j + a];
        }
        if constexpr (K == Kinematics::axisymmetric) G[Dim * a][Dim * Dim] = dN[per_cell * Dim + a];
      }
      for (int row = 0; row < Dim * per_cell; ++row) {
        TensorOf<K> left{};  // V G A
        for (int c = 0; c < components; ++c) {
          if (G[row][c] == 0) continue;
          for (int d = 0; d < components; ++d) left[d] += body_.points.volume[p] * G[row][c] * A[components * c + d];
        }
        for (int column = 0; column < Dim * per_cell; ++column) {
          for (int d = 0; d < components; ++d) matrix[row][column] += left[d] * G[column][d];
        }
      }
    };
    return assemble_cells<B, K>(body_.points, weights_, *dofs_, add_point).free;
  }

  void commit(double t, ConstVec u) override {
    if (!history_dependent_) return;
    std::vector<double> R(size());
    internal_force(t, u, R);
    commit_last();
  }
  // What internal_force() was last evaluated at is in grid_u_, which every use fills anew.
  void commit_last() override {
    if (!history_dependent_) return;
    for (const auto& material : body_.materials) material->commit();
    committed_u_.swap(grid_u_);
    committed_t_ = last_t_;
  }

  void add_support_inertia(double t, double c, Vec Q) const override {
    if (consistent_.prescribed.nonZeros() == 0 || mass_->is_lumped()) return;
    for (std::size_t s = 0; s < boundary_.prescribed().size(); ++s) {
      const PrescribedMotion& motion = boundary_.motion_of(s);
      if (!motion.moves()) continue;
      const double pull = motion.acceleration(t) + c * motion.velocity(t);
      for (SparseMatrix::InnerIterator m(consistent_.prescribed, static_cast<Eigen::Index>(s)); m; ++m) {
        Q[static_cast<std::size_t>(m.row())] -= m.value() * pull;
      }
    }
  }
  bool has_contact() const override { return !boundary_.walls().empty(); }
  void add_contact_force(double t, const LinearDamping& C, Vec Q) const override {
    for (const WallContact& wall : boundary_.walls()) wall.add_force(t, C, *mass_, Q);
  }
  void hold_contact(Vec Q) const override {
    for (const WallContact& wall : boundary_.walls()) wall.hold(Q);
  }
  bool update_contact(double t, ConstVec u, Vec v) override {
    bool changed = false;
    for (WallContact& wall : boundary_.walls()) changed = wall.update(t, u, v) || changed;
    return changed;
  }

  double reaction_norm() const override {
    double sum = 0;
    for (const double reaction : nodal_force_.reactions()) sum += reaction * reaction;
    for (const WallContact& wall : boundary_.walls()) sum += wall.square_of_forces();
    return std::sqrt(sum);
  }

  // --- LagrangianPhase ----------------------------------------------------------------------------
  int dim() const override { return Dim; }
  int gradient_components() const override { return components; }
  int stress_components() const override { return stillpoint::stress_components(K); }
  std::size_t points() const override { return body_.points.size(); }
  std::vector<double> places() const override {
    std::vector<double> out(Dim * points());
    for_points([&](std::size_t, std::size_t p, std::size_t number) {
      for (int d = 0; d < Dim; ++d) out[Dim * number + d] = body_.points.x[d][p];
    });
    return out;
  }
  std::vector<double> places_at_start() const override { return origin_; }
  std::vector<double> volumes() const override {
    std::vector<double> out(points());
    for_points([&](std::size_t, std::size_t p, std::size_t number) { out[number] = body_.points.volume[p]; });
    return out;
  }
  std::vector<int> materials() const override {
    std::vector<int> out(points());
    for_points([&](std::size_t k, std::size_t, std::size_t number) { out[number] = body_.points.material_of_cell(k); });
    return out;
  }
  double total_mass() const override {
    // in the order of the points' numbers, which does not change
    std::vector<double> m(points());
    for_points([&](std::size_t, std::size_t p, std::size_t number) { m[number] = body_.points.mass[p]; });
    return sum_over(m.size(), [&](std::size_t p) { return m[p]; });
  }

  void point_displacement(double t, ConstVec u, Vec out) const override {
    spread(t, u, grid_u_);
    for_points([&](std::size_t k, std::size_t p, std::size_t number) {
      const auto u_p = weights_.value(grid_u_.data(), k, p);
      for (int i = 0; i < Dim; ++i) {
        out[Dim * number + i] = moves_on_ ? body_.points.x[i][p] - origin_[Dim * number + i] + u_p[i] : u_p[i];
      }
    });
  }
  void point_velocity(double t, ConstVec v, Vec out) const override {
    const std::vector<double> grid_v = nodal_velocity(t, v);
    for_points([&](std::size_t k, std::size_t p, std::size_t number) {
      const auto v_p = weights_.value(grid_v.data(), k, p);
      std::copy(v_p.begin(), v_p.end(), out.begin() + static_cast<std::ptrdiff_t>(Dim * number));
    });
  }
  void point_strain(double t, ConstVec u, Vec out) const override {
    spread(t, u, grid_u_);
    for_points([&](std::size_t k, std::size_t p, std::size_t number) {
      const auto H = weights_.gradient(grid_u_.data(), k, p);
      std::copy(H.begin(), H.end(), out.begin() + static_cast<std::ptrdiff_t>(components * number));
    });
  }
  void point_stress(double t, ConstVec u, Vec out) const override {
    spread(t, u, grid_u_);
    for_points([&](std::size_t k, std::size_t p, std::size_t number) {
      const auto sigma = material_of(k).cauchy(weights_.gradient(grid_u_.data(), k, p), p);
      std::copy(sigma.begin(), sigma.end(), out.begin() + static_cast<std::ptrdiff_t>(sigma.size() * number));
    });
  }
  std::vector<std::string> history_names() const override {
    std::set<std::string> names;
    for (const auto& material : body_.materials) {
      for (const auto& [name, values] : material->shown_history()) names.insert(name);
    }
    return {names.begin(), names.end()};
  }
  void point_history(const std::string& name, Vec out) const override {
    std::ranges::fill(out, 0.0);
    for (std::size_t m = 0; m < body_.materials.size(); ++m) {
      const auto begin = static_cast<std::size_t>(body_.points.material_begin[m]);
      for (const auto& [shown, values] : body_.materials[m]->shown_history()) {
        if (shown != name) continue;
        for (std::size_t k = 0; k < values.size(); ++k) {
          out[static_cast<std::size_t>(body_.points.number[begin + k])] = values[k];
        }
      }
    }
  }

  std::vector<double> initial_displacement(double t) const override {
    std::vector<double> held;
    for (std::size_t s = 0; s < boundary_.prescribed().size(); ++s)
      held.push_back(boundary_.motion_of(s).displacement(t));
    return project(scene_.initial_u, held);
  }
  std::vector<double> initial_velocity(double t) override {
    if (moves_on_) return velocity_from_points(t);
    std::vector<double> held;
    for (std::size_t s = 0; s < boundary_.prescribed().size(); ++s) held.push_back(boundary_.motion_of(s).velocity(t));
    std::vector<double> v = project(scene_.initial_v, held);
    begin_contact(t, v);
    return v;
  }

  bool moves_on() const override { return moves_on_; }

  double share_of_phase(double t, ConstVec u) const override {
    if (!moves_on_) return 0;
    if (scene_.phase.max_motion && *scene_.phase.max_motion == 0) return 1;
    // A step moves a node by a small share of a cell, so that not every one has to be looked at.
    constexpr long between_looks = 4, between_looks_at_strain = 8;
    if (++looks_ % between_looks != 0) return 0;
    double share = 0;
    if (scene_.phase.max_motion) share = largest_motion(u) / *scene_.phase.max_motion;
    if (scene_.phase.max_strain && looks_ % between_looks_at_strain == 0) {
      spread(t, u, grid_u_);
      share = std::max(share, largest_strain() / *scene_.phase.max_strain);
    }
    return share;
  }

  std::vector<double> begin_next_phase(double t, ConstVec u, ConstVec v) override {
    end_phase(t, u, v);
    grid_ = grid_at<Dim>(scene_, boundary_.displacement_of(scene_.grid.follow, t));
    check_inside(t);
    order_.sort(body_.points, grid_);
    for (const auto& material : body_.materials) material->reorder(order_.order());
    begin_phase(t);
    return velocity_from_points(t);
  }
  TransferErrors transfer_errors() const override {
    return {transfer_.audit().mass(), transfer_.audit().momentum(), inertia_.largest_added_share()};
  }

  std::vector<WallReaction> wall_reactions(double t) const override {
    std::vector<WallReaction> reactions;
    for (const WallContact& wall : boundary_.walls()) {
      const WallForce force = wall.force();
      reactions.push_back({wall.name(), force.normal, force.shear, wall.power(t)});
    }
    return reactions;
  }

  std::vector<PointArray> point_arrays() const override {
    constexpr double real = sizeof(double);
    std::vector<PointArray> arrays = {{"place", Dim * real},
                                      {"mass", real},
                                      {"volume", real},
                                      {"number", sizeof(int)},
                                      {"weights N", per_cell * real},
                                      {"gradients of N", PointWeights<B, K>::rows * per_cell * real}};
    if (moves_on_) {
      arrays.push_back({"velocity", Dim * real});
      arrays.push_back({"place at the start", Dim * real});
      if (scene_.phase.transfer == Transfer::apic) arrays.push_back({"affine velocity", Dim * Dim * real});
    }
    // What a law keeps counts for the share of points that have it.
    for (std::size_t m = 0; m < body_.materials.size(); ++m) {
      const double share =
          (body_.points.material_begin[m + 1] - body_.points.material_begin[m]) / static_cast<double>(points());
      for (PointArray array : body_.materials[m]->arrays()) {
        array.bytes_per_point *= share;
        arrays.push_back(array);
      }
    }
    return arrays;
  }
  std::size_t supported_degrees_of_freedom() const override { return dofs_->prescribed.size(); }
  std::vector<int> grid_cells() const override {
    std::vector<int> cells;
    for (const Axis& axis : grid_.axes) cells.push_back(axis.cells());
    return cells;
  }
  std::size_t occupied_cells() const override {
    return std::set<int>(body_.points.cell.begin(), body_.points.cell.end()).size();
  }
  QuadratureReport quadrature() const override { return body_.quadrature; }
  bool nonlinear() const override { return finite_strain_ || history_dependent_; }
  // With history the elastic part is small, and what it yields only softens.
  bool stiffens() const override { return finite_strain_ && !history_dependent_; }
  double stiffening(double t, ConstVec u) const override {
    if (!stiffens()) return 1;
    const auto largest_bound = [&] {
      double largest = 0;
      nodal_force_.visit(grid_u_.data(), [&](std::size_t m, const Block& block) {
        const double bound = body_.materials[m]->stiffness_bound(block);
#pragma omp critical(stillpoint_stiffening)
        largest = bound <= largest ? largest : bound;
      });
      return largest;
    };
    if (!(undeformed_bound_ > 0)) {
      std::ranges::fill(grid_u_, 0.0);
      undeformed_bound_ = largest_bound();
    }
    spread(t, u, grid_u_);
    return largest_bound() / undeformed_bound_;
  }

 private:
  // --- a phase begins -----------------------------------------------------------------------------
  void begin_phase(double t) {
    weights_.rebuild(grid_, body_.points);
    const std::size_t functions = static_cast<std::size_t>(Basis::count(grid_));
    nodal_force_.rebuild(body_.points, weights_, functions);
    boundary_.template begin_phase<Basis>(scene_, grid_, reached_functions(), t);
    dofs_.emplace(reached_unknowns(), boundary_.prescribed());
    grid_u_.assign(Dim * functions, 0);
    nodal_force_.set_prescribed(dofs_->prescribed.size());
    committed_u_.assign(Dim * functions, 0);
    spread_prescribed(t, committed_u_);
    committed_t_ = last_t_ = t;
    make_mass();
    loads_.begin_phase(grid_, body_.points, weights_, *dofs_, inertia_.mass());
  }

  // Every function that a point gives mass to; where nodes get inertia anyhow, every one of a cell with material.
  std::vector<char> reached_functions() const {
    std::vector<char> reached(static_cast<std::size_t>(Basis::count(grid_)), 0);
    for (std::size_t k = 0; k < body_.points.cells(); ++k) {
      for (int a = 0; a < per_cell; ++a) {
        char& of_function = reached[static_cast<std::size_t>(weights_.function(k, a))];
        for (std::size_t p = body_.points.begin(k); p < body_.points.end(k) && !of_function; ++p) {
          of_function = moves_on_ || weights_.N(p)[a] != 0;
        }
      }
    }
    return reached;
  }
  std::vector<char> reached_unknowns() const {
    const std::vector<char> functions = reached_functions();
    std::vector<char> unknowns(Dim * functions.size());
    for (std::size_t unknown = 0; unknown < unknowns.size(); ++unknown) unknowns[unknown] = functions[unknown / Dim];
    return unknowns;
  }

  // A wave's time through half the smallest cell, h/2 √(ρ/A) with the undeformed modulus A: about 1/omega_max [s].
  double time_scale() const {
    double h = std::numeric_limits<double>::infinity(), shortest = h;
    for (const Axis& axis : grid_.axes) {
      for (int c = 0; c < axis.cells(); ++c) h = std::min(h, axis.nodes[c + 1] - axis.nodes[c]);
    }
    for (std::size_t m = 0; m < body_.materials.size(); ++m) {
      const double density = scene_.materials.at(body_.material_names[m]).parameters.at("rho");
      shortest = std::min(shortest, h / 2 * std::sqrt(density / body_.materials[m]->wave_modulus()));
    }
    return shortest;
  }

  void make_mass() {
    std::vector<double> wave_modulus;
    for (const auto& material : body_.materials) wave_modulus.push_back(material->wave_modulus());
    inertia_.begin_phase(body_.points, weights_, nodal_force_.corner_sum(), wave_modulus);
    if (!moves_on_) {
      consistent_ = consistent_mass<B, K>(body_.points, weights_, *dofs_);
      check_projection();
    }
    try {
      if (scene_.mass.kind == MassKind::consistent) {
        mass_.emplace(Mass::consistent(consistent_.free));
      } else {
        std::vector<double> diagonal(size());
        for (std::size_t k = 0; k < diagonal.size(); ++k) {
          diagonal[k] = inertia_.inertia()[static_cast<std::size_t>(dofs_->free[k] / Dim)];
        }
        mass_.emplace(Mass::lumped(std::move(diagonal)));
      }
    } catch (const std::invalid_argument& error) {
      reject(scene_, "mass.kind", error.what());
    }
  }

  // Initial values are fitted with the consistent mass, whatever the motion uses.
  void check_projection() const {
    const bool projects = !scene_.initial_u.empty() || !scene_.initial_v.empty();
    if (!projects || scene_.mass.kind == MassKind::consistent || SparseCholesky(consistent_.free).positive_definite())
      return;
    reject(scene_, "initial",
           "initial values cannot be fitted: too few material points for the basis; expected more points per cell");
  }

  // σ_yy = −ρ b_y (surface − y)  from  ∂σ_yy/∂y + ρ b_y = 0,  σ_xx = σ_zz = K0 σ_yy
  void set_geostatic_stress() {
    if constexpr (Dim == 2) {
      const double b_y = scene_.body_force.at(1)({}, 0);
      for (std::size_t m = 0; m < body_.materials.size(); ++m) {
        const double rho = scene_.materials.at(body_.material_names[m]).parameters.at("rho");
        std::vector<std::array<double, stillpoint::stress_components(K)>> stress;
        for (int p = body_.points.material_begin[m]; p < body_.points.material_begin[m + 1]; ++p) {
          const double depth = scene_.geostatic->surface - body_.points.x[1][static_cast<std::size_t>(p)];
          const double vertical = rho * b_y * std::max(0.0, depth), side = scene_.geostatic->K0 * vertical;
          stress.push_back({side, vertical, side, 0});
        }
        body_.materials[m]->set_stress(stress);
      }
    }
  }

  // --- velocities ---------------------------------------------------------------------------------
  void set_initial_point_velocity() {
    if (scene_.initial_v.empty()) return;
    for (std::size_t p = 0; p < points(); ++p) {
      for (int i = 0; i < Dim; ++i) {
        body_.points.v[i][p] = scene_.initial_v[static_cast<std::size_t>(i)](body_.points.place(p), 0);
      }
    }
  }

  std::vector<double> velocity_from_points(double t) {
    transfer_.audit().compare_mass(initial_mass_, inertia_.mass());
    const std::vector<double> grid_v =
        transfer_.to_grid(grid_, body_.points, weights_, nodal_force_.corner_sum(), inertia_.mass());
    std::vector<double> v(size());
    for (std::size_t k = 0; k < v.size(); ++k) v[k] = grid_v[static_cast<std::size_t>(dofs_->free[k])];
    begin_contact(t, v);
    start_velocity_ = nodal_velocity(t, v);
    return v;
  }
  void begin_contact(double t, Vec v) { boundary_.begin_contact(t, *dofs_, v); }

  // v over the grid's functions.
  std::vector<double> nodal_velocity(double t, ConstVec v) const {
    std::vector<double> grid_v(grid_u_.size(), 0.0);
    for (std::size_t k = 0; k < v.size(); ++k) grid_v[static_cast<std::size_t>(dofs_->free[k])] = v[k];
    for (std::size_t s = 0; s < dofs_->prescribed.size(); ++s) {
      grid_v[static_cast<std::size_t>(dofs_->prescribed[s])] = boundary_.motion_of(s).velocity(t);
    }
    return grid_v;
  }

  // --- a phase ends -------------------------------------------------------------------------------
  // x_p += Σ N_ip u_i,  V_p *= det f_p, and velocities by the scene's transfer
  void end_phase(double t, ConstVec u, ConstVec v) {
    spread(t, u, grid_u_);
    const std::vector<double> grid_v = nodal_velocity(t, v);
    transfer_.to_points(grid_, body_.points, weights_, nodal_force_.corner_sum(), inertia_.mass(), grid_u_.data(),
                        grid_v, start_velocity_);
    nodal_force_.visit(grid_u_.data(), [&](std::size_t m, const Block& block) {
      if (!body_.materials[m]->finite_strain()) return;
      body_.materials[m]->end_phase(block);
      double* V = body_.points.volume.data() + block.first;
      for (std::size_t q = 0; q < block.count; ++q) V[q] *= determinant<K>(plus_identity<K>(block.H_at(q)));
    });
    for_each_block(body_.points.cells(), [&](std::size_t k) {
      for (std::size_t p = body_.points.begin(k); p < body_.points.end(k); ++p) {
        const auto u_p = weights_.value(grid_u_.data(), k, p);
        for (int d = 0; d < Dim; ++d) body_.points.x[d][p] += u_p[d];
      }
    });
    loads_.end_phase(grid_u_.data());
  }

  void check_inside(double t) const {
    for (std::size_t p = 0; p < points(); ++p) {
      for (int d = 0; d < Dim; ++d) {
        const double x = body_.points.x[d][p];
        if (x >= grid_.axes[d].min() && x <= grid_.axes[d].max()) continue;
        throw PointLost(
            fmt::format("at t = {:.6g} s material point {} left the grid at {} = {:.6g}, outside {:.6g} to "
                        "{:.6g}; expected a larger grid, a support or a wall",
                        t, body_.points.number[p] + 1, "xyz"[d], x, grid_.axes[d].min(), grid_.axes[d].max()));
      }
    }
  }

  // Largest |u_i| over a cell's width; no point moves further than the nodes around it where N_i ≥ 0 and Σ N_i = 1.
  double largest_motion(ConstVec u) const {
    std::array<double, Dim> h;
    for (std::size_t d = 0; d < Dim; ++d) h[d] = (scene_.grid.max[d] - scene_.grid.min[d]) / scene_.grid.cells[d];
    const int* number = dofs_->free.data();
    return reduce(
        u.size(), 0.0, [&](std::size_t k) { return std::abs(u[k]) / h[number[k] % Dim]; },
        [](double a, double b) { return a > b ? a : b; });
  }
  double largest_strain() const {
    double largest = 0;
    nodal_force_.visit(grid_u_.data(), [&](std::size_t, const Block& block) {
      double of_block = 0;
      for (const auto& row : block.H) {
        for (std::size_t q = 0; q < block.count; ++q) of_block = std::max(of_block, std::abs(row[q]));
      }
#pragma omp critical(stillpoint_largest_strain)
      largest = std::max(largest, of_block);
    });
    return largest;
  }

  // --- grid values --------------------------------------------------------------------------------
  const PointMaterial<K>& material_of(std::size_t k) const {
    return *body_.materials[static_cast<std::size_t>(body_.points.material_of_cell(k))];
  }
  void spread_prescribed(double t, std::vector<double>& grid) const {
    for (std::size_t s = 0; s < dofs_->prescribed.size(); ++s) {
      grid[static_cast<std::size_t>(dofs_->prescribed[s])] = boundary_.displacement_in_phase(s, t);
    }
  }
  // The grid's displacements from the free unknowns and the supports at time t.
  void spread(double t, ConstVec u, std::vector<double>& grid) const {
    for_each_index(u.size(),
                   [u, to = grid.data(), number = dofs_->free.data()](std::size_t k) { to[number[k]] = u[k]; });
    spread_prescribed(t, grid);
  }
  /// visit(occupied cell, point, number of the point)
  template <class Visit>
  void for_points(const Visit& visit) const {
    for (std::size_t k = 0; k < body_.points.cells(); ++k) {
      for (std::size_t p = body_.points.begin(k); p < body_.points.end(k); ++p) {
        visit(k, p, static_cast<std::size_t>(body_.points.number[p]));
      }
    }
  }

  // M_ff u_f = Σ_p m_p N_fp u_0(x_p) − M_fs u_s: the least-squares fit at the material points, whatever M the motion
  // uses.
  std::vector<double> project(const std::vector<Expression>& field, const std::vector<double>& held) const {
    std::vector<double> u(size(), 0.0);
    if (field.empty()) return u;
    for_points([&](std::size_t k, std::size_t p, std::size_t) {
      for (int i = 0; i < Dim; ++i) {
        const double moment = body_.points.mass[p] * field[static_cast<std::size_t>(i)](body_.points.place(p), 0);
        weights_.add_at_functions(k, p, i, moment, *dofs_, u);
      }
    });
    const SplitMatrix M = moves_on_ ? consistent_mass<B, K>(body_.points, weights_, *dofs_) : consistent_;
    if (!held.empty()) {
      const Eigen::Map<const Eigen::VectorXd> u_s(held.data(), static_cast<Eigen::Index>(held.size()));
      Eigen::Map<Eigen::VectorXd>(u.data(), static_cast<Eigen::Index>(u.size())) -= M.prescribed * u_s;
    }
    SparseCholesky(M.free).solve(u, u);
    return u;
  }

  const Scene scene_;
  bool moves_on_;
  bool history_dependent_ = false, finite_strain_ = false;
  Grid<Dim> grid_;
  Body<K> body_;
  VelocityTransfer<B, K> transfer_;
  NodalInertia<B, K> inertia_;
  ExternalLoads<B, K> loads_;
  Boundary boundary_;
  PointOrder<Dim> order_;
  std::vector<double> origin_;  // places at the start of the run, in the points' order of then, (P × Dim)
  double initial_mass_ = 0;

  // Of the present phase:
  PointWeights<B, K> weights_;
  std::optional<DegreesOfFreedom> dofs_;
  SplitMatrix consistent_;  // M as assembled, for projections and moving supports; of a single phase only
  std::optional<Mass> mass_;
  std::vector<double> start_velocity_;  // over the grid's functions, (functions × Dim)
  std::vector<double> committed_u_;     // likewise
  double committed_t_ = 0;

  // Work arrays, sized once a phase; evaluations of one phase are not for several threads at once.
  mutable NodalForce<B, K> nodal_force_;
  mutable std::vector<double> grid_u_, grid_work_;  // (functions × Dim)
  mutable double last_t_ = 0;
  mutable double undeformed_bound_ = 0;
  mutable long looks_ = 0;
};

}  // namespace stillpoint
