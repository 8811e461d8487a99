// Ranks by MPI: the module stillpoint_ranks, which is loaded if a launcher has started several copies of the program.
#include <algorithm>
#include <chrono>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <thread>

#include <fmt/format.h>
#include <mpi.h>

#include "parallel/ranks.hpp"

namespace stillpoint {
namespace {

int int_of(std::size_t count) {
  if (count > INT_MAX) throw std::runtime_error("more than 2^31 values go from one rank to another at once");
  return static_cast<int>(count);
}

class MpiRanks final : public Ranks {
 public:
  using Ranks::Ranks;

  void exchange(std::span<const Parcel> to, std::span<const Parcel> from) const override {
    requests_.resize(to.size() + from.size());
    std::size_t next = 0;
    for (const Parcel& parcel : from)
      MPI_Irecv(parcel.values, int_of(parcel.count), MPI_DOUBLE, parcel.rank, 0, MPI_COMM_WORLD, &requests_[next++]);
    for (const Parcel& parcel : to)
      MPI_Isend(parcel.values, int_of(parcel.count), MPI_DOUBLE, parcel.rank, 0, MPI_COMM_WORLD, &requests_[next++]);
    MPI_Waitall(static_cast<int>(next), requests_.data(), MPI_STATUSES_IGNORE);
  }
  void gather(double* all, const std::vector<std::size_t>& begin) const override {
    counts_.clear();
    begins_.clear();
    for (std::size_t r = 0; r + 1 < begin.size(); ++r) {
      begins_.push_back(int_of(begin[r]));
      counts_.push_back(int_of(begin[r + 1] - begin[r]));
    }
    MPI_Allgatherv(MPI_IN_PLACE, 0, MPI_DOUBLE, all, counts_.data(), begins_.data(), MPI_DOUBLE, MPI_COMM_WORLD);
  }
  std::vector<Bytes> deliver(const std::vector<Bytes>& to) const override {
    const auto n = static_cast<std::size_t>(count());
    std::vector<int> out(n), in(n), out_begin(n), in_begin(n);
    std::size_t sent = 0, received = 0;
    for (std::size_t r = 0; r < n; ++r) {
      out[r] = int_of(to[r].size());
      out_begin[r] = int_of(sent);
      sent += to[r].size();
    }
    MPI_Alltoall(out.data(), 1, MPI_INT, in.data(), 1, MPI_INT, MPI_COMM_WORLD);
    for (std::size_t r = 0; r < n; ++r) {
      in_begin[r] = int_of(received);
      received += static_cast<std::size_t>(in[r]);
    }
    Bytes all_out, all_in(received);
    all_out.reserve(sent);
    for (const Bytes& bytes : to) all_out.insert(all_out.end(), bytes.begin(), bytes.end());
    MPI_Alltoallv(all_out.data(), out.data(), out_begin.data(), MPI_CHAR, all_in.data(), in.data(), in_begin.data(),
                  MPI_CHAR, MPI_COMM_WORLD);
    std::vector<Bytes> from(n);
    for (std::size_t r = 0; r < n; ++r) {
      const auto begin = all_in.begin() + in_begin[r];
      from[r].assign(begin, begin + in[r]);
    }
    return from;
  }
  void smallest(std::span<int> values) const override { least(values, MPI_INT); }
  void smallest(std::span<double> values) const override { least(values, MPI_DOUBLE); }
  void unite(std::span<std::byte> bits) const override {
    constexpr std::size_t piece = 1 << 30;
    for (std::size_t begin = 0; begin < bits.size(); begin += piece) {
      const auto part = bits.subspan(begin, std::min(piece, bits.size() - begin));
      MPI_Allreduce(MPI_IN_PLACE, part.data(), int_of(part.size()), MPI_BYTE, MPI_BOR, MPI_COMM_WORLD);
    }
  }
  bool fails_with_all(int status, const std::string& why) const override {
    using namespace std::chrono_literals;
    constexpr auto patience = 3s;
    MPI_Request all;
    MPI_Ibarrier(MPI_COMM_WORLD, &all);
    const auto begin = std::chrono::steady_clock::now();
    for (int are_here = 0; std::chrono::steady_clock::now() - begin < patience;) {
      MPI_Test(&all, &are_here, MPI_STATUS_IGNORE);
      if (are_here) return rank() == 0;
      std::this_thread::sleep_for(1ms);
    }
    fmt::print(stderr, "{} (rank {} of {})\n", why, rank(), count());
    std::fflush(nullptr);
    MPI_Abort(MPI_COMM_WORLD, status);
    return false;
  }

 private:
  template <class T>
  static void least(std::span<T> values, MPI_Datatype type) {
    MPI_Allreduce(MPI_IN_PLACE, values.data(), int_of(values.size()), type, MPI_MIN, MPI_COMM_WORLD);
  }

  mutable std::vector<MPI_Request> requests_;
  mutable std::vector<int> counts_, begins_;
};

}  // namespace
}  // namespace stillpoint

/// Starts MPI, which ends with the process. Returns the ranks, which the caller destroys.
extern "C" stillpoint::Ranks* stillpoint_make_ranks() {
  int provided = 0, rank = 0, count = 1, here = 1;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  std::atexit([] { MPI_Finalize(); });
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &count);
  MPI_Comm machine;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  MPI_Comm_size(machine, &here);
  MPI_Comm_free(&machine);
  return new stillpoint::MpiRanks(rank, count, here);
}
