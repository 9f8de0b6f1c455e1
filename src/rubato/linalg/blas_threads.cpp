// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/blas_threads.hpp"

#include <cstdlib>
#include <mutex>

extern "C" void openblas_set_num_threads(int count);

namespace rubato::linalg {

void use_one_blas_thread_by_default() {
  static std::once_flag done;
  std::call_once(done, [] {
    if (std::getenv("OPENBLAS_NUM_THREADS") == nullptr && std::getenv("OMP_NUM_THREADS") == nullptr)
      openblas_set_num_threads(1);
  });
}

} // namespace rubato::linalg
