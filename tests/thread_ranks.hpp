// Ranks that are threads of the test itself: what they share is tried without MPI.
#pragma once

#include <algorithm>
#include <barrier>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "base/thread_team.hpp"
#include "parallel/ranks.hpp"

namespace stillpoint::test {

class ThreadRanks final : public Ranks {
 public:
  /// What the ranks have in common: a place for what each shows to the others, and a barrier.
  struct Team {
    explicit Team(int count) : shown(static_cast<std::size_t>(count)), barrier(count) {}
    std::vector<const void*> shown;
    std::barrier<> barrier;
  };
  ThreadRanks(int rank, int count, Team& team) : Ranks(rank, count, count), team_(team) {}

  void exchange(std::span<const Parcel> to, std::span<const Parcel> from) const override {
    meet(&to, [&](auto shown_by) {
      for (const Parcel& parcel : from) {
        const auto& sent = *static_cast<const std::span<const Parcel>*>(shown_by(parcel.rank));
        const auto mine = std::ranges::find(sent, rank(), &Parcel::rank);
        std::copy_n(mine->values, parcel.count, parcel.values);
      }
    });
  }
  void gather(double* all, const std::vector<std::size_t>& begin) const override {
    meet(all, [&](auto shown_by) {
      for (int r = 0; r < count(); ++r) {
        if (r == rank()) continue;
        const auto* of_rank = static_cast<const double*>(shown_by(r));
        const auto from = static_cast<std::size_t>(r);
        std::copy(of_rank + begin[from], of_rank + begin[from + 1], all + begin[from]);
      }
    });
  }
  std::vector<Bytes> deliver(const std::vector<Bytes>& to) const override {
    std::vector<Bytes> received;
    meet(&to, [&](auto shown_by) {
      for (int r = 0; r < count(); ++r)
        received.push_back((*static_cast<const std::vector<Bytes>*>(shown_by(r)))[static_cast<std::size_t>(rank())]);
    });
    return received;
  }
  void smallest(std::span<int> values) const override {
    join(values, [](int a, int b) { return std::min(a, b); });
  }
  void smallest(std::span<double> values) const override {
    join(values, [](double a, double b) { return std::min(a, b); });
  }
  void unite(std::span<std::byte> bits) const override {
    join(bits, [](std::byte a, std::byte b) { return a | b; });
  }
  bool fails_with_all(int, const std::string&) const override { return rank() == 0; }

 private:
  template <class Use>
  void meet(const void* mine, const Use& use) const {
    team_.shown[static_cast<std::size_t>(rank())] = mine;
    team_.barrier.arrive_and_wait();
    use([this](int r) { return team_.shown[static_cast<std::size_t>(r)]; });
    team_.barrier.arrive_and_wait();
  }
  template <class T, class Join>
  void join(std::span<T> values, const Join& two) const {
    std::vector<T> all(values.begin(), values.end());
    meet(values.data(), [&](auto shown_by) {
      for (int r = 0; r < count(); ++r) {
        const T* of_rank = static_cast<const T*>(shown_by(r));
        for (std::size_t k = 0; k < all.size(); ++k) all[k] = two(all[k], of_rank[k]);
      }
    });
    std::ranges::copy(all, values.begin());
  }

  Team& team_;
};

/// Runs body(ranks) as so many ranks.
inline void as_ranks(int count, const std::function<void(const Ranks&)>& body) {
  ThreadRanks::Team team(count);
  std::vector<std::thread> threads;
  for (int r = 0; r < count; ++r) {
    threads.emplace_back([&, r] {
      const ThreadScope alone(1);
      body(ThreadRanks(r, count, team));
    });
  }
  for (std::thread& thread : threads) thread.join();
}

}  // namespace stillpoint::test
