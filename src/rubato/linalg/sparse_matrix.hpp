// SPDX-License-Identifier: LGPL-3.0-or-later
/// The sparse matrix of all modules.
#pragma once

#include <Eigen/SparseCore>

namespace rubato::linalg {

using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

} // namespace rubato::linalg
