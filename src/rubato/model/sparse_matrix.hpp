// SPDX-License-Identifier: LGPL-3.0-or-later
/// The sparse matrices of a model.
#pragma once

#include <Eigen/SparseCore>

namespace rubato::model {

using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

} // namespace rubato::model
