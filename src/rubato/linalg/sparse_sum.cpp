// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/sparse_sum.hpp"

#include <algorithm>

namespace rubato::linalg {
namespace {

using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

bool same_places(const SparseMatrix& a, const SparseMatrix& b) {
  return a.isCompressed() && b.isCompressed() && a.nonZeros() == b.nonZeros() &&
         std::equal(a.outerIndexPtr(), a.outerIndexPtr() + a.outerSize() + 1, b.outerIndexPtr()) &&
         std::equal(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros(), b.innerIndexPtr());
}

} // namespace

void add_scaled(double factor, const SparseMatrix& addend, SparseMatrix& sum) {
  if (same_places(sum, addend))
    sum.coeffs() += factor * addend.coeffs();
  else
    sum += factor * addend;
}

} // namespace rubato::linalg
