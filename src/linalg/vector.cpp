#include <stillpoint/vector.hpp>

#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>
#include <utility>

#include "linalg/sundials.hpp"
#include "linalg/vector_operations.hpp"

namespace stillpoint {

struct Vector::Context {
  Context() : context(sundials::create_context()) {}
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  ~Context() { SUNContext_Free(&context); }
  SUNContext context;
};

Vector::Vector(NVectorHandle handle, bool owned, std::shared_ptr<Context> context)
    : handle_(handle), owned_(owned), context_(std::move(context)) {}

Vector::Vector(Vector&& other) noexcept
    : handle_(std::exchange(other.handle_, nullptr)),
      owned_(std::exchange(other.owned_, false)),
      context_(std::move(other.context_)) {}

Vector& Vector::operator=(Vector&& other) noexcept {
  std::swap(handle_, other.handle_);
  std::swap(owned_, other.owned_);
  std::swap(context_, other.context_);
  return *this;
}

Vector::~Vector() {
  if (owned_) N_VDestroy(handle_);
}

std::size_t Vector::size() const {
  const auto& ops = *handle_->ops;
  // For a distributed vector, the length of the local part.
  return static_cast<std::size_t>(ops.nvgetlocallength ? ops.nvgetlocallength(handle_) : N_VGetLength(handle_));
}

Vec Vector::span() { return {N_VGetArrayPointer(handle_), size()}; }
ConstVec Vector::span() const { return {N_VGetArrayPointer(handle_), size()}; }

VectorSpace::VectorSpace() : context_(std::make_shared<Vector::Context>()) {}

Vector VectorSpace::make(std::size_t n) const {
  const NVectorHandle handle = N_VNew_Serial(static_cast<sunindextype>(n), context_->context);
  if (!handle) throw std::bad_alloc();
  use_fast_operations(handle);
  N_VConst(0, handle);
  return {handle, true, context_};
}

Vector VectorSpace::like(const Vector& other) const {
  const NVectorHandle handle = N_VClone(other.handle());
  if (!handle) throw std::bad_alloc();
  N_VConst(0, handle);
  return {handle, true, other.context_};
}

Vector VectorSpace::view(Vec memory) const {
  const auto n = static_cast<sunindextype>(memory.size());
  const NVectorHandle handle = N_VMake_Serial(n, memory.data(), context_->context);
  if (!handle) throw std::bad_alloc();
  use_fast_operations(handle);
  return {handle, true, context_};
}

Vector VectorSpace::adopt(NVectorHandle existing) const {
  if (!existing || !existing->ops->nvgetarraypointer || !N_VGetArrayPointer(existing)) {
    throw std::invalid_argument("an N_Vector without an array in host memory cannot be adopted");
  }
  return {existing, false, context_};
}

void* VectorSpace::sundials_context() const { return context_->context; }

double dot(const Vector& x, const Vector& y) { return N_VDotProd(x.handle(), y.handle()); }

void dot_each(const Vector& x, std::span<NVectorHandle> y, std::span<double> products) {
  N_VDotProdMulti(static_cast<int>(y.size()), x.handle(), y.data(), products.data());
}

double norm(const Vector& x) { return std::sqrt(dot(x, x)); }

double max_norm(const Vector& x) {
  // SUNDIALS' own maximum loses NaN; a sum of squares does not.
  if (!has_fast_operations(x.handle()) && std::isnan(dot(x, x))) return std::numeric_limits<double>::quiet_NaN();
  return N_VMaxNorm(x.handle());
}

}  // namespace stillpoint
