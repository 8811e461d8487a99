// Vectors that SUNDIALS reads in place: an N_Vector over memory that this library reaches as a span.
#pragma once

#include <stillpoint/types.hpp>

#include <array>
#include <cstddef>
#include <memory>
#include <span>

// SUNDIALS' own tag: N_Vector is a pointer to it, in 6.x and 7.x.
struct _generic_N_Vector;  // NOLINT(bugprone-reserved-identifier)

namespace stillpoint {

/// SUNDIALS' N_Vector, without its headers.
using NVectorHandle = _generic_N_Vector*;

class VectorSpace;

/// A vector of doubles in an N_Vector. Move-only; its memory is one contiguous local array.
class Vector {
 public:
  Vector(Vector&&) noexcept;
  Vector& operator=(Vector&&) noexcept;
  ~Vector();

  std::size_t size() const;
  Vec span();
  ConstVec span() const;
  NVectorHandle handle() const { return handle_; }

 private:
  friend class VectorSpace;
  struct Context;
  Vector(NVectorHandle handle, bool owned, std::shared_ptr<Context> context);

  NVectorHandle handle_ = nullptr;
  bool owned_ = false;
  std::shared_ptr<Context> context_;  // the SUNContext outlives every vector made with it
};

/// Makes vectors. The kind of vector (at present serial memory with this library's threaded operations) is chosen here
/// and nowhere else.
class VectorSpace {
 public:
  VectorSpace();

  /// A vector of n zeros that owns its memory.
  Vector make(std::size_t n) const;
  /// A vector of zeros of the kind and size of another, as for work arrays beside an adopted vector.
  Vector like(const Vector& other) const;
  /// A vector over memory that the caller keeps alive; nothing is copied.
  Vector view(Vec memory) const;
  /// A vector over the caller's own N_Vector, which must have a host array (N_VGetArrayPointer) and outlive the result.
  Vector adopt(NVectorHandle existing) const;
  /// SUNDIALS' context (a SUNContext) for the solvers that work on these vectors.
  void* sundials_context() const;

 private:
  std::shared_ptr<Vector::Context> context_;
};

/// Σ x_i y_i through the N_Vector, the same bits for any number of threads.
double dot(const Vector& x, const Vector& y);
/// The products x·y of all y, each with the bits of dot(), in one pass over memory. products: as many as y.
void dot_each(const Vector& x, std::span<NVectorHandle> y, std::span<double> products);
template <class... Vectors>
std::array<double, sizeof...(Vectors)> dots(const Vector& x, const Vectors&... y) {
  std::array<NVectorHandle, sizeof...(Vectors)> handles{y.handle()...};
  std::array<double, sizeof...(Vectors)> products;
  dot_each(x, handles, products);
  return products;
}
/// √(Σ x_i²), the same bits for any number of threads.
double norm(const Vector& x);
/// max |x_i|, NaN if any x_i is NaN.
double max_norm(const Vector& x);

}  // namespace stillpoint
