// What a Vector promises: who owns its memory, and what its clones carry.
#include <stillpoint/vector.hpp>

#include <stdexcept>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>
#include <nvector/nvector_serial.h>

#include "linalg/sundials.hpp"

using stillpoint::NVectorHandle;
using stillpoint::Vector;
using stillpoint::VectorSpace;
using Values = std::vector<double>;

TEST_CASE("a view copies nothing and leaves the memory to its owner", "[vector]") {
  Values memory = {1, 2, 3};
  {
    VectorSpace space;
    Vector view = space.view(memory);
    CHECK(view.size() == 3);
    CHECK(view.span().data() == memory.data());
    CHECK(N_VGetArrayPointer(view.handle()) == memory.data());
    view.span()[1] = 5;
  }
  CHECK(memory == Values{1, 5, 3});
}

TEST_CASE("a made vector is zero, moves, and outlives its space", "[vector]") {
  Vector kept = VectorSpace().make(4);
  CHECK(stillpoint::max_norm(kept) == 0);
  kept.span()[3] = 2;
  Vector moved = std::move(kept);
  CHECK(moved.span()[3] == 2);
  kept = VectorSpace().make(2);
  std::swap(kept, moved);
  CHECK(kept.size() == 4);
  CHECK(moved.size() == 2);
  CHECK(VectorSpace().make(0).size() == 0);
}

TEST_CASE("an adopted N_Vector stays its owner's", "[vector]") {
  const SUNContext context = stillpoint::sundials::create_context();
  const NVectorHandle existing = N_VNew_Serial(5, context);
  N_VConst(2, existing);
  {
    VectorSpace space;
    Vector adopted = space.adopt(existing);
    CHECK(adopted.size() == 5);
    CHECK(adopted.handle() == existing);
    CHECK(stillpoint::dot(adopted, adopted) == 20);
  }
  CHECK(N_VL1Norm(existing) == 10);
  N_VDestroy(existing);
  const NVectorHandle without_memory = N_VNewEmpty_Serial(5, context);
  CHECK_THROWS_AS(VectorSpace().adopt(without_memory), std::invalid_argument);
  CHECK_THROWS_AS(VectorSpace().adopt(nullptr), std::invalid_argument);
  N_VDestroy(without_memory);
  SUNContext closing = context;
  SUNContext_Free(&closing);
}

TEST_CASE("a vector like another has its kind and size and is zero", "[vector]") {
  VectorSpace space;
  Vector model = space.make(3);
  model.span()[0] = 4;
  Vector like = space.like(model);
  CHECK(like.size() == 3);
  CHECK(stillpoint::max_norm(like) == 0);
  CHECK(like.span().data() != model.span().data());
  CHECK(like.handle()->ops->nvdotprod == model.handle()->ops->nvdotprod);
}

TEST_CASE("clones carry the replaced operations", "[vector]") {
  VectorSpace space;
  const Vector vector = space.make(3);
  const NVectorHandle clone = N_VClone(vector.handle()), again = N_VClone(clone);
  CHECK(again->ops->nvlinearcombination != nullptr);  // SUNDIALS' serial vector has none unless asked
  CHECK(again->ops->nvlinearcombination == vector.handle()->ops->nvlinearcombination);
  CHECK(again->ops->nvdotprod == vector.handle()->ops->nvdotprod);
  CHECK(again->ops->nvdotprod != N_VDotProd_Serial);
  N_VDestroy(clone);
  N_VDestroy(again);
}
