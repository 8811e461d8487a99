#include "space/boundary/springs.hpp"

#include <Eigen/SparseCore>

namespace stillpoint {

void Springs::clear() {
  stiffness_.clear();
  moved_.clear();
  motion_.clear();
  begin_.assign(1, 0);
  weights_.clear();
}

void Springs::add(double stiffness, double moved, const PrescribedMotion& motion, const std::vector<Weight>& weights) {
  stiffness_.push_back(stiffness);
  moved_.push_back(moved);
  motion_.push_back(&motion);
  weights_.insert(weights_.end(), weights.begin(), weights.end());
  begin_.push_back(weights_.size());
}

void Springs::add_forces(double t, const double* u, Vec R, Vec reactions) const {
  const std::size_t n = R.size(), prescribed = reactions.size() - size();
  const PrescribedMotion* last = nullptr;  // the springs of a support follow one another
  double u_s = 0;
  for (std::size_t s = 0; s < size(); ++s) {
    if (motion_[s] != last) {
      last = motion_[s];
      u_s = last->displacement(t);
    }
    const double force = stiffness_[s] * (displacement(s, u) + moved_[s] - u_s);
    reactions[prescribed + s] = -force;
    for (std::size_t e = begin_[s]; e < begin_[s + 1]; ++e) {
      const auto dof = static_cast<std::size_t>(weights_[e].dof);
      (dof < n ? R[dof] : reactions[dof - n]) += force * weights_[e].w;
    }
  }
}

void Springs::add_products(const double* du, Vec dR) const {
  for (std::size_t s = 0; s < size(); ++s) {
    const double force = stiffness_[s] * displacement(s, du);
    for (std::size_t e = begin_[s]; e < begin_[s + 1]; ++e) {
      const auto dof = static_cast<std::size_t>(weights_[e].dof);
      if (dof < dR.size()) dR[dof] += force * weights_[e].w;
    }
  }
}

void Springs::add_matrices(SparseMatrix& K) const {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t s = 0; s < size(); ++s) {
    for (std::size_t a = begin_[s]; a < begin_[s + 1]; ++a) {
      for (std::size_t b = begin_[s]; b < begin_[s + 1]; ++b) {
        if (weights_[a].dof >= K.rows() || weights_[b].dof >= K.rows()) continue;
        entries.emplace_back(weights_[a].dof, weights_[b].dof, stiffness_[s] * (weights_[a].w * weights_[b].w));
      }
    }
  }
  SparseMatrix of_springs(K.rows(), K.cols());
  of_springs.setFromTriplets(entries.begin(), entries.end());
  K += of_springs;
}  // NOLINT(clang-analyzer-unix.Malloc): the analyzer loses sight of Eigen's destructor

}  // namespace stillpoint
