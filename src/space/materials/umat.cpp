#include "space/materials/umat.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "base/text.hpp"
#include "space/materials/turned_increment.hpp"
#include "space/materials/umat_library.hpp"
#include "space/materials/umat_utilities.hpp"

namespace stillpoint {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
// DTIME where no time passes: routines divide by it.
constexpr double no_time = 1e-12;

/// What a UMAT answers to a probe, twice the same only if it keeps nothing.
struct ProbedAnswer {
  std::array<double, 6> stress;
  std::array<double, 36> ddsdde;
  std::vector<double> statev;
  double pnewdt;

  friend bool operator==(const ProbedAnswer& a, const ProbedAnswer& b) {
    const auto same = [](const auto& x, const auto& y) {
      return std::ranges::equal(x, y, [](double p, double q) {  // the same bits, but for how it is no number
        return std::bit_cast<std::uint64_t>(p) == std::bit_cast<std::uint64_t>(q) || (std::isnan(p) && std::isnan(q));
      });
    };
    return same(a.stress, b.stress) && same(a.ddsdde, b.ddsdde) && same(a.statev, b.statev) && a.pnewdt == b.pnewdt;
  }
};

std::array<char, 80> padded_name(std::string_view name) {
  std::array<char, 80> padded;
  padded.fill(' ');
  std::ranges::transform(name.substr(0, padded.size()), padded.begin(),
                         [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return padded;
}

/// Of a point, in the order of its history:
///   the Cauchy stress; STRAN; STATEV; F − I; the position; the point's number, the side of its cell, the time and the
///   number of increments so far.
template <StressState S>
class Umat final : public HistoryAnswers {
  static constexpr std::size_t components = gradient_components(S), tensor = stress_components(S), dim = dimensions(S);
  using T = SpaceTensor;

 public:
  Umat(const MaterialSpec& material, std::shared_ptr<UmatLibrary> library)
      : HistoryAnswers({.names = names_of(material)}),
        library_(std::move(library)),
        name_(padded_name(material.name)),
        material_(material.name),
        props_(material.props),
        states_(material.statev.size()) {
    constexpr int watched_blocks = 32;
    library_->watch(watched_blocks);
  }

  void first_piola(const PointsWithHistory& at) const noexcept override {
    const auto turn = library_->turn();
    UmatArguments& call = arguments();
    std::size_t q = 0;
    struct Loop {
      const Umat& law;
      const PointsWithHistory& at;
      UmatArguments& call;
      std::size_t& q;
    } loop{*this, at, call, q};
    const bool whole = runs_without_exit(
        [](void* data) {
          const Loop& of = *static_cast<Loop*>(data);
          for (; of.q < of.at.points; ++of.q) of.law.answer(of.at, of.q, of.call);
        },
        &loop);
    if (!whole) {
      has_left_ = true;
      for (; q < at.points; ++q) {
        for (std::size_t c = 0; c < components; ++c) at.P[at.stride * c + q] = nan;
      }
    }
    if (library_->is_watched()) {
      library_->look_for_state();
      library_->count_watched();
    }
  }

  void moduli(const double* H, const double* dH, double dt, const double* committed,
              double* A) const noexcept override {
    const auto by = turned_increment<S, Dual<components>>(variables(gradient(H)), variables(gradient(dH)));
    UmatArguments& call = arguments();
    take_point(committed, 1, call);
    take_increment(values_of(by), dt, call);
    take_deformation(gradient(H), gradient(dH), committed, 1, call);
    if (!call_in_turn(call)) return static_cast<void>(std::fill_n(A, components * components, nan));
    std::ranges::copy(moduli_of_increment<S>(gradient(H), by, stress_of(call), moduli_of(call)), A);
  }

  // With the symmetric part of DDSDDE without strain.
  void elastic_moduli(const double* H, const double* committed, double* A) const noexcept override {
    UmatArguments& call = arguments();
    take_point(committed, 1, call);
    if (!call_at_rest(committed, call)) return static_cast<void>(std::fill_n(A, components * components, nan));
    const StrainModuli<S> D = moduli_of(call);
    StrainModuli<S> C = D;
    for (std::size_t a = 0; a < tensor; ++a) {
      for (std::size_t b = 0; b < tensor; ++b) C[a][b] = (D[a][b] + D[b][a]) / 2;
    }
    Stress<S> sigma;
    std::copy_n(committed, tensor, sigma.begin());
    std::ranges::copy(elastic_moduli_of<S>(gradient(H), sigma, C), A);
  }
  void cauchy(const double* committed, double* sigma) const noexcept override { std::copy_n(committed, tensor, sigma); }
  void initial_history(const double* sigma, double* first) const noexcept override {
    std::fill_n(first, history(), 0.0);
    std::copy_n(sigma, tensor, first);
  }
  void place(const std::array<double, 3>& position, int number, double cell, double* history) const override {
    std::copy_n(position.begin(), dim, history + row_of_position());
    history[row_of_number()] = number;
    history[row_of_cell()] = cell;
  }

  void try_out(const double* history) const override {
    check_answer_at_rest(history);
    // All points of a body are alike, or nearly so: of n points the first, the second, the fourth …
    if (const std::size_t point = tried_++; (point & (point - 1)) == 0) look_for_state(history);
  }
  bool depends_on_time() const override { return depends_on_time_; }
  void throw_what_failed() const override {
    if (has_left_.exchange(false))
      throw std::runtime_error(fmt::format("the UMAT of material.{} cannot go on: it called XIT", material_));
  }
  std::vector<std::string> notes() const override {
    library_->look_for_state();
    std::vector<std::string> notes;
    if (library_->keeps_state())
      notes.push_back(
          fmt::format("the UMAT of material.{} writes to variables of its own (SAVE, COMMON, static): its calls take "
                      "turns, and more threads make them no quicker",
                      material_));
    if (depends_on_time_)
      notes.push_back(
          fmt::format("the UMAT of material.{} answers to the rate of strain: whether the body creeps on at the end is "
                      "not known",
                      material_));
    return notes;
  }

 private:
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
  static std::array<double, 6> of_umat(const Stress<S>& sigma) {
    std::array<double, 6> components_of_umat{};
    for (std::size_t a = 0; a < tensor; ++a) components_of_umat[umat_row(a)] = sigma[a];
    return components_of_umat;
  }
  static Stress<S> stress_of(const UmatArguments& call) { return ours(call.stress); }
  static StrainModuli<S> moduli_of(const UmatArguments& call) {
    StrainModuli<S> C;
    for (std::size_t a = 0; a < tensor; ++a) {
      for (std::size_t b = 0; b < tensor; ++b) C[a][b] = call.ddsdde[umat_row(a) + tensor * umat_row(b)];
    }
    return C;
  }
  static std::array<double, 9> by_columns(const T& A) { return {A.xx, A.yx, A.zx, A.xy, A.yy, A.zy, A.xz, A.yz, A.zz}; }
  static Gradient<S> gradient(const double* H) {
    Gradient<S> of_point;
    std::copy_n(H, components, of_point.begin());
    return of_point;
  }

  // The arguments of this thread's calls, with what is the same in all of them.
  UmatArguments& arguments() const {
    static thread_local UmatArguments call;
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
    return call;
  }

  // The committed state of a point, whose numbers are stride entries apart, before an increment turns it.
  void take_point(const double* now, std::size_t stride, UmatArguments& call) const {
    for (std::size_t a = 0; a < tensor; ++a) {
      call.stress[umat_row(a)] = now[stride * a];
      call.stran[a] = now[stride * (row_of_strain() + a)];
    }
    for (std::size_t k = 0; k < states_; ++k) call.statev[k] = now[stride * (row_of_states() + k)];
    call.coords = {};
    for (std::size_t i = 0; i < dim; ++i) call.coords[i] = now[stride * (row_of_position() + i)];
    call.noel = static_cast<int>(now[stride * row_of_number()]) + 1;
    call.celent = now[stride * row_of_cell()];
    call.time.fill(now[stride * row_of_time()]);
    call.kinc = static_cast<int>(now[stride * row_of_increments()]) + 1;
  }
  void take_increment(const TurnedIncrement<double>& by, double dt, UmatArguments& call) const {
    call.stress = of_umat(stress_vector<S>(turned(by.rotation, stress_in_space<S>(stress_of(call)))));
    call.stran = of_umat(strain_vector<S>(turned(by.rotation, strain_in_space<S>(ours(call.stran)))));
    call.dstran = of_umat(strain_vector<S>(by.strain));
    call.drot = by_columns(by.rotation);
    call.dtime = dt > 0 ? dt : no_time;
    call.pnewdt = 1;
    call.ddsdde = {};
    call.ddsddt = call.drplde = {};
    call.sse = call.spd = call.scd = call.rpl = call.drpldt = 0;
  }
  // DFGRD0 = F_n, and DFGRD1 = F_n + dH f_n⁻¹ F_n with f_n = I + H − dH; returns the last less I.
  Gradient<S> take_deformation(const Gradient<S>& H, const Gradient<S>& dH, const double* now, std::size_t stride,
                               UmatArguments& call) const {
    Gradient<S> before;
    for (std::size_t c = 0; c < components; ++c) before[c] = now[stride * (row_of_deformation() + c)];
    const T change = gradient_in_space<S, double>(dH), from = gradient_in_space<S, double>(before);
    const T f = unit_plus(gradient_in_space<S, double>(H) - change);
    const T after = from + change * (inverse(f) * unit_plus(from));
    call.dfgrd0 = by_columns(unit_plus(from));
    call.dfgrd1 = by_columns(unit_plus(after));
    if constexpr (S == StressState::space) {
      return {after.xx, after.xy, after.xz, after.yx, after.yy, after.yz, after.zx, after.zy, after.zz};
    } else if constexpr (S == StressState::axisymmetric) {
      return {after.xx, after.xy, after.yx, after.yy, after.zz};
    } else {
      return {after.xx, after.xy, after.yx, after.yy};
    }
  }

  // P and the next history of point q.
  void answer(const PointsWithHistory& at, std::size_t q, UmatArguments& call) const {
    Gradient<S> H, dH;
    for (std::size_t c = 0; c < components; ++c) {
      H[c] = at.H[at.stride * c + q];
      dH[c] = at.dH[at.stride * c + q];
    }
    const std::size_t n = at.history_stride;
    const double* const now = at.committed + q;
    double* const next = at.next + q;
    const TurnedIncrement<double> by = turned_increment<S, double>(H, dH);
    take_point(now, n, call);
    take_increment(by, at.dt, call);
    const Gradient<S> deformation = take_deformation(H, dH, now, n, call);
    const std::array<double, 6> stran = call.stran, dstran = call.dstran;
    library_->call(call);

    Stress<S> sigma;
    for (std::size_t a = 0; a < tensor; ++a) {
      sigma[a] = call.stress[umat_row(a)];
      next[n * a] = sigma[a];
      next[n * (row_of_strain() + a)] = stran[a] + dstran[a];
    }
    for (std::size_t k = 0; k < states_; ++k) next[n * (row_of_states() + k)] = call.statev[k];
    for (std::size_t c = 0; c < components; ++c) next[n * (row_of_deformation() + c)] = deformation[c];
    for (std::size_t i = row_of_position(); i < row_of_time(); ++i) next[n * i] = now[n * i];
    next[n * row_of_time()] = now[n * row_of_time()] + at.dt;
    next[n * row_of_increments()] = now[n * row_of_increments()] + 1;
    if (call.pnewdt < 1) sigma[0] = nan;
    const auto P = nominal_stress<S, double>(H, by.det_g, sigma);
    for (std::size_t c = 0; c < components; ++c) at.P[at.stride * c + q] = P[c];
  }

  // False if it called XIT.
  bool call_in_turn(UmatArguments& call) const {
    const auto turn = library_->turn();
    struct Once {
      const UmatLibrary& library;
      UmatArguments& call;
    } once{*library_, call};
    const bool went_on = runs_without_exit(
        [](void* data) {
          const Once& of = *static_cast<Once*>(data);
          of.library.call(of.call);
        },
        &once);
    if (!went_on) has_left_ = true;
    return went_on;
  }
  // The call of an increment that is none, for a point that call holds.
  bool call_at_rest(const double* history, UmatArguments& call) const {
    take_increment({{}, identity<T>, 1}, 0, call);
    take_deformation({}, {}, history, 1, call);
    return call_in_turn(call);
  }

  [[noreturn]] void refuse(const std::string& what) const { throw std::domain_error("the UMAT " + what); }
  static std::string told(const double* values, std::size_t count) {
    return fmt::format("[{:.6g}]", fmt::join(values, values + count, ", "));
  }
  std::string first_call(const double* history) const {
    Stress<S> stress;
    for (std::size_t a = 0; a < tensor; ++a) stress[umat_row(a)] = history[a];
    return fmt::format("in its first call, without strain and under STRESS = {}", told(stress.data(), tensor));
  }

  void check_answer_at_rest(const double* history) const {
    UmatArguments& call = arguments();
    take_point(history, 1, call);
    if (!call_at_rest(history, call)) {
      has_left_ = false;
      refuse("calls XIT " + first_call(history));
    }
    const auto finite = [](const double* values, std::size_t count) {
      return std::all_of(values, values + count, [](double x) { return std::isfinite(x); });
    };
    if (!finite(call.stress.data(), tensor))
      refuse(fmt::format("returns STRESS = {} {}; expected numbers", told(call.stress.data(), tensor),
                         first_call(history)));
    if (!finite(call.statev.data(), states_))
      refuse(fmt::format("returns STATEV = {} {}; expected numbers", told(call.statev.data(), states_),
                         first_call(history)));
    if (!finite(call.ddsdde.data(), tensor * tensor))
      refuse(fmt::format("returns a DDSDDE with what is no number {}; expected moduli", first_call(history)));
    if (call.pnewdt < 1)
      refuse(fmt::format("asks for a smaller step (PNEWDT = {:.6g}) {}", call.pnewdt, first_call(history)));
    using Matrix = Eigen::Matrix<double, static_cast<int>(tensor), static_cast<int>(tensor)>;
    const Eigen::Map<const Matrix> C(call.ddsdde.data());
    const Matrix symmetric = (C + C.transpose()) / 2;
    if (symmetric.llt().info() == Eigen::Success) return;
    const double least = Eigen::SelfAdjointEigenSolver<Matrix>(symmetric, Eigen::EigenvaluesOnly).eigenvalues()(0);
    refuse(
        fmt::format("returns a DDSDDE that is not positive definite (least eigenvalue {:.3g}) {}; expected the elastic "
                    "moduli [Pa]",
                    least, first_call(history)));
  }

  ProbedAnswer probe(const double* history, std::size_t component, double strain, double dt) const {
    UmatArguments& call = arguments();
    take_point(history, 1, call);
    Stress<S> e{};
    e[component] = strain;
    const T strained = strain_in_space<S>(e);
    take_increment({strained, identity<T>, 1}, dt, call);
    Gradient<S> dH{};
    dH[0] = strained.xx;  // about; what counts is that it is always the same
    take_deformation(dH, dH, history, 1, call);
    if (!call_in_turn(call)) {
      has_left_ = false;
      call.stress.fill(nan);
    }
    if (!std::equal(props_.begin(), props_.end(), call.props.begin()))
      refuse("writes to PROPS, which are the same for all points; expected them to be read alone");
    return {call.stress,
            call.ddsdde,
            {call.statev.begin(), call.statev.begin() + static_cast<std::ptrdiff_t>(states_)},
            call.pnewdt};
  }
  /// Asks the same things forwards and backwards, elastic ones and ones at which most materials yield.
  void look_for_state(const double* history) const {
    library_->look_for_state();
    std::vector<std::pair<std::size_t, double>> questions;
    for (const double strain : {1e-6, 1e-4, 1e-2}) {
      for (std::size_t k = 0; k < tensor; ++k) {
        questions.emplace_back(k, strain);
        questions.emplace_back(k, -strain);
      }
    }
    std::vector<ProbedAnswer> answers;
    for (const auto& [component, strain] : questions) answers.push_back(probe(history, component, strain, 1));
    library_->look_for_state();
    for (std::size_t k = questions.size(); k-- > 0;) {
      const auto& [component, strain] = questions[k];
      const ProbedAnswer again = probe(history, component, strain, 1);
      if (again == answers[k]) continue;
      refuse(
          fmt::format("answers the same call with STRESS = {} and then with {} (or with another STATEV or DDSDDE): it "
                      "keeps a state of its own between calls; expected an answer that depends on the arguments "
                      "alone, with the state in STATEV",
                      told(answers[k].stress.data(), tensor), told(again.stress.data(), tensor)));
    }
    library_->look_for_state();
    for (std::size_t k = 0; k < questions.size(); ++k) {
      const ProbedAnswer slow = probe(history, questions[k].first, questions[k].second, 1e3);
      constexpr double rounding = 1e-9;
      double size = 0, apart = 0;
      for (std::size_t a = 0; a < tensor; ++a) {
        size = std::max(size, std::abs(slow.stress[a]));
        apart = std::max(apart, std::abs(slow.stress[a] - answers[k].stress[a]));
      }
      if (apart > rounding * size) depends_on_time_ = true;
    }
  }

  std::shared_ptr<UmatLibrary> library_;
  std::array<char, 80> name_;
  std::string material_;
  std::vector<double> props_;
  std::size_t states_;
  mutable std::atomic<std::size_t> tried_ = 0;
  mutable std::atomic<bool> has_left_ = false, depends_on_time_ = false;
};

}  // namespace

template <StressState S>
std::shared_ptr<const HistoryAnswers> make_umat(const MaterialSpec& material) {
  return std::make_shared<Umat<S>>(material, UmatLibrary::open(material.library));
}

template std::shared_ptr<const HistoryAnswers> make_umat<StressState::plane_strain>(const MaterialSpec&);
template std::shared_ptr<const HistoryAnswers> make_umat<StressState::axisymmetric>(const MaterialSpec&);
template std::shared_ptr<const HistoryAnswers> make_umat<StressState::space>(const MaterialSpec&);

std::optional<LawFault> fault_of_umat(const MaterialSpec& material) {
  try {
    UmatLibrary::open(material.library);
    return std::nullopt;
  } catch (const std::domain_error& fault) {
    return LawFault{"library", fault.what()};
  }
}

}  // namespace stillpoint
