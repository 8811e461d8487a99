// A shared library with an Abaqus user subroutine UMAT: how it is loaded and called, and whether it keeps state.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

namespace stillpoint {

/// The calling sequence of Fortran: everything by reference, arrays column by column, and behind all of it the length
/// of CMNAME. A routine in C ignores the last.
extern "C" using UmatRoutine = void(
    double* STRESS, double* STATEV, double* DDSDDE, double* SSE, double* SPD, double* SCD, double* RPL, double* DDSDDT,
    double* DRPLDE, double* DRPLDT, double* STRAN, double* DSTRAN, double* TIME, double* DTIME, double* TEMP,
    double* DTEMP, double* PREDEF, double* DPRED, char* CMNAME, int* NDI, int* NSHR, int* NTENS, int* NSTATV,
    double* PROPS, int* NPROPS, double* COORDS, double* DROT, double* PNEWDT, double* CELENT, double* DFGRD0,
    double* DFGRD1, int* NOEL, int* NPT, int* LAYER, int* KSPT, int* KSTEP, int* KINC, std::size_t CMNAME_length);

/// The arguments of a call, with the names that Abaqus' manual has for them.
struct UmatArguments {
  std::array<double, 6> stress, stran, dstran, ddsddt, drplde;
  std::array<double, 36> ddsdde;
  double sse, spd, scd, rpl, drpldt, dtime, temp, dtemp, predef, dpred, pnewdt, celent;
  std::array<double, 2> time;
  std::array<double, 3> coords;
  std::array<double, 9> drot, dfgrd0, dfgrd1;
  std::array<char, 80> cmname;
  int ndi, nshr, ntens, nstatv, nprops, noel, npt, layer, kspt, kinc;
  std::array<int, 4> kstep;
  std::vector<double> statev, props;
};

/// The memory that a library writes to: its variables in SAVE and COMMON, static ones in C.
class WritableMemory {
 public:
  /// Of the library in which this address lies.
  explicit WritableMemory(const void* address);
  /// Whether it is no longer as it was when it was last looked at; looks at it.
  bool has_changed();

 private:
  std::vector<std::span<const char>> parts_;
  std::vector<char> seen_;
};

/// A loaded library. A library that is opened twice is the same object, as its state is the same.
class UmatLibrary {
 public:
  /// Throws std::domain_error that says why it cannot be used, "there is no file …".
  static std::shared_ptr<UmatLibrary> open(const std::filesystem::path& file);

  [[gnu::always_inline]] inline void call(UmatArguments& a) const {
    routine_(a.stress.data(), a.statev.data(), a.ddsdde.data(), &a.sse, &a.spd, &a.scd, &a.rpl, a.ddsddt.data(),
             a.drplde.data(), &a.drpldt, a.stran.data(), a.dstran.data(), a.time.data(), &a.dtime, &a.temp, &a.dtemp,
             &a.predef, &a.dpred, a.cmname.data(), &a.ndi, &a.nshr, &a.ntens, &a.nstatv, a.props.data(), &a.nprops,
             a.coords.data(), a.drot.data(), &a.pnewdt, &a.celent, a.dfgrd0.data(), a.dfgrd1.data(), &a.noel, &a.npt,
             &a.layer, &a.kspt, a.kstep.data(), &a.kinc, a.cmname.size());
  }

  /// Taken around calls: it is free for all threads, unless the library keeps state or is still being watched.
  std::unique_lock<std::mutex> turn() const;
  /// Looks at the library's memory; once it has changed between two looks, calls take turns.
  void look_for_state();
  /// After this many blocks of calls without a change nobody watches any more.
  void watch(int blocks) { watched_ = blocks; }
  bool is_watched() const { return watched_ > 0; }
  void count_watched() { --watched_; }
  bool keeps_state() const { return keeps_state_; }

  explicit UmatLibrary(UmatRoutine* routine);

 private:
  UmatRoutine* routine_;
  WritableMemory memory_;
  mutable std::mutex one_at_a_time_;
  std::mutex looking_;
  std::atomic<bool> keeps_state_ = false;
  std::atomic<int> watched_ = 0;
};

}  // namespace stillpoint
