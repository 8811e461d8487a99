// Work arrays for evaluations that may run in several threads at the same time.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace stillpoint {

/// Lends work arrays. Whoever borrows some has them alone until the loan ends; they then serve the next borrower, so
/// that nothing is allocated once there are as many as there are loans at a time. A loan may outlive its pool.
template <class Arrays>
class WorkPool {
  struct Idle {
    std::mutex mutex;
    std::size_t made = 0;
    std::vector<std::unique_ptr<Arrays>> arrays;
  };

 public:
  class Loan {
   public:
    Loan(std::shared_ptr<Idle> idle, std::unique_ptr<Arrays> arrays)
        : idle_(std::move(idle)), arrays_(std::move(arrays)) {}
    Loan(Loan&&) noexcept = default;
    Loan& operator=(Loan&&) = delete;
    ~Loan() {
      if (!arrays_) return;
      const std::scoped_lock lock(idle_->mutex);
      idle_->arrays.push_back(std::move(arrays_));  // borrow() has reserved room for it
    }
    Arrays& operator*() const { return *arrays_; }
    Arrays* operator->() const { return arrays_.get(); }

   private:
    std::shared_ptr<Idle> idle_;
    std::unique_ptr<Arrays> arrays_;
  };

  Loan borrow() const {
    const std::scoped_lock lock(idle_->mutex);
    if (idle_->arrays.empty()) {
      auto made = std::make_unique<Arrays>();
      idle_->arrays.reserve(++idle_->made);
      return {idle_, std::move(made)};
    }
    std::unique_ptr<Arrays> last = std::move(idle_->arrays.back());
    idle_->arrays.pop_back();
    return {idle_, std::move(last)};
  }

 private:
  std::shared_ptr<Idle> idle_ = std::make_shared<Idle>();
};

}  // namespace stillpoint
