// The material of a range of points: their stresses under a deformation, and their history.
#pragma once

#include <stillpoint/material.hpp>
#include <stillpoint/problem.hpp>
#include <stillpoint/semi_discrete.hpp>
#include <stillpoint/types.hpp>
#include <stillpoint/unroll.hpp>

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/memory_report.hpp"
#include "base/reordering.hpp"
#include "space/materials/deformation.hpp"

namespace stillpoint {

/// Work space for a block of consecutive points of one material, as structure of arrays that stays in the first-level
/// cache.
template <Kinematics K>
struct PointBlock {
  static constexpr std::size_t size = K == Kinematics::space ? 64 : 128;
  static constexpr std::size_t slack = 8;  // entries after the last, for loops that write a few at a time
  static constexpr int components = gradient_components(K);
  using Row = std::array<double, size + slack>;
  using Rows = std::array<Row, components>;

  std::size_t first = 0, count = 0;           // points first … first + count − 1
  std::size_t first_cell = 0, last_cell = 0;  // cells of these points; one past the last
  alignas(64) Rows H;                         // ∂u/∂x since the phase began
  alignas(64) Rows dH;                        // the part of it since the last commit
  alignas(64) Rows VP;                        // V_p P_p, the result [J]
  alignas(64) Rows direction;                 // direction of a derivative

  [[gnu::always_inline]] TensorOf<K> H_at(std::size_t q) const { return row(H, q); }
  [[gnu::always_inline]] TensorOf<K> dH_at(std::size_t q) const { return row(dH, q); }
  [[gnu::always_inline]] TensorOf<K> direction_at(std::size_t q) const { return row(direction, q); }
  /// Sets VP = V P at point q. Returns 0, or NaN if P is not finite: a sum of these needs no branch.
  [[gnu::always_inline]] double store_stress(std::size_t q, double V, const TensorOf<K>& P) {
    double bad = 0;
    unroll<components>([&](auto c) __attribute__((always_inline)) {
      VP[c][q] = V * P[c];
      bad += 0 * P[c];
    });
    return bad;
  }

 private:
  [[gnu::always_inline]] static TensorOf<K> row(const Rows& rows, std::size_t q) {
    TensorOf<K> tensor;
    unroll<components>([&](auto c) __attribute__((always_inline)) { tensor[c] = rows[c][q]; });
    return tensor;
  }
};

/// A point of a material before the motion.
struct PlaceOfPoint {
  std::array<double, 3> position{};  // [m]; in the plane z = 0
  int number = 0;                    // from 0
  double cell = 0;                   // the mean side of the grid's cells [m]
};
/// The points of a material before the motion, in their order.
using PointPlaces = std::function<PlaceOfPoint(std::size_t point)>;

/// The constant properties of a material that all its points share.
struct PointMaterialInfo {
  bool history_dependent = false;
  bool finite_strain = false;
  bool viscous = false;                  // material stressed beyond its strength flows for a while, at a finite rate
  bool stress_stays = false;             // a zero increment returns the committed stress, to rounding
  bool needs_pressure = false;           // the stiffness follows the stress: none without a pressure, and it may grow
  bool pressure_by_deformation = false;  // whether it has a pore pressure, and no history that holds it
  std::size_t history_size = 0;          // entries of the committed history, and of a trial history
  double wave_modulus = 0;  // λ + 2μ or the corresponding modulus of the undeformed state [Pa]; unless it follows
};

/// InitialPoint of a material's points, (points) each; empty: what InitialPoint has.
struct InitialGround {
  bool at_rest = false;
  std::vector<double> consolidation{}, void_ratio{}, pore_pressure{};

  InitialPoint at(std::size_t point) const {
    InitialPoint here{.at_rest = at_rest};
    if (!consolidation.empty()) here.consolidation = consolidation[point];
    if (!void_ratio.empty()) here.void_ratio = void_ratio[point];
    if (!pore_pressure.empty()) here.pore_pressure = pore_pressure[point];
    return here;
  }
};

/// The material interface. One virtual call serves a block of points, so that the loop over them knows its law and is
/// vectorised, while the loops over cells are compiled once for all laws. Points have their numbers in the whole body.
template <Kinematics K>
class PointMaterial {
 public:
  using Stresses = std::array<double, stress_components(K)>;
  using ModuliMatrix = std::array<double, gradient_components(K) * gradient_components(K)>;

  explicit PointMaterial(const PointMaterialInfo& info) : info_(info) {}
  virtual ~PointMaterial() = default;
  const PointMaterialInfo& info() const { return info_; }

  /// Sets block.VP = V_p P_p for the deformation in block.H (and dH, over dt, if history_dependent); the new history of
  /// the points is written to trial, (history_size). V: volumes when the phase began, of all points. Returns 0, or NaN
  /// if some P is not finite.
  virtual double stress(PointBlock<K>& block, const double* V, double dt, double* trial) const = 0;
  /// As stress(), for block.H = 0 and no increment since the last commit, and a law whose stress_stays: no history is
  /// written.
  virtual double committed_stress(PointBlock<K>& block, const double* V) const = 0;
  /// Writes the committed history of the block's points to trial, (history_size): of points that are at rest.
  virtual void keep_history(const PointBlock<K>& /*block*/, double* /*trial*/) const {}
  /// Swaps the trial history and the committed one; stress() or keep_history() has to have written every block of it.
  virtual void commit(std::vector<double>& trial) = 0;
  /// Sets block.VP = V_p (∂P/∂H at block.H, block.dH and dt) : block.direction.
  virtual void tangent(Tangent kind, PointBlock<K>& block, const double* V, double dt) const = 0;

  /// The moduli ∂P/∂H at point p under H, with dH of it over dt since the last commit, if both change alike.
  virtual ModuliMatrix moduli(Tangent kind, const TensorOf<K>& H, const TensorOf<K>& dH, double dt,
                              std::size_t p) const = 0;
  /// The Cauchy stress of point p under H, or that of the committed history if there is one.
  virtual Stresses cauchy(const TensorOf<K>& H, std::size_t p) const = 0;
  /// The pressure of the water in the pores of point p under H, or that of the committed history; 0 if drained [Pa].
  virtual double pore_pressure(const TensorOf<K>& /*H*/, std::size_t /*p*/) const { return 0; }
  /// The relation of the committed stress of point p to its strength; empty if the law has none.
  virtual std::optional<YieldState> yield_state(std::size_t /*p*/) const { return std::nullopt; }
  /// λ + 2μ of the undeformed state, the largest of all points; of a law whose stiffness follows the stress that of the
  /// committed state [Pa].
  virtual double wave_modulus() const { return info_.wave_modulus; }
  /// The largest absolute row sum of the elastic ∂P/∂H in the block, a bound of its stiffness; infinite if it is not
  /// finite.
  virtual double stiffness_bound(const PointBlock<K>& block) const = 0;

  /// Adds the deformation in block.H, at the end of a phase, to the initial state of the next phase.
  virtual void end_phase(const PointBlock<K>& block) = 0;
  /// The stored state of the points, entry h of the material's q-th point at [points h + q]: for a law without history
  /// the displacement gradient F − I with which the phase began, if the body moves on; for one with history the
  /// committed history.
  virtual Vec memory() = 0;
  /// The number of entries that memory() has for each point.
  virtual std::size_t memory_rows() const = 0;
  /// Replaces the material's points by begin … begin + count − 1, which remember this, (memory_rows() × count).
  virtual void replace(std::vector<double> memory, std::size_t begin, std::size_t count) = 0;
  /// Sorts the points anew. work: (history_size).
  virtual void reorder(const Reordering& order, std::vector<double>& work) = 0;
  /// Replaces the material's points: point number p is a copy of the former point number from[p].
  virtual void take(const std::vector<int>& from, std::size_t begin, std::size_t count) = 0;
  /// Sets the initial Cauchy stresses of the points, (points × stress components).
  virtual void set_stress(const std::vector<Stresses>& stress, const InitialGround& ground) = 0;

  /// Tells a law where its points are, once their initial stress is set. Throws SceneError if the law cannot answer
  /// there.
  virtual void begin(const PointPlaces&) {}
  /// Throws what a law has met since the last call that is no matter of a smaller step.
  virtual void throw_what_failed() const {}
  /// What users should know of the law as it is found.
  virtual std::vector<std::string> notes() const { return {}; }

  /// What a parameter is at each point, over the number that the law was made with, if it varies from place to place;
  /// otherwise empty. set_stress() makes it 1.
  virtual Vec by_place(std::string_view /*parameter*/) { return {}; }

  /// The arrays that are stored for each point.
  virtual std::vector<PointArray> arrays() const = 0;
  /// The committed history that users may want to see: name and values in the order of the points.
  virtual std::vector<std::pair<std::string, ConstVec>> shown_history() const = 0;

 protected:
  void set_history_size(std::size_t size) { info_.history_size = size; }
  void set_wave_modulus(double modulus) { info_.wave_modulus = modulus; }
  void set_viscous(bool viscous) { info_.viscous = viscous; }

 private:
  PointMaterialInfo info_;
};

/// Makes the material of points begin … begin + count − 1. updated_lagrangian: whether there will be further phases,
/// for which an elastic law stores the deformation so far.
template <Kinematics K>
std::unique_ptr<PointMaterial<K>> make_point_material(const MaterialSpec& material, StressState state,
                                                      std::size_t begin, std::size_t count, bool updated_lagrangian);

}  // namespace stillpoint
