// SPDX-License-Identifier: LGPL-3.0-or-later
/// A matrix that couples nodes and leaves directions alone, as a consistent mass does: m_ij I for each pair
/// of nodes. A product reads a ninth of what the matrix of all unknowns holds in three dimensions.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace rubato::linalg {

class NodalMatrix {
public:
  NodalMatrix() = default;
  /// `matrix`: of nodes · components rows, a node's components in a row; only the entries between first
  /// components are read. Throws std::invalid_argument when the rows are no whole number of nodes.
  NodalMatrix(const Eigen::SparseMatrix<double, Eigen::ColMajor, int>& matrix, int components);

  /// y = A x
  Eigen::VectorXd operator*(const Eigen::VectorXd& x) const;
  Eigen::Index rows() const { return of_nodes_.rows() * components_; }

private:
  Eigen::SparseMatrix<double, Eigen::RowMajor, int> of_nodes_;
  int components_ = 1;
};

} // namespace rubato::linalg
