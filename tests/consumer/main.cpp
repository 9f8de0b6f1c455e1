// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cstdio>
#include <rubato/linalg/direct_solver.hpp>
#include <rubato/mesh/cell_type.hpp>

int main() {
  using namespace rubato;
  linalg::SparseMatrix matrix(2, 2);
  matrix.insert(0, 0) = 4;
  matrix.insert(1, 1) = 2;
  const Eigen::VectorXd right_side = Eigen::Vector2d(4, 6);
  const Eigen::VectorXd expected = Eigen::Vector2d(1, 3);
  const auto cholesky = linalg::CholeskyFactor::of(matrix);
  const auto umfpack = linalg::LuFactor::of(matrix, linalg::GeneralEngine::umfpack);
  const auto mumps = linalg::LuFactor::of(matrix, linalg::GeneralEngine::mumps);
  const bool solved = cholesky && umfpack && mumps && cholesky->solve(right_side).isApprox(expected) &&
                      umfpack->solve(right_side).isApprox(expected) &&
                      mumps->solve(right_side).isApprox(expected);
  const bool known = cell::topology(CellType::hexa20).node_count == 20;
  std::puts(solved && known ? "rubato works as installed" : "rubato does not work as installed");
  return solved && known ? 0 : 1;
}
