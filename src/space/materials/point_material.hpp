// The material of a range of points: what a block of them answers to its deformation, and what it remembers.
#pragma once

#include <stillpoint/material.hpp>
#include <stillpoint/problem.hpp>
#include <stillpoint/semi_discrete.hpp>
#include <stillpoint/types.hpp>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/memory_report.hpp"
#include "base/reordering.hpp"
#include "base/unroll.hpp"
#include "space/materials/deformation.hpp"

namespace stillpoint {

/// Work space for a block of consecutive points of one material, as structure of arrays that stays in the first-level
/// cache.
template <Kinematics K>
struct PointBlock {
  static constexpr std::size_t size = K == Kinematics::space ? 64 : 128;
  static constexpr std::size_t slack = 8;  // entries after the last, for who writes a few at a time
  static constexpr int components = gradient_components(K);
  using Row = std::array<double, size + slack>;
  using Rows = std::array<Row, components>;

  std::size_t first = 0, count = 0;           // points first … first + count − 1
  std::size_t first_cell = 0, last_cell = 0;  // that they are in; one past the last
  alignas(64) Rows H;                         // ∂u/∂x since the phase began
  alignas(64) Rows dH;                        // the part of it since commit
  alignas(64) Rows VP;                        // V_p P_p, the answer [J]
  alignas(64) Rows direction;                 // of a derivative

  [[gnu::always_inline]] TensorOf<K> H_at(std::size_t q) const { return row(H, q); }
  [[gnu::always_inline]] TensorOf<K> dH_at(std::size_t q) const { return row(dH, q); }
  [[gnu::always_inline]] TensorOf<K> direction_at(std::size_t q) const { return row(direction, q); }
  /// VP = V P at point q; 0, or NaN if P is not finite: a sum of these needs no branch.
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

/// What is the same for all points of a material, and stays so.
struct PointMaterialInfo {
  bool history_dependent = false;
  bool finite_strain = false;
  bool viscous = false;          // what is beyond its strength flows for a while, at a rate
  bool stress_stays = false;     // under no increment it is the committed one, to rounding
  std::size_t history_size = 0;  // entries of what is kept of the committed state, and of a trial of its own
  double wave_modulus = 0;       // λ + 2μ or its like in the undeformed state [Pa]
};

/// One virtual call serves a block of points, so that the loop over them knows its law and is vectorised, while the
/// loops over cells are compiled once for all laws. Points have their numbers in the whole body.
template <Kinematics K>
class PointMaterial {
 public:
  using Stresses = std::array<double, stress_components(K)>;
  using ModuliMatrix = std::array<double, gradient_components(K) * gradient_components(K)>;

  explicit PointMaterial(const PointMaterialInfo& info) : info_(info) {}
  virtual ~PointMaterial() = default;
  const PointMaterialInfo& info() const { return info_; }

  /// block.VP = V_p P_p for the deformation in block.H (and dH, over dt, if history_dependent); what the points would
  /// remember is written to trial, (history_size). V: volumes when the phase began, of all points.
  /// Returns 0, or NaN if some P is not finite.
  virtual double stress(PointBlock<K>& block, const double* V, double dt, double* trial) const = 0;
  /// The same where block.H is 0 and nothing came since commit, of a law whose stress_stays: nothing is to remember.
  virtual double committed_stress(PointBlock<K>& block, const double* V) const = 0;
  /// The trial history becomes the committed one and the other way round; every block has had its stress() in it.
  virtual void commit(std::vector<double>& trial) = 0;
  /// block.VP = V_p (∂P/∂H at block.H, block.dH and dt) : block.direction.
  virtual void tangent(Tangent kind, PointBlock<K>& block, const double* V, double dt) const = 0;

  /// At point p under H, of which dH came over dt since commit: ∂P/∂H if both change alike.
  virtual ModuliMatrix moduli(Tangent kind, const TensorOf<K>& H, const TensorOf<K>& dH, double dt,
                              std::size_t p) const = 0;
  /// The Cauchy stress of point p under H, of the committed history if there is one.
  virtual Stresses cauchy(const TensorOf<K>& H, std::size_t p) const = 0;
  /// How the committed stress of point p stands to its strength; empty: the law has none.
  virtual std::optional<YieldState> yield_state(std::size_t /*p*/) const { return std::nullopt; }
  /// The largest absolute row sum of the elastic ∂P/∂H in the block, a bound of its stiffness; infinite if it is not
  /// finite.
  virtual double stiffness_bound(const PointBlock<K>& block) const = 0;

  /// The phase ends with the deformation in block.H: it becomes part of what the next phase starts from.
  virtual void end_phase(const PointBlock<K>& block) = 0;
  /// What the points remember, entry h of the material's q-th point at [points h + q]: of a law that knows the
  /// deformation alone the displacement gradient F − I with which the phase began, if the body moves on; of one with
  /// history what was last committed.
  virtual Vec memory() = 0;
  /// Points are sorted anew. work: (history_size).
  virtual void reorder(const Reordering& order, std::vector<double>& work) = 0;
  /// The material has these points from now on; the one with number p is what the one with number from[p] was.
  virtual void take(const std::vector<int>& from, std::size_t begin, std::size_t count) = 0;
  /// Points start under these Cauchy stresses, (points × stress components).
  virtual void set_stress(const std::vector<Stresses>& stress) = 0;

  /// What is kept for each point.
  virtual std::vector<PointArray> arrays() const = 0;
  /// Committed history that a user may want to see: name and values in order of the points.
  virtual std::vector<std::pair<std::string, ConstVec>> shown_history() const = 0;

 protected:
  void set_history_size(std::size_t size) { info_.history_size = size; }

 private:
  PointMaterialInfo info_;
};

/// The material of points begin … begin + count − 1. updated_lagrangian: whether there will be another phase, which an
/// elastic law meets with the deformation so far.
template <Kinematics K>
std::unique_ptr<PointMaterial<K>> make_point_material(const MaterialSpec& material, StressState state,
                                                      std::size_t begin, std::size_t count, bool updated_lagrangian);

}  // namespace stillpoint
