// Turns a kinematics that is known only at run time into a template parameter.
#pragma once

#include <stillpoint/material.hpp>

namespace stillpoint {

/// Calls visit<K>(), which returns the same type for each kinematics.
template <class Visit>
decltype(auto) with_kinematics(Kinematics kinematics, const Visit& visit) {
  switch (kinematics) {
    case Kinematics::line:
      return visit.template operator()<Kinematics::line>();
    case Kinematics::plane:
      return visit.template operator()<Kinematics::plane>();
    case Kinematics::axisymmetric:
      return visit.template operator()<Kinematics::axisymmetric>();
    case Kinematics::space:
      break;
  }
  return visit.template operator()<Kinematics::space>();
}

}  // namespace stillpoint
