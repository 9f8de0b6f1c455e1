// SPDX-License-Identifier: LGPL-3.0-or-later
/// Systems of several bodies.
#pragma once

#include "rubato/linalg/direct_solver.hpp"

#include <utility>
#include <vector>

namespace rubato::test {

/// Two systems that have nothing in common, the second after the first.
inline linalg::SparseMatrix beside(const linalg::SparseMatrix& a, const linalg::SparseMatrix& b) {
  std::vector<Eigen::Triplet<double, int>> entries;
  for (const auto& [matrix, at] : {std::pair(&a, 0), std::pair(&b, static_cast<int>(a.rows()))})
    for (int column = 0; column < matrix->outerSize(); ++column)
      for (linalg::SparseMatrix::InnerIterator entry(*matrix, column); entry; ++entry)
        entries.emplace_back(static_cast<int>(entry.row()) + at, column + at, entry.value());
  linalg::SparseMatrix both(a.rows() + b.rows(), a.rows() + b.rows());
  both.setFromTriplets(entries.begin(), entries.end());
  return both;
}

} // namespace rubato::test
