// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/sparse_sum.hpp"

#include "rubato/linalg/sparse_matrix.hpp"

#include <algorithm>

namespace rubato::linalg {
namespace {

bool same_places(const SparseMatrix& a, const SparseMatrix& b) {
  return a.isCompressed() && b.isCompressed() && a.nonZeros() == b.nonZeros() &&
         std::equal(a.outerIndexPtr(), a.outerIndexPtr() + a.outerSize() + 1, b.outerIndexPtr()) &&
         std::equal(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros(), b.innerIndexPtr());
}

bool has_places_of(const SparseMatrix& sum, const SparseMatrix& addend) {
  const int* const rows = sum.innerIndexPtr();
  const int* const wanted = addend.innerIndexPtr();
  for (int column = 0; column < sum.outerSize(); ++column)
    if (!std::includes(rows + sum.outerIndexPtr()[column], rows + sum.outerIndexPtr()[column + 1],
                       wanted + addend.outerIndexPtr()[column], wanted + addend.outerIndexPtr()[column + 1]))
      return false;
  return true;
}

/// Adds where the sum has all places of the addend. False otherwise: the sum has then got none of it.
bool add_in_place(double factor, const SparseMatrix& addend, SparseMatrix& sum) {
  if (!sum.isCompressed() || !addend.isCompressed() || sum.rows() != addend.rows() ||
      sum.cols() != addend.cols() || !has_places_of(sum, addend))
    return false;
  for (int column = 0; column < sum.outerSize(); ++column) {
    SparseMatrix::InnerIterator to(sum, column);
    for (SparseMatrix::InnerIterator from(addend, column); from; ++from) {
      while (to.row() != from.row())
        ++to;
      to.valueRef() += factor * from.value();
    }
  }
  return true;
}

} // namespace

void add_scaled(double factor, const SparseMatrix& addend, SparseMatrix& sum) {
  if (same_places(sum, addend))
    sum.coeffs() += factor * addend.coeffs();
  else if (!add_in_place(factor, addend, sum))
    sum += factor * addend;
}

} // namespace rubato::linalg
