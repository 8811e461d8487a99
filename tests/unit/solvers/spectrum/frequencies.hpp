// What the tests of frequencies share: chains, systems of dense matrices, and the frequencies by Eigen's dense solver.
#pragma once

#include <stillpoint/spectrum.hpp>

#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <catch2/catch.hpp>

#include "chain.hpp"
#include "dense.hpp"

namespace stillpoint::test {

inline std::vector<double> at_rest(const Chain& chain) { return std::vector<double>(chain.size(), 0.0); }

// ω of K x = ω² M x in ascending order by Eigen's dense solver.
inline Eigen::VectorXd dense_frequencies(const Chain& chain, ConstVec u) {
  const SparseMatrix K = chain.tangents().matrix(Tangent::consistent, 0, u), M = chain.mass().matrix();
  return dense_eigenvalues(K, M).cwiseMax(0).cwiseSqrt();
}

inline std::vector<ChainOptions> held_chains() {
  std::vector<double> masses;
  for (int i = 0; i < 25; ++i) masses.push_back(1 + 0.9 * std::sin(7.0 * i));
  std::vector<ChainOptions> chains;
  for (const bool consistent : {false, true}) {
    for (const std::size_t n : {1u, 2u, 3u, 5u, 12u, 30u}) {
      chains.push_back({.n = n, .mass = 2, .stiffness = 3e6, .consistent = consistent});
    }
    chains.push_back({.n = 10, .right_held = true, .consistent = consistent});
    chains.push_back({.stiffness = 1e-3, .masses = masses, .consistent = consistent});
  }
  return chains;
}

inline Approx near(double value) { return Approx(value).epsilon(1e-8); }

// K = diag(1, k), M full: hats with few points, for which Gershgorin's lower circle of M is negative.
class PlainSystem : public Chain {
 public:
  PlainSystem(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M)
      : Chain({.n = static_cast<std::size_t>(K.rows())}), K_(K), M_(Mass::consistent(M.sparseView())) {}
  const Mass& mass() const override { return M_; }
  SparseMatrix matrix(Tangent, double, ConstVec) const override { return K_.sparseView(); }
  void apply(Tangent, double, ConstVec, ConstVec du, Vec dR) const override {
    const auto n = static_cast<Eigen::Index>(size());
    Eigen::Map<Eigen::VectorXd>(dR.data(), n) = K_ * Eigen::Map<const Eigen::VectorXd>(du.data(), n);
  }

 private:
  Eigen::MatrixXd K_;
  Mass M_;
};

}  // namespace stillpoint::test
