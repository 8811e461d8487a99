// The ranks of a run: processes, on one machine or several, each with a share of the body's points and all of its
// nodes. All take the same steps and come to the same decisions; what one has and others need, they tell each other
// here.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace stillpoint {

using Bytes = std::vector<char>;

/// What goes to another rank, or comes from it.
struct Parcel {
  int rank = 0;
  double* values = nullptr;
  std::size_t count = 0;
};

/// What is not about wishes is called by all ranks, in the same order, and returns when they have heard each other.
class Ranks {
 public:
  /// here: how many of them run on this machine.
  Ranks(int rank, int count, int here) : rank_(rank), count_(count), here_(here) {}
  virtual ~Ranks() = default;
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int rank() const { return rank_; }
  int count() const { return count_; }
  int on_this_machine() const { return here_; }

  /// Sends parcels, and receives those whose sizes are known.
  virtual void exchange(std::span<const Parcel> to, std::span<const Parcel> from) const = 0;
  /// Completes an array of which rank r has entries begin[r] to begin[r + 1] − 1, (count + 1).
  virtual void gather(double* all, const std::vector<std::size_t>& begin) const = 0;
  /// Sends bytes to each rank, (count); returns those from each.
  virtual std::vector<Bytes> deliver(const std::vector<Bytes>& to) const = 0;
  /// Replaces each value by the smallest of all ranks.
  virtual void smallest(std::span<int> values) const = 0;
  virtual void smallest(std::span<double> values) const = 0;
  /// Sets the bits that some rank has set, in an array that all have.
  virtual void unite(std::span<std::byte> bits) const = 0;
  /// The wish of this rank that the run should end, of which the others hear with what they gather next; and whether
  /// some rank has it, as they all know since they last gathered.
  void wish_for_end() const { wishes_end_ = true; }
  bool wishes_end() const { return wishes_end_; }
  void hear_of_wish() const { has_heard_ = true; }
  bool someone_wishes_end() const { return has_heard_; }

  /// Leaves a run that went wrong here: if all ranks come to this within seconds, returns whether this one is the first
  /// of them, which tells why; otherwise ends all with this status, after telling why, by the name of this rank.
  virtual bool fails_with_all(int status, const std::string& why) const = 0;

 private:
  int rank_, count_, here_;
  mutable bool wishes_end_ = false, has_heard_ = false;
};

}  // namespace stillpoint
