// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/symmetric_product.hpp"

#include "rubato/linalg/blas_threads.hpp"

#include <stdexcept>

// Debian packs no header for the BLAS that OpenBLAS holds; this is its Fortran interface.
extern "C" void dsymv_(const char* triangle, const int* size, const double* factor, const double* matrix,
                       const int* stride, const double* x, const int* x_stride, const double* sum_factor,
                       double* sum, const int* sum_stride);

namespace rubato::linalg {
namespace {

/// Eigen is done with such a matrix before BLAS has begun.
constexpr int unblocked = 48;

} // namespace

void add_symmetric_product(double factor, const Eigen::MatrixXd& matrix, const double* x, double* y) {
  if (matrix.rows() != matrix.cols())
    throw std::invalid_argument("a symmetric matrix that is not square");
  const auto size = static_cast<int>(matrix.rows());
  if (size == 0)
    return; // Eigen would take a reference to the first entry
  if (size <= unblocked) {
    Eigen::Map<Eigen::VectorXd>(y, size).noalias() +=
        factor * matrix.selfadjointView<Eigen::Lower>() * Eigen::Map<const Eigen::VectorXd>(x, size);
    return;
  }
  use_one_blas_thread_by_default();
  const int one = 1;
  const double whole = 1;
  dsymv_("L", &size, &factor, matrix.data(), &size, x, &one, &whole, y, &one);
}

} // namespace rubato::linalg
