// Operations on serial N_Vectors that replace those of Debian's SUNDIALS, which is compiled without optimisation.
#pragma once

#include <stillpoint/vector.hpp>

namespace stillpoint {

/// Installs these operations in a vector made by N_VNew_Serial or N_VMake_Serial; its clones carry them.
void use_fast_operations(NVectorHandle serial);
/// Whether two vectors have the same implementation, so that they may be operands of one operation.
bool same_kind(const Vector& a, const Vector& b);
/// Copies `from` to `to`, of the same kind and length.
void copy(const Vector& from, Vector& to);
/// Whether use_fast_operations() was called on the vector or on the one it was cloned from.
bool has_fast_operations(NVectorHandle any);

}  // namespace stillpoint
