// SPDX-License-Identifier: LGPL-3.0-or-later
/// Sums of sparse matrices that mostly have the same entries, as stiffness and mass of one mesh do.
#pragma once

#include <Eigen/SparseCore>

namespace rubato::linalg {

/// sum ← sum + factor · addend. Both compressed and of the same size. Where both have entries at the same
/// places, nothing is allocated.
void add_scaled(double factor, const Eigen::SparseMatrix<double, Eigen::ColMajor, int>& addend,
                Eigen::SparseMatrix<double, Eigen::ColMajor, int>& sum);

} // namespace rubato::linalg
