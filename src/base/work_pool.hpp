// Work arrays for evaluations that may run in several threads at the same time.
#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace stillpoint {

/// Lends work arrays. Whoever borrows some has them alone until the loan ends; they then serve the next borrower, so
/// that nothing is allocated once there are as many as there are loans at a time. A loan may outlive its pool.
template <class Arrays>
class WorkPool {
  struct Store {
    std::mutex mutex;
    std::vector<std::unique_ptr<Arrays>> all;
    std::vector<Arrays*> idle;
  };

 public:
  class Loan {
   public:
    Loan(std::shared_ptr<Store> store, Arrays& arrays) : store_(std::move(store)), arrays_(&arrays) {}
    Loan(Loan&&) noexcept = default;
    Loan& operator=(Loan&&) = delete;
    ~Loan() {
      if (!store_) return;
      const std::scoped_lock lock(store_->mutex);
      store_->idle.push_back(arrays_);  // borrow() has reserved room for it
    }
    Arrays& operator*() const { return *arrays_; }
    Arrays* operator->() const { return arrays_; }

   private:
    std::shared_ptr<Store> store_;
    Arrays* arrays_;
  };

  Loan borrow() const {
    const std::scoped_lock lock(store_->mutex);
    if (store_->idle.empty()) {
      store_->all.push_back(std::make_unique<Arrays>());
      store_->idle.reserve(store_->all.size());
      return {store_, *store_->all.back()};
    }
    Arrays* const last = store_->idle.back();
    store_->idle.pop_back();
    return {store_, *last};
  }
  /// The first arrays, even if they are lent: for a caller who knows that no borrower needs what is in them any more.
  Arrays& first() {
    if (store_->all.empty()) borrow();
    return *store_->all.front();
  }

 private:
  std::shared_ptr<Store> store_ = std::make_shared<Store>();
};

}  // namespace stillpoint
