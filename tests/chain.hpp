// A chain of n masses on springs: the semi-discrete system whose answers are known, for tests.
//
//   wall —s_0— m_0 —s_1— m_1 — … — m_{n−1} —s_n— wall      (an end that is not held lacks its spring)
//   spring s pulls with T(e) = k e + k₃ e³, e its extension;   R_i = T(e_i) − T(e_{i+1}),  F_i = load
//   M = diag m, or "consistent": M = D½ tridiag(1/6, 2/3, 1/6) D½ with D = diag m, positive definite for every m
//
// Equal masses and springs, k₃ = 0, M = diag m, held on the left:  ω_j = 2 √(k/m) sin((2j − 1) π/(4n + 2)),  j = 1 … n;
// held at both ends:  ω_j = 2 √(k/m) sin(j π/(2n + 2)).
#pragma once

#include <stillpoint/semi_discrete.hpp>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/SparseCore>

namespace stillpoint::test {

struct ChainOptions {
  std::size_t n = 10;
  double mass = 1;               // of each [kg]
  double stiffness = 1;          // k of each spring [N/m]
  double cubic = 0;              // k₃ of each spring [N/m³]
  std::vector<double> masses{};  // (n), instead of equal ones
  bool left_held = true, right_held = false;
  bool consistent = false;
  double load = 0;  // on each mass [N]
};

class Chain : public SemiDiscrete, public Tangents {
 public:
  explicit Chain(ChainOptions options = {}) : options_(with_masses(std::move(options))), mass_(make_mass(options_)) {}

  const Mass& mass() const override { return mass_; }
  const ChainOptions& options() const { return options_; }

  const Tangents& tangents() const override { return *this; }

  void external_force(double /*t*/, ConstVec /*u*/, Vec F) const override {
    for (double& f : F) f = options_.load;
  }
  bool internal_force(double t, ConstVec u, Vec R, TrialState& trial) const override {
    trial.t = t;
    bool finite = true;
    double left = tension(extension(u, 0), 0);
    for (std::size_t i = 0; i < size(); ++i) {
      const double right = tension(extension(u, i + 1), i + 1);
      R[i] = left - right;
      finite = finite && std::isfinite(R[i]);
      left = right;
    }
    return finite;
  }
  void apply(Tangent, double /*t*/, ConstVec u, ConstVec du, Vec dR) const override {
    double left = stiffness(u, 0) * extension(du, 0);
    for (std::size_t i = 0; i < size(); ++i) {
      const double right = stiffness(u, i + 1) * extension(du, i + 1);
      dR[i] = left - right;
      left = right;
    }
  }
  SparseMatrix matrix(Tangent, double /*t*/, ConstVec u) const override {
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t s = 0; s <= size(); ++s) {
      const double k = stiffness(u, s);
      const int left = static_cast<int>(s) - 1, right = static_cast<int>(s);
      if (s > 0) entries.emplace_back(left, left, k);
      if (s < size()) entries.emplace_back(right, right, k);
      if (s > 0 && s < size()) entries.emplace_back(left, right, -k), entries.emplace_back(right, left, -k);
    }
    return assemble(size(), entries);
  }
  /// ω_j, j = 1 … n, of the equal linear chain with M = diag m.
  double exact_omega(std::size_t j) const {
    const auto n = static_cast<double>(size()), k = static_cast<double>(j);
    const double angle = options_.left_held && options_.right_held ? k / (2 * n + 2) : (2 * k - 1) / (4 * n + 2);
    return 2 * std::sqrt(options_.stiffness / options_.mass) * std::sin(angle * std::numbers::pi);
  }

 private:
  static ChainOptions with_masses(ChainOptions options) {
    if (options.masses.empty()) options.masses.assign(options.n, options.mass);
    options.n = options.masses.size();
    return options;
  }
  static SparseMatrix assemble(std::size_t n, const std::vector<Eigen::Triplet<double>>& entries) {
    SparseMatrix matrix(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }
  static Mass make_mass(const ChainOptions& options) {
    const std::vector<double>& m = options.masses;
    if (!options.consistent) return Mass::lumped(m);
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t i = 0; i < m.size(); ++i) {
      const int k = static_cast<int>(i);
      entries.emplace_back(k, k, m[i] * 2 / 3);
      if (i == 0) continue;
      const double coupling = std::sqrt(m[i - 1] * m[i]) / 6;
      entries.emplace_back(k, k - 1, coupling);
      entries.emplace_back(k - 1, k, coupling);
    }
    return Mass::consistent(assemble(m.size(), entries));
  }

  bool present(std::size_t s) const { return s == 0 ? options_.left_held : s < size() || options_.right_held; }
  double extension(ConstVec u, std::size_t s) const { return (s < size() ? u[s] : 0) - (s > 0 ? u[s - 1] : 0); }
  double tension(double e, std::size_t s) const {
    return present(s) ? options_.stiffness * e + options_.cubic * e * e * e : 0;
  }
  double stiffness(ConstVec u, std::size_t s) const {
    const double e = extension(u, s);
    return present(s) ? options_.stiffness + 3 * options_.cubic * e * e : 0;
  }

  ChainOptions options_;
  Mass mass_;
};

}  // namespace stillpoint::test
