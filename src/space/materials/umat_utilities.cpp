#include "space/materials/umat_utilities.hpp"

#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>

#include <Eigen/Dense>
#include <dlfcn.h>

namespace stillpoint {
namespace {

thread_local std::jmp_buf* where_exit_leads = nullptr;

// Row and column of the shears 12, 13, 23.
constexpr int row_of_shear[3] = {0, 0, 1}, column_of_shear[3] = {1, 2, 2};

Eigen::Matrix3d tensor(const double* S, int kind, int normals, int shears) {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  for (int k = 0; k < normals; ++k) A(k, k) = S[k];
  for (int k = 0; k < shears; ++k) {
    const double shear = kind == 2 ? S[normals + k] / 2 : S[normals + k];
    A(row_of_shear[k], column_of_shear[k]) = A(column_of_shear[k], row_of_shear[k]) = shear;
  }
  return A;
}

}  // namespace

void offer_umat_utilities() {
  // In a program they are visible as it was linked so. A library that was itself loaded for its own use alone, as
  // Python loads modules, is put among those that are for all.
  static const bool offered = [] {
    Dl_info info{};
    if (dladdr(reinterpret_cast<void*>(&xit_), &info) != 0 && info.dli_fname)
      dlopen(info.dli_fname, RTLD_NOW | RTLD_NOLOAD | RTLD_GLOBAL);
    return true;
  }();
  static_cast<void>(offered);
}

bool runs_without_exit(void (*body)(void*), void* data) {
  std::jmp_buf here;
  std::jmp_buf* const before = where_exit_leads;
  where_exit_leads = &here;
  const bool left = setjmp(here) != 0;
  if (!left) body(data);
  where_exit_leads = before;
  return !left;
}

}  // namespace stillpoint

#define STILLPOINT_FOR_UMATS [[gnu::visibility("default"), gnu::used]]

extern "C" {

STILLPOINT_FOR_UMATS void rotsig_(const double* S, const double* R, double* SPRIME, const int* LSTR, const int* NDI,
                                  const int* NSHR) {
  const Eigen::Map<const Eigen::Matrix3d> Q(R);
  const Eigen::Matrix3d turned = Q * stillpoint::tensor(S, *LSTR, *NDI, *NSHR) * Q.transpose();
  for (int k = 0; k < *NDI; ++k) SPRIME[k] = turned(k, k);
  for (int k = 0; k < *NSHR; ++k)
    SPRIME[*NDI + k] = (*LSTR == 2 ? 2 : 1) * turned(stillpoint::row_of_shear[k], stillpoint::column_of_shear[k]);
}

STILLPOINT_FOR_UMATS void sinv_(const double* STRESS, double* SINV1, double* SINV2, const int* NDI, const int* NSHR) {
  const Eigen::Matrix3d sigma = stillpoint::tensor(STRESS, 1, *NDI, *NSHR);
  *SINV1 = sigma.trace() / 3;
  const Eigen::Matrix3d s = sigma - *SINV1 * Eigen::Matrix3d::Identity();
  *SINV2 = std::sqrt(1.5 * s.squaredNorm());
}

STILLPOINT_FOR_UMATS void sprinc_(const double* S, double* PS, const int* LSTR, const int* NDI, const int* NSHR) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(stillpoint::tensor(S, *LSTR, *NDI, *NSHR),
                                                              Eigen::EigenvaluesOnly);
  Eigen::Map<Eigen::Vector3d>(PS, 3) = solver.eigenvalues();
}

STILLPOINT_FOR_UMATS void sprind_(const double* S, double* PS, double* AN, const int* LSTR, const int* NDI,
                                  const int* NSHR) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(stillpoint::tensor(S, *LSTR, *NDI, *NSHR));
  Eigen::Map<Eigen::Vector3d>(PS, 3) = solver.eigenvalues();
  Eigen::Map<Eigen::Matrix3d>(AN, 3, 3) = solver.eigenvectors().transpose();
}

STILLPOINT_FOR_UMATS void xit_() {
  if (stillpoint::where_exit_leads) std::longjmp(*stillpoint::where_exit_leads, 1);
  std::fputs("XIT was called outside a UMAT\n", stderr);
  std::exit(4);
}

}  // extern "C"
