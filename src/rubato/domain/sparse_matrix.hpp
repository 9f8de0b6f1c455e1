// SPDX-License-Identifier: LGPL-3.0-or-later
/// The sparse matrices of the whole.
#pragma once

#include <Eigen/SparseCore>

namespace rubato::domain {

using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

} // namespace rubato::domain
