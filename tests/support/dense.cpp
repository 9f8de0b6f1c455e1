// SPDX-License-Identifier: LGPL-3.0-or-later
#include "support/dense.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SparseCholesky>

#include <stdexcept>

namespace rubato::test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd dense_solution(const MatrixXd& a, const VectorXd& b) {
  return a.fullPivLu().solve(b);
}

VectorXd least_squares(const MatrixXd& a, const VectorXd& b) {
  return a.colPivHouseholderQr().solve(b);
}

VectorXd sparse_solution(const Eigen::SparseMatrix<double>& a, const VectorXd& b) {
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(a);
  if (factor.info() != Eigen::Success)
    throw std::runtime_error("the matrix cannot be factored");
  return factor.solve(b);
}

MatrixXd inverse(const MatrixXd& a) {
  return a.inverse();
}

MatrixXd pseudo_inverse(const MatrixXd& a) {
  return a.completeOrthogonalDecomposition().pseudoInverse();
}

double determinant(const MatrixXd& a) {
  return a.determinant();
}

Eigen::Index rank(const MatrixXd& a) {
  return a.fullPivLu().rank();
}

bool is_positive_definite(const MatrixXd& a) {
  return a.llt().info() == Eigen::Success;
}

VectorXd symmetric_eigenvalues(const MatrixXd& a) {
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(a, Eigen::EigenvaluesOnly).eigenvalues();
}

Eigen::VectorXcd eigenvalues(const MatrixXd& a) {
  return Eigen::EigenSolver<MatrixXd>(a, false).eigenvalues();
}

GeneralModes general_modes(const MatrixXd& k, const MatrixXd& m) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(k, m);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

} // namespace rubato::test
