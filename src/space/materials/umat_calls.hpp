// The calls of a UMAT: what a block of points is given in Abaqus' arguments, and what they leave behind.
#pragma once

#include <stillpoint/own_history_law.hpp>
#include <stillpoint/problem.hpp>
#include <stillpoint/unroll.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "space/materials/turned_increment.hpp"
#include "space/materials/umat_library.hpp"
#include "space/materials/umat_utilities.hpp"

// A compiler cannot see that rows do not overlap.
#if defined(__clang__)
#define INDEPENDENT_POINTS _Pragma("clang loop vectorize(assume_safety)")
#else
#define INDEPENDENT_POINTS _Pragma("GCC ivdep")
#endif

namespace stillpoint {

/// The history of a point, in this order:
///   the Cauchy stress; STRAN; STATEV; F − I; the position; the point's number, the side of its cell, the time and the
///   number of increments so far.
template <StressState S>
class UmatCalls {
 protected:
  static constexpr std::size_t components = gradient_components(S), tensor = stress_components(S), dim = dimensions(S);
  static constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  // DTIME where no time passes: routines divide by it.
  static constexpr double no_time = 1e-12;

  UmatCalls(const MaterialSpec& material, std::shared_ptr<UmatLibrary> library)
      : library_(std::move(library)),
        name_(padded_name(material.name)),
        props_(material.props),
        states_(material.statev.size()) {}

  std::size_t row_of_strain() const { return tensor; }
  std::size_t row_of_states() const { return 2 * tensor; }
  std::size_t row_of_deformation() const { return row_of_states() + states_; }
  std::size_t row_of_position() const { return row_of_deformation() + components; }
  std::size_t row_of_number() const { return row_of_position() + dim; }
  std::size_t row_of_cell() const { return row_of_number() + 1; }
  std::size_t row_of_time() const { return row_of_number() + 2; }
  std::size_t row_of_increments() const { return row_of_number() + 3; }
  static std::vector<std::string> names_of(const MaterialSpec& material) {
    std::vector<std::string> names(2 * tensor);
    names.insert(names.end(), material.statev.begin(), material.statev.end());
    names.resize(names.size() + components + dim + 4);
    return names;
  }

  // Ours are xx, yy, zz, xy, yz, zx, Abaqus' 11, 22, 33, 12, 13, 23.
  static constexpr std::size_t umat_row(std::size_t a) { return a < 4 ? a : 9 - a; }
  static Stress<S> ours(const std::array<double, 6>& of_umat) {
    Stress<S> sigma;
    for (std::size_t a = 0; a < tensor; ++a) sigma[a] = of_umat[umat_row(a)];
    return sigma;
  }
  static StrainModuli<S> moduli_of(const UmatArguments& call) {
    StrainModuli<S> C;
    for (std::size_t a = 0; a < tensor; ++a) {
      for (std::size_t b = 0; b < tensor; ++b) C[a][b] = call.ddsdde[umat_row(a) + tensor * umat_row(b)];
    }
    return C;
  }
  static Gradient<S> gradient(const double* H) {
    Gradient<S> of_point;
    std::copy_n(H, components, of_point.begin());
    return of_point;
  }

  // What the points of a block are given, before the calls: a row for each component.
  static constexpr std::size_t block = 32;  // what they take stays in the first-level cache
  using Row = std::array<double, block>;
  template <std::size_t rows>
  using Rows = std::array<Row, rows>;
  struct Increments {
    alignas(64) Rows<tensor> stress, stran, dstran;  // turned
    alignas(64) Rows<components> before, after;      // F − I
    alignas(64) Rows<9> rotation;
    alignas(64) Row det_g;
  };
  struct Work {
    UmatArguments call;
    Increments by;
  };

  // This thread's, with the arguments that are the same in all calls.
  Work& work() const {
    static thread_local const auto own = std::make_unique<Work>();
    UmatArguments& call = own->call;
    call.ndi = 3;
    call.nshr = static_cast<int>(tensor) - 3;
    call.ntens = static_cast<int>(tensor);
    call.nstatv = static_cast<int>(states_);
    call.nprops = static_cast<int>(props_.size());
    call.statev.resize(std::max(call.statev.size(), states_ + 1));  // there is something to point to
    call.props.resize(std::max(call.props.size(), props_.size() + 1));
    std::ranges::copy(props_, call.props.begin());
    call.cmname = name_;
    call.temp = call.dtemp = call.predef = call.dpred = 0;
    call.npt = call.layer = call.kspt = 1;
    call.kstep = {1, 0, 0, 0};
    call.coords = {};
    call.drot = call.dfgrd0 = call.dfgrd1 = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    return *own;
  }

  // Vectorised. F_{n+1} = F_n + dH f_n⁻¹ F_n with f_n = I + H − dH.
  [[gnu::flatten]] void prepare(const PointsWithHistory& at, Increments& by) const {
    const std::size_t stride = at.stride, n = at.history_stride, points = at.points;
    const double* __restrict H = at.H, * __restrict dH = at.dH, * __restrict now = at.committed;
    const double* __restrict of_strain = now + n * row_of_strain();
    const double* __restrict of_deformation = now + n * row_of_deformation();
    Increments& __restrict to = by;
    INDEPENDENT_POINTS
    for (std::size_t q = 0; q < points; ++q) {
      Gradient<S> h, dh, F;
      Stress<S> sigma, strain;
      unroll<components>([&](auto c) __attribute__((always_inline)) {
        h[c] = H[stride * c + q];
        dh[c] = dH[stride * c + q];
        F[c] = of_deformation[n * c + q];
      });
      unroll<tensor>([&](auto a) __attribute__((always_inline)) {
        sigma[a] = now[n * a + q];
        strain[a] = of_strain[n * a + q];
      });
      const TurnedIncrement<double> increment = turned_increment<S, double>(h, dh);
      const Stress<S> stress = turned_stress<S>(increment.rotation, sigma);
      const Stress<S> total = turned_strain<S>(increment.rotation, strain);
      const Stress<S> change = strain_vector<S>(increment.strain);
      const auto change_of_f = displacement_gradient<S>(dh), from = displacement_gradient<S>(F);
      const auto f = unit_plus(displacement_gradient<S>(h) - change_of_f);
      const Gradient<S> after = gradient_part<S>(from + change_of_f * (inverse(f) * unit_plus(from)));
      unroll<tensor>([&](auto a) __attribute__((always_inline)) {
        to.stress[a][q] = stress[a];
        to.stran[a][q] = total[a];
        to.dstran[a][q] = change[a];
      });
      unroll<components>([&](auto c) __attribute__((always_inline)) {
        to.before[c][q] = F[c];
        to.after[c][q] = after[c];
      });
      const SpaceTensor& R = increment.rotation;
      to.rotation[0][q] = R.xx, to.rotation[1][q] = R.yx, to.rotation[3][q] = R.xy, to.rotation[4][q] = R.yy;
      if constexpr (S == StressState::space) {
        to.rotation[2][q] = R.zx, to.rotation[5][q] = R.zy, to.rotation[6][q] = R.xz, to.rotation[7][q] = R.yz,
        to.rotation[8][q] = R.zz;
      }
      to.det_g[q] = increment.det_g;
    }
  }

  // The entries of a matrix of Fortran, (3, 3), that components of a gradient take.
  static constexpr std::array<std::size_t, components> columns_of_gradient() {
    if constexpr (S == StressState::space) return {0, 3, 6, 1, 4, 7, 2, 5, 8};
    if constexpr (S == StressState::axisymmetric) return {0, 3, 1, 4, 8};
    if constexpr (S == StressState::plane_strain) return {0, 3, 1, 4};
  }
  // The arguments of the call for point q of a block that is prepared.
  [[gnu::always_inline]] void fill(const PointsWithHistory& at, std::size_t q, const Increments& by,
                                   UmatArguments& call) const {
    const std::size_t n = at.history_stride;
    const double* const now = at.committed + q;
    unroll<tensor>([&](auto a) __attribute__((always_inline)) {
      call.stress[umat_row(a)] = by.stress[a][q];
      call.stran[umat_row(a)] = by.stran[a][q];
      call.dstran[umat_row(a)] = by.dstran[a][q];
      call.ddsddt[a] = call.drplde[a] = 0;
    });
    constexpr auto columns = columns_of_gradient();
    unroll<components>([&](auto c) __attribute__((always_inline)) {
      constexpr double diagonal = columns[c] % 4 == 0 ? 1 : 0;
      call.dfgrd0[columns[c]] = diagonal + by.before[c][q];
      call.dfgrd1[columns[c]] = diagonal + by.after[c][q];
    });
    unroll<9>([&](auto k) __attribute__((always_inline)) {
      if (S == StressState::space || (k < 5 && k != 2)) call.drot[k] = by.rotation[k][q];
    });
    std::fill_n(call.ddsdde.begin(), tensor * tensor, 0.0);
    for (std::size_t k = 0; k < states_; ++k) call.statev[k] = now[n * (row_of_states() + k)];
    unroll<dim>([&](auto i) __attribute__((always_inline)) { call.coords[i] = now[n * (row_of_position() + i)]; });
    call.noel = static_cast<int>(now[n * row_of_number()]) + 1;
    call.celent = now[n * row_of_cell()];
    call.time[0] = call.time[1] = now[n * row_of_time()];
    call.kinc = static_cast<int>(now[n * row_of_increments()]) + 1;
    call.dtime = at.dt > 0 ? at.dt : no_time;
    call.pnewdt = 1;
    call.sse = call.spd = call.scd = call.rpl = call.drpldt = 0;
  }

  // The calls of a block that is prepared, and what they leave; returns how many there were before one called XIT.
  std::size_t call_for_block(const PointsWithHistory& at, Work& work) const {
    struct Loop {
      const UmatCalls& law;
      const PointsWithHistory& at;
      Work& work;
      std::size_t q = 0;
    } loop{*this, at, work};
    runs_without_exit(
        [](void* data) {
          Loop& of = *static_cast<Loop*>(data);
          UmatArguments& call = of.work.call;
          Rows<tensor>& stress = of.work.by.stress;
          const std::size_t n = of.at.history_stride;
          for (; of.q < of.at.points; ++of.q) {
            of.law.fill(of.at, of.q, of.work.by, call);
            of.law.library_->call(call);
            for (std::size_t a = 0; a < tensor; ++a) stress[a][of.q] = call.stress[umat_row(a)];
            double* const states = of.at.next + n * of.law.row_of_states() + of.q;
            for (std::size_t k = 0; k < of.law.states_; ++k) states[n * k] = call.statev[k];
            if (call.pnewdt < 1) of.work.by.det_g[of.q] = nan;
          }
        },
        &loop);
    return loop.q;
  }

  void answer_block(const PointsWithHistory& at) const {
    Work& work = this->work();
    Increments& by = work.by;
    prepare(at, by);
    const std::size_t called = call_for_block(at, work);
    if (called < at.points) {
      has_left_ = true;
      std::fill(by.det_g.begin() + static_cast<std::ptrdiff_t>(called), by.det_g.end(), nan);
    }
    keep(at, by);
  }
  // P, NaN if det g is, and the next history but for the state variables.
  [[gnu::flatten]] void keep(const PointsWithHistory& at, const Increments& by) const {
    const std::size_t stride = at.stride, n = at.history_stride, points = at.points;
    const double* __restrict H = at.H;
    double* __restrict P = at.P;
    INDEPENDENT_POINTS
    for (std::size_t q = 0; q < points; ++q) {
      Gradient<S> h;
      Stress<S> sigma;
      unroll<components>([&](auto c) __attribute__((always_inline)) { h[c] = H[stride * c + q]; });
      unroll<tensor>([&](auto a) __attribute__((always_inline)) { sigma[a] = by.stress[a][q]; });
      const Gradient<S> nominal = nominal_stress<S, double>(h, by.det_g[q], sigma);
      unroll<components>([&](auto c) __attribute__((always_inline)) { P[stride * c + q] = nominal[c]; });
    }
    const auto write = [&](std::size_t h, const auto& value) __attribute__((always_inline)) {
      double* __restrict row = at.next + n * h;
      INDEPENDENT_POINTS
      for (std::size_t q = 0; q < points; ++q) row[q] = value(q);
    };
    const auto before = [&](std::size_t h) { return at.committed + n * h; };
    for (std::size_t a = 0; a < tensor; ++a) {
      write(a, [&](std::size_t q) { return by.stress[a][q]; });
      write(row_of_strain() + a, [&](std::size_t q) { return by.stran[a][q] + by.dstran[a][q]; });
    }
    for (std::size_t c = 0; c < components; ++c)
      write(row_of_deformation() + c, [&](std::size_t q) { return by.after[c][q]; });
    for (std::size_t h = row_of_position(); h < row_of_time(); ++h)
      write(h, [now = before(h)](std::size_t q) { return now[q]; });
    write(row_of_time(), [&, now = before(row_of_time())](std::size_t q) { return now[q] + at.dt; });
    write(row_of_increments(), [now = before(row_of_increments())](std::size_t q) { return now[q] + 1; });
  }

  // A call for a single point; its answer is in work.call. False if it called XIT.
  bool call_for(const double* H, const double* dH, double dt, const double* history, Work& work) const {
    const auto turn = library_->turn();
    const PointsWithHistory at{.points = 1,
                               .stride = 1,
                               .H = H,
                               .dH = dH,
                               .P = nullptr,
                               .dt = dt,
                               .history_stride = 1,
                               .committed = history,
                               .next = nullptr};
    prepare(at, work.by);
    fill(at, 0, work.by, work.call);
    struct Once {
      const UmatLibrary& library;
      UmatArguments& call;
    } once{*library_, work.call};
    const bool went_on = runs_without_exit(
        [](void* data) {
          const Once& of = *static_cast<Once*>(data);
          of.library.call(of.call);
        },
        &once);
    if (!went_on) has_left_ = true;
    return went_on;
  }

  std::shared_ptr<UmatLibrary> library_;
  std::array<char, 80> name_;
  std::vector<double> props_;
  std::size_t states_;
  mutable std::atomic<bool> has_left_ = false;  // whether a call went out by XIT

 private:
  static std::array<char, 80> padded_name(std::string_view name) {
    std::array<char, 80> padded;
    padded.fill(' ');
    std::ranges::transform(name.substr(0, padded.size()), padded.begin(),
                           [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return padded;
  }
};

}  // namespace stillpoint

#undef INDEPENDENT_POINTS
