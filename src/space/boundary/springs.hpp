// Springs between positions of the body and the displacements that supports prescribe there.
//
//   R += k g w,   g = w·u + g_0 − u_s(t),   K += k w wᵀ
//
// w: the weights of the position's displacement; g_0: displacement of the position in one component when the phase
// began; u_s: the motion of the support. The force is a part of R(u), so that all users of R and K see it.
#pragma once

#include <stillpoint/sparse_matrix.hpp>
#include <stillpoint/types.hpp>

#include <cstddef>
#include <vector>

#include "space/boundary/prescribed_motion.hpp"

namespace stillpoint {

class Springs {
 public:
  struct Weight {
    int unknown;  // unknown of the grid
    int dof;      // degree of freedom, free or prescribed, as numbered by DegreesOfFreedom
    double w;
  };

  bool empty() const { return stiffness_.empty(); }
  std::size_t size() const { return stiffness_.size(); }
  void clear();
  /// Adds a spring. The motion must outlive this object.
  void add(double stiffness, double moved, const PrescribedMotion& motion, const std::vector<Weight>& weights);

  double stiffness(std::size_t s) const { return stiffness_[s]; }
  const std::vector<Weight>& weights() const { return weights_; }
  /// The displacement w·u at spring s; u: over the grid's functions.
  double displacement(std::size_t s, const double* u) const {
    double sum = 0;
    for (std::size_t e = begin_[s]; e < begin_[s + 1]; ++e) sum += weights_[e].w * u[weights_[e].unknown];
    return sum;
  }
  double gap(std::size_t s, double t, const double* u) const {
    return displacement(s, u) + moved_[s] - motion_[s]->displacement(t);
  }
  /// Displacement of the support of spring s since the phase that began at `start`; in the first phase, from the
  /// undeformed body.
  double support_displacement(std::size_t s, double t, double start) const {
    return motion_[s]->displacement(t) - (start > 0 ? motion_[s]->displacement(start) : 0);
  }

  /// R += the springs' forces, (n). reactions: += the springs' forces at prescribed unknowns, whose supports bear them
  /// too; behind these come the values −k g of each spring, the force that its support exerts on the body.
  void add_force(double t, const double* u, Vec R, Vec reactions) const {
    if (!empty()) add_forces(t, u, R, reactions);
  }
  /// dR += k w (w·du), (n); du over the grid's functions.
  void add_product(const double* du, Vec dR) const {
    if (!empty()) add_products(du, dR);
  }
  /// K += k w wᵀ, (n × n).
  void add_matrix(SparseMatrix& K) const {
    if (!empty()) add_matrices(K);
  }

 private:
  void add_forces(double t, const double* u, Vec R, Vec reactions) const;
  void add_products(const double* du, Vec dR) const;
  void add_matrices(SparseMatrix& K) const;

  std::vector<double> stiffness_, moved_;  // k [N/m], g_0 [m]
  std::vector<const PrescribedMotion*> motion_;
  std::vector<std::size_t> begin_{0};  // first weight of each spring
  std::vector<Weight> weights_;
};

}  // namespace stillpoint
