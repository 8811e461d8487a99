#include "base/work_pool.hpp"

#include <optional>
#include <vector>

#include <catch2/catch.hpp>

using namespace stillpoint;

TEST_CASE("work arrays are lent to one borrower at a time, and lent again when a loan ends") {
  std::optional<WorkPool<std::vector<double>>> pool(std::in_place);
  const double* first = nullptr;
  {
    const auto one = pool->borrow(), two = pool->borrow();
    one->assign(3, 1);
    two->assign(3, 2);
    first = one->data();
    CHECK(two->data() != first);
  }
  {
    const auto last_returned = pool->borrow();
    CHECK(last_returned->data() == first);
    CHECK(last_returned->size() == 3);
    const auto other = pool->borrow(), third = pool->borrow();
    CHECK(other->size() == 3);
    CHECK(third->empty());
  }
  CHECK(pool->first().data() == first);
  const auto outlives = pool->borrow();
  pool.reset();
  outlives->push_back(4);
  CHECK(outlives->back() == 4);
}
