// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/blas_threads.hpp"
#include "rubato/linalg/direct_solver.hpp"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <thread>
#include <vector>

extern "C" {
void openblas_set_num_threads(int count);
int openblas_get_num_threads();
void dgemm_(const char* transpose_a, const char* transpose_b, const int* rows, const int* columns,
            const int* inner, const double* alpha, const double* a, const int* stride_a, const double* b,
            const int* stride_b, const double* beta, double* c, const int* stride_c);
}

namespace rubato::linalg::blas_threads_test {
namespace {

class BlasThreads : public testing::Test {
protected:
  void SetUp() override {
    if (std::getenv("OPENBLAS_NUM_THREADS") != nullptr || std::getenv("OMP_NUM_THREADS") != nullptr)
      GTEST_SKIP() << "the environment says how many";
  }
  void TearDown() override { openblas_set_num_threads(1); }
};

std::ptrdiff_t threads_of_this_process() {
  const std::filesystem::directory_iterator threads("/proc/self/task");
  return std::distance(begin(threads), end(threads));
}

/// Large enough that OpenBLAS gives every thread a part.
double error_of_a_product() {
  constexpr int n = 400;
  constexpr double one = 1.0;
  constexpr double zero = 0.0;
  const Eigen::MatrixXd a = Eigen::VectorXd::LinSpaced(n, -1, 1) * Eigen::RowVectorXd::LinSpaced(n, 1, 2);
  Eigen::MatrixXd product(n, n);
  dgemm_("N", "N", &n, &n, &n, &one, a.data(), &n, a.data(), &n, &zero, product.data(), &n);
  const Eigen::MatrixXd expected = a * a;
  return (product - expected).norm() / expected.norm();
}

TEST_F(BlasThreads, AreOneAfterTheStartOfAProgram) {
  start_with_one_blas_thread_by_default();
  EXPECT_EQ(threads_of_this_process(), 1);
  EXPECT_EQ(openblas_get_num_threads(), 1);
  EXPECT_LT(error_of_a_product(), 1e-13);
  EXPECT_EQ(threads_of_this_process(), 1);
}

TEST_F(BlasThreads, ComeBackWhenMoreAreWanted) {
  start_with_one_blas_thread_by_default();
  openblas_set_num_threads(2);
  EXPECT_LT(error_of_a_product(), 1e-13);
  EXPECT_GT(threads_of_this_process(), 1);
  use_one_blas_thread_by_default();
  EXPECT_EQ(openblas_get_num_threads(), 2);
}

/// The Laplacian of a cube with n cells along an edge, of which supernodes take hold.
SparseMatrix laplacian(int n) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto number = [n](int i, int j, int k) { return (i * n + j) * n + k; };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) {
        entries.emplace_back(number(i, j, k), number(i, j, k), 6.1);
        const auto couple = [&](int other) {
          entries.emplace_back(number(i, j, k), other, -1.0);
          entries.emplace_back(other, number(i, j, k), -1.0);
        };
        if (i + 1 < n)
          couple(number(i + 1, j, k));
        if (j + 1 < n)
          couple(number(i, j + 1, k));
        if (k + 1 < n)
          couple(number(i, j, k + 1));
      }
  SparseMatrix matrix(n * n * n, n * n * n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

// CHOLMOD may be built with OpenMP, whose settings are those of one thread: programs work in threads of their
// own, too.
TEST_F(BlasThreads, AreNotAddedToByAFactorisationInAnyThread) {
  start_with_one_blas_thread_by_default();
  std::thread([] {
    const auto before = threads_of_this_process();
    const SparseMatrix matrix = laplacian(16);
    const auto factor = CholeskyFactor::of(matrix);
    ASSERT_TRUE(factor);
    const Eigen::VectorXd load = Eigen::VectorXd::LinSpaced(matrix.rows(), -1.0, 2.0);
    EXPECT_LT((matrix * factor->solve(load) - load).norm(), 1e-10 * load.norm());
    EXPECT_EQ(threads_of_this_process(), before);
  }).join();
}

} // namespace
} // namespace rubato::linalg::blas_threads_test
