// SPDX-License-Identifier: LGPL-3.0-or-later
/// Solves K u = f with some dofs given.
#pragma once

#include <Eigen/SparseCore>

#include <vector>

namespace rubato::test {

/// `u` holds the given values where `given`, and the solution everywhere afterwards.
void solve_with_given(const Eigen::SparseMatrix<double>& k, const Eigen::VectorXd& f,
                      const std::vector<bool>& given, Eigen::VectorXd& u);

} // namespace rubato::test
