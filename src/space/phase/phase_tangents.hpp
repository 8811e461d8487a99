// The tangent stiffness of a phase, with that of its conditions.
#pragma once

#include <stdexcept>

#include "space/phase/phase_assembly.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
class PhaseTangents final : public Tangents {
 public:
  /// all: must outlive this object.
  explicit PhaseTangents(const PhaseAssembly<B, K>& all) : all_(all) {}

  void apply(Tangent kind, double t, ConstVec u, ConstVec du, Vec dR) const override {
    if (kind == Tangent::stable) throw std::logic_error("the stable tangent is a matrix alone");
    const auto work = all_.force.borrow();
    all_.frame.unknowns.spread(t, u, work->u);
    all_.frame.unknowns.spread_direction(du, work->du);
    all_.force.apply(of_points(kind), t, dR, *work);
    all_.conditions.add_product(kind, t, work->u.data(), work->du.data(), dR);
  }
  SparseMatrix matrix(Tangent kind, double t, ConstVec u) const override {
    const auto work = all_.force.borrow();
    all_.frame.unknowns.spread(t, u, work->u);
    SparseMatrix matrix = all_.force.matrix(of_points(kind), t, *work);
    all_.conditions.add_matrix(kind, t, work->u.data(), matrix);
    return matrix;
  }
  SparseMatrix matrix_ahead(double t, ConstVec u, ConstVec from) const override {
    const auto work = all_.force.borrow(), before = all_.force.borrow();
    all_.frame.unknowns.spread(t, u, work->u);
    all_.frame.unknowns.spread(t, from, before->u);
    SparseMatrix matrix = all_.force.matrix(Tangent::consistent, t, *work, &before->u);
    all_.conditions.add_matrix(Tangent::consistent, t, work->u.data(), matrix);
    return matrix;
  }
  SparseMatrix of_loads(double t, ConstVec u) const override {
    const auto work = all_.force.borrow();
    all_.frame.unknowns.spread(t, u, work->u);
    return all_.conditions.tangent_of_loads(all_.inertia.parts(), t, work->u.data());
  }

 private:
  static Tangent of_points(Tangent kind) { return kind == Tangent::stiffest ? Tangent::elastic : kind; }

  const PhaseAssembly<B, K>& all_;
};

}  // namespace stillpoint
