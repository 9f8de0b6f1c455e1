// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/blas_threads.hpp"

#include <cstdlib>
#include <mutex>

extern "C" void openblas_set_num_threads(int count);
extern "C" int openblas_get_num_threads();
// What OpenBLAS itself calls before a fork; its builds without threads lack it.
extern "C" [[gnu::weak]] int blas_thread_shutdown_();
// Of the OpenMP that CHOLMOD may be built with.
extern "C" [[gnu::weak]] int omp_get_max_active_levels();
extern "C" [[gnu::weak]] void omp_set_max_active_levels(int count);

namespace rubato::linalg {
namespace {

bool environment_decides() {
  return std::getenv("OPENBLAS_NUM_THREADS") != nullptr || std::getenv("OMP_NUM_THREADS") != nullptr;
}

} // namespace

void use_one_blas_thread_by_default() {
  static std::once_flag done;
  std::call_once(done, [] {
    if (!environment_decides())
      openblas_set_num_threads(1);
  });
}

void start_with_one_blas_thread_by_default() {
  use_one_blas_thread_by_default();
  if (!environment_decides() && blas_thread_shutdown_ != nullptr)
    blas_thread_shutdown_();
}

BlasThreads::BlasThreads(int count) {
  use_one_blas_thread_by_default();
  if (environment_decides())
    return;
  count_before_ = openblas_get_num_threads();
  openblas_set_num_threads(count);
}

BlasThreads::~BlasThreads() {
  if (count_before_ > 0)
    openblas_set_num_threads(count_before_);
}

OneOpenMpThread::OneOpenMpThread() {
  if (environment_decides() || omp_get_max_active_levels == nullptr || omp_set_max_active_levels == nullptr)
    return;
  levels_before_ = omp_get_max_active_levels();
  omp_set_max_active_levels(0);
}

OneOpenMpThread::~OneOpenMpThread() {
  if (levels_before_ >= 0)
    omp_set_max_active_levels(levels_before_);
}

} // namespace rubato::linalg
