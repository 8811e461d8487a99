// The deformation of elastic points at the beginning of a phase, from their positions: a body whose stress depends on
// the deformation alone has no other memory than those.
//
// Accumulated from phase to phase, F_p = f_p F_p drifts away from the deformation that the positions show. The part of
// that difference which no function of the grid feels is permanent, so that a sudden load leaves other stresses than a
// slow one. Hence the displacement U(x) = x − X of the material now at x is fitted to that of the points, body by body,
// and
//
//   F_p = (I − ∂U/∂x)⁻¹
//
// is taken at the beginning of the phase [reference map: Kamrin, Rycroft and Nave 2012]. Where the positions do not
// determine the fit, the gradients I − F_p⁻¹ so far do (point_fit.hpp). V_p stays as accumulated, which integrates
// better: a column that a sudden load compresses to 0.3 has a third of the stress error that V_p(0) det F_p leaves.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "space/boundary/boundary_condition.hpp"
#include "space/kernels/point_fit.hpp"
#include "space/points/body.hpp"
#include "space/points/point_domains.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
class DeformationFromPositions {
  using Weights = PointWeights<B, K>;
  static constexpr int dim = Weights::dim, per_cell = Weights::per_cell;
  static constexpr int components = stillpoint::gradient_components(K);
  using Fit = PointFit<dim, B, K>;
  using Values = typename Fit::Values;

  // Share of a cell. A fit that misses a point by more than this spans a gap in the body, or two of its parts that lie
  // against each other: its gradient there is no strain.
  static constexpr double largest_miss = 0.25;
  // The fit is rejected at a point whose volume it changes by a larger factor.
  static constexpr double largest_factor = 2;
  static constexpr double tolerance = 1e-4;  // share of a cell

 public:
  /// Whether the law of some body depends on the deformation alone, and none has a history.
  static bool applies(const Body<K>& body) {
    return std::ranges::any_of(body.materials, [](const auto& material) { return !material->memory().empty(); }) &&
           std::ranges::none_of(body.materials,
                                [](const auto& material) { return material->info().history_dependent; });
  }

  /// The share of a function's displacement that counts as a motion of points, (functions). A function with N_ip next
  /// to nothing at all points may move far to strain them, but hardly moves them: no phase has to end for that.
  static std::vector<double> share_of_motion(const Body<K>& body, const Weights& weights, const CornerSum& corner_sum) {
    constexpr double full = 0.05;  // the largest N_ip from which on the share is 1
    std::vector<double> share(corner_sum.functions(), 0);
    for_points(body.points, [&](std::size_t k, std::size_t p, std::size_t) {
      const auto N = weights.N(k, p);
      for (int a = 0; a < per_cell; ++a) {
        double& of_function = share[static_cast<std::size_t>(weights.function(k, a))];
        of_function = std::max(of_function, std::min(1.0, std::abs(N[a]) / full));
      }
    });
    if (const Ranks* ranks = corner_sum.ranks()) {
      for (double& of_function : share) of_function = -of_function;
      ranks->smallest(std::span(share));
      for (double& of_function : share) of_function = -of_function;
    }
    return share;
  }

  bool has_begun() const { return !anchored_.empty(); }
  /// Prepares the first phase of a run or a stage: an unknown that a support holds at rest now has U = 0 for as long as
  /// it is held, but in a body that has moved before.
  void begin(Body<K>& body, const Weights& weights, const CornerSum& corner_sum, const HeldUnknowns& held) {
    const std::size_t functions = corner_sum.functions();
    anchored_.assign(body.first_number.size() - 1, {});
    for (std::size_t b = 0; b < anchored_.size(); ++b) {
      std::vector<char> reached(functions, 0);
      for_points(body.points, [&](std::size_t k, std::size_t p, std::size_t) {
        if (!is_of(body, b, p)) return;
        for (int a = 0; a < per_cell; ++a) reached[static_cast<std::size_t>(weights.function(k, a))] = 1;
      });
      unite(corner_sum.ranks(), std::span(reached));
      anchored_[b].assign(dim * functions, 0);
      if (body.carried_on[b]) continue;
      for (std::size_t s = 0; s < held.prescribed().size(); ++s) {
        const auto unknown = static_cast<std::size_t>(held.prescribed()[s]);
        anchored_[b][unknown] = reached[unknown / dim] && at_rest(held, s);
      }
    }
  }

  /// The functions have other numbers from now on, see BoundaryCondition::renumber().
  void renumber(const std::vector<int>& now_of, std::size_t functions) {
    for (std::vector<char>& anchored : anchored_) {
      const std::vector<char> before = std::exchange(anchored, std::vector<char>(dim * functions, 0));
      for (std::size_t unknown = 0; unknown < before.size(); ++unknown) {
        const int function = now_of[unknown / dim];
        if (function >= 0) anchored[dim * static_cast<std::size_t>(function) + unknown % dim] = before[unknown];
      }
    }
  }

  /// Sets the deformation gradients with which the phase begins. origin: the points' positions at the start of the run,
  /// by their numbers, (P × dim).
  void apply(const Grid<dim>& grid, Body<K>& body, const Weights& weights, const CornerSum& corner_sum,
             const HeldUnknowns& held, const std::vector<double>& origin) const {
    const PointDeformations memory(body);
    for (std::size_t b = 0; b + 1 < body.first_number.size(); ++b) {
      Values values = displacements(body, b, memory, origin);
      if (!is_so_for_any(corner_sum.ranks(), !values.mass.empty())) continue;
      if (values.mass.empty()) leave_out(body.points.size(), values);
      const Fit fit(grid, body.points, weights, corner_sum, values, options(grid.axes[0].smallest_scale()));
      const std::vector<double> U = fit.solve(still_anchored(b, held));
      const std::vector<char> trusted = trusted_functions(grid, body.points, weights, corner_sum, fit, values, U);
      for_each_block(body.points.cells(), [&](std::size_t k) {
        for (int a = 0; a < per_cell; ++a) {
          if (!trusted[static_cast<std::size_t>(weights.function(k, a))]) return;
        }
        for (std::size_t p = body.points.begin(k); p < body.points.end(k); ++p) {
          if (values.mass[p] == 0) continue;
          const auto G = weights.gradient(U.data(), k, p), inverse_F = identity_minus(G);
          const double factor = determinant<K>(inverse_F) * determinant<K>(plus_identity<K>(memory.at(k, p)));
          if (factor > 1 / largest_factor && factor < largest_factor)
            memory.set(k, p, product<K>(inverse<K>(inverse_F), G));  // (I − G)⁻¹ − I
        }
      });
    }
  }

 private:
  // The stored F_p − I of the points whose law depends on the deformation alone.
  class PointDeformations {
   public:
    explicit PointDeformations(Body<K>& body) : points_(body.points) {
      for (const auto& material : body.materials) of_material_.push_back(material->memory());
    }
    bool has(std::size_t k) const { return !of_material_[material(k)].empty(); }
    TensorOf<K> at(std::size_t k, std::size_t p) const {
      TensorOf<K> H;
      for (int c = 0; c < components; ++c) H[c] = entry(k, p, c);
      return H;
    }
    void set(std::size_t k, std::size_t p, const TensorOf<K>& H) const {
      for (int c = 0; c < components; ++c) entry(k, p, c) = H[c];
    }

   private:
    std::size_t material(std::size_t k) const { return static_cast<std::size_t>(points_.material_of_cell(k)); }
    double& entry(std::size_t k, std::size_t p, int c) const {
      const std::size_t m = material(k), begin = static_cast<std::size_t>(points_.material_begin[m]);
      const std::size_t count = static_cast<std::size_t>(points_.material_begin[m + 1]) - begin;
      return of_material_[m][count * static_cast<std::size_t>(c) + p - begin];
    }

    const MaterialPoints<dim>& points_;
    std::vector<Vec> of_material_;
  };

  static bool is_of(const Body<K>& body, std::size_t b, std::size_t p) {
    return body.points.number[p] >= body.first_number[b] && body.points.number[p] < body.first_number[b + 1];
  }
  static bool at_rest(const HeldUnknowns& held, std::size_t s) {
    return !held.motion(s).moves() && held.motion(s).displacement(0) == 0;
  }

  // Domains know their gradients themselves, and these take precedence: the fit removes from them only the part that no
  // function feels, Σ_p V_p ∇N̄_ip (∇U − g_p) = 0.
  static PointFitOptions options(double h) {
    if constexpr (B::window > 1) {
      return {.gradient_share = 1, .tolerance = tolerance * h, .iterations = 40};
    } else {
      return {.tolerance = tolerance * h};
    }
  }

  // The difference I − H.
  static TensorOf<K> identity_minus(TensorOf<K> H) {
    for (double& component : H) component = -component;
    return plus_identity<K>(H);
  }

  // Values of so many points, all of which are left out.
  static void leave_out(std::size_t points, Values& values) {
    values.value.resize(points);
    values.gradient.resize(points);
    values.mass.assign(points, 0);
  }

  // The displacements U_p and I − F_p⁻¹ of the points of body b; empty if its law is another.
  static Values displacements(const Body<K>& body, std::size_t b, const PointDeformations& memory,
                              const std::vector<double>& origin) {
    const MaterialPoints<dim>& points = body.points;
    Values values;
    for (std::size_t k = 0; k < points.cells(); ++k) {
      if (!memory.has(k)) continue;
      for (std::size_t p = points.begin(k); p < points.end(k); ++p) {
        if (!is_of(body, b, p)) continue;
        if (values.mass.empty()) leave_out(points.size(), values);
        const auto H = present_deformation(points, memory, k, p);
        const auto gradient = product<K>(inverse<K>(plus_identity<K>(H)), H);  // I − F⁻¹
        const auto number = static_cast<std::size_t>(points.number[p]);
        values.mass[p] = B::window > 1 ? points.volume[p] : points.mass[p];
        for (int i = 0; i < dim; ++i) {
          values.value[p][i] = points.x[i][p] - (B::window > 1 ? points.rest[i][p] : origin[dim * number + i]);
          for (int j = 0; j < dim; ++j) values.gradient[p][dim * i + j] = gradient[dim * i + j];
        }
      }
    }
    return values;
  }

  // The present F − I; that of a domain by its corners, which show what its point alone does not.
  static TensorOf<K> present_deformation(const MaterialPoints<dim>& points, const PointDeformations& memory,
                                         std::size_t k, std::size_t p) {
    if constexpr (B::window > 1) {
      Point<dim> r;
      for (int d = 0; d < dim; ++d) r[d] = points.half[d][p];
      TensorOf<K> H = Domain<dim>::of(points, p).deformation(r);
      const TensorOf<K> I = plus_identity<K>({});
      for (int c = 0; c < components; ++c) H[c] -= I[c];
      return H;
    } else {
      return memory.at(k, p);
    }
  }

  std::vector<char> still_anchored(std::size_t b, const HeldUnknowns& held) const {
    std::vector<char> zero(anchored_[b].size(), 0);
    for (std::size_t s = 0; s < held.prescribed().size(); ++s) {
      const auto unknown = static_cast<std::size_t>(held.prescribed()[s]);
      zero[unknown] = anchored_[b][unknown] && at_rest(held, s);
    }
    return zero;
  }

  // Whether the fit misses no point near a function by much, (functions).
  static std::vector<char> trusted_functions(const Grid<dim>& grid, const MaterialPoints<dim>& points,
                                             const Weights& weights, const CornerSum& corner_sum, const Fit& fit,
                                             const Values& values, const std::vector<double>& U) {
    std::vector<char> misses(points.cells(), 0);
    for_each_block(points.cells(), [&](std::size_t k) {
      const auto cell = grid.cell_at(points.cell[k]);
      for (std::size_t p = points.begin(k); p < points.end(k); ++p) {
        if (values.mass[p] == 0) continue;
        const auto fitted = fit.value(U, k, p);
        for (int d = 0; d < dim; ++d) {
          const double h = grid.axes[d].scale_at(cell[d]);
          if (!(std::abs(values.value[p][d] - fitted[d]) <= largest_miss * h)) misses[k] = 1;
        }
      }
    });
    std::vector<char> missing(U.size() / dim, 0);
    for (std::size_t k = 0; k < points.cells(); ++k) {
      if (!misses[k]) continue;
      for (int a = 0; a < per_cell; ++a) missing[static_cast<std::size_t>(weights.function(k, a))] = 1;
    }
    unite(corner_sum.ranks(), std::span(missing));
    for (char& one : missing) one = one == 0;
    return missing;
  }

  std::vector<std::vector<char>> anchored_;  // for each body, the unknowns that were held at rest at the start
};

}  // namespace stillpoint
