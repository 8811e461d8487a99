// BLAS on one thread: a product that is divided among threads is summed in another order for another number of them,
// and results have to be the same bits for any number. CHOLMOD's own loops ask for four threads each, whatever OpenMP
// was told, to be woken and waited for at each supernode: they get one as well.
#pragma once

#include <omp.h>

extern "C" {
// Functions of OpenBLAS, null if the program is linked with another BLAS.
[[gnu::weak]] int openblas_get_parallel();  // 0: sequential, 1: threads of its own, 2: OpenMP's
[[gnu::weak]] int openblas_get_num_threads();
[[gnu::weak]] void openblas_set_num_threads(int threads);
}

namespace stillpoint {

/// During its lifetime BLAS and its callers use one thread; afterwards as many as before.
class OneBlasThread {
 public:
  OneBlasThread() : of_openmp_(omp_get_max_threads()), active_levels_(omp_get_max_active_levels()) {
    omp_set_num_threads(1);
    omp_set_max_active_levels(0);  // holds for loops that name a number of threads too
    constexpr int threads_of_its_own = 1;
    if (openblas_get_parallel && openblas_get_parallel() == threads_of_its_own && openblas_get_num_threads() > 1) {
      of_openblas_ = openblas_get_num_threads();
      openblas_set_num_threads(1);
    }
  }
  ~OneBlasThread() {
    omp_set_num_threads(of_openmp_);
    omp_set_max_active_levels(active_levels_);
    if (of_openblas_ > 0) openblas_set_num_threads(of_openblas_);
  }
  OneBlasThread(const OneBlasThread&) = delete;
  OneBlasThread& operator=(const OneBlasThread&) = delete;

 private:
  int of_openmp_, of_openblas_ = 0;  // threads before; 0: not changed
  int active_levels_;
};

}  // namespace stillpoint
