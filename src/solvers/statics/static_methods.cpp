#include "solvers/statics/static_methods.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace stillpoint {
namespace {

struct Row {
  StaticMethodInfo about;
  std::unique_ptr<Stepper> (*make)(const StaticMethodOptions&, RelaxationSystem&);
  LinearSolver solver = LinearSolver::automatic;
};

const std::vector<Row>& rows() {
  static const std::vector<Row> all = {
      {{.name = "newton",
        .equation = "K du = Q with the consistent tangent, by a Cholesky factor if K is symmetric, by LU if not",
        .source = "Kelley 1995, section 8.1",
        .takes_end_of_loads = true,
        .is_newton = true,
        .factorises = true},
       make_newton},
      {{.name = "newton-cg",
        .equation = "the same, K du = Q by conjugate gradients, or GMRES if K is not symmetric, without a matrix",
        .source = "Dembo, Eisenstat and Steihaug 1982; Saad and Schultz 1986",
        .takes_end_of_loads = true,
        .is_newton = true},
       make_newton,
       LinearSolver::iterative},
      {{.name = "cg",
        .equation = "p+ = Q/M + beta p, Polak and Ribière's beta >= 0",
        .source = "Hestenes and Stiefel 1952; Gilbert and Nocedal 1992",
        .tells_omega_1 = true},
       make_cg},
      {{.name = "lbfgs", .equation = "p = H Q, H of the last 10 changes of u and Q", .source = "Nocedal 1980"},
       make_lbfgs},
  };
  return all;
}

}  // namespace

const std::vector<StaticMethodInfo>& static_methods() {
  static const std::vector<StaticMethodInfo> all = [] {
    std::vector<StaticMethodInfo> infos;
    for (const Row& row : rows()) infos.push_back(row.about);
    return infos;
  }();
  return all;
}

LinearSolver linear_solver_of(std::string_view name) {
  const auto row = std::ranges::find(rows(), name, [](const Row& one) { return one.about.name; });
  return row == rows().end() ? LinearSolver::automatic : row->solver;
}

std::unique_ptr<Stepper> make_static_method(const StaticMethodOptions& options, RelaxationSystem& system) {
  for (const Row& row : rows()) {
    if (row.about.name == options.name) return row.make(options, system);
  }
  throw std::invalid_argument("there is no static solver '" + std::string(options.name) + "'");
}

}  // namespace stillpoint
