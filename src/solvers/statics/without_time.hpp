// The base of the static solvers. There is no time in R(u) = F: a step is an iterate without a velocity, and laws
// remember none of them but the last. Base: the stepper that it is otherwise.
#pragma once

#include <stillpoint/relaxation_system.hpp>

#include <stdexcept>

namespace stillpoint {

template <class Base>
class WithoutTime : public Base {
 public:
  bool moves() const final { return false; }
  void accept(double /*t*/) final {}
  void finish(double t) final { this->system().accept(t, this->state().span(), /*force_is_current=*/true); }

 protected:
  /// options: what Base takes before the system. Throws std::invalid_argument if the body has contact.
  explicit WithoutTime(RelaxationSystem& system, const auto&... options) : Base(options..., system) {
    if (!system.system().contact()) return;
    throw std::invalid_argument(
        "in a static solution nothing that touches the body can open or close: take relaxation");
  }
};

}  // namespace stillpoint
