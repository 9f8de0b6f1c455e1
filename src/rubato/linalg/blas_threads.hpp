// SPDX-License-Identifier: LGPL-3.0-or-later
/// How many threads the factorisations may use.
#pragma once

namespace rubato::linalg {

/// OpenBLAS works with one thread from here on, unless the environment says otherwise (OPENBLAS_NUM_THREADS
/// or OMP_NUM_THREADS): the fronts of our factorisations are too small for two threads to gain on a shared
/// machine. Only the first call acts, so a program that sets the number of threads afterwards keeps its will.
void use_one_blas_thread_by_default();

/// For the first line of a main(): use_one_blas_thread_by_default(), and the threads that OpenBLAS started
/// when it was loaded end at once; left alone they keep the other cores busy for a tenth of a second each,
/// waiting for work. No other thread may be in BLAS meanwhile. OpenBLAS starts them again should its number
/// of threads be raised later.
void start_with_one_blas_thread_by_default();

/// While it lives, OpenBLAS works with so many threads, unless the environment says otherwise. The number is
/// one of the whole process: nobody else may be in BLAS meanwhile who must not be given threads.
class BlasThreads {
public:
  explicit BlasThreads(int count);
  ~BlasThreads();
  BlasThreads(const BlasThreads&) = delete;
  BlasThreads& operator=(const BlasThreads&) = delete;

private:
  int count_before_ = 0; // 0: was not changed
};

/// While it lives, OpenMP (which CHOLMOD may be built with, for four threads) starts no threads for the
/// calling thread, unless the environment says otherwise. OpenMP keeps this setting for each thread by
/// itself.
class OneOpenMpThread {
public:
  OneOpenMpThread();
  ~OneOpenMpThread();
  OneOpenMpThread(const OneOpenMpThread&) = delete;
  OneOpenMpThread& operator=(const OneOpenMpThread&) = delete;

private:
  int levels_before_ = -1; // of nested parallel regions; -1: was not changed
};

} // namespace rubato::linalg
