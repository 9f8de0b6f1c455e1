// SPDX-License-Identifier: LGPL-3.0-or-later
#include "support/dirichlet.hpp"

#include "support/dense.hpp"
#include <cstddef>

namespace rubato::test {

void solve_with_given(const Eigen::SparseMatrix<double>& k, const Eigen::VectorXd& f,
                      const std::vector<bool>& given, Eigen::VectorXd& u) {
  std::vector<Eigen::Triplet<double>> selection;
  int free_count = 0;
  for (int dof = 0; dof < u.size(); ++dof) {
    if (given[static_cast<std::size_t>(dof)])
      continue;
    u[dof] = 0;
    selection.emplace_back(dof, free_count++, 1.);
  }
  Eigen::SparseMatrix<double> select(u.size(), free_count);
  select.setFromTriplets(selection.begin(), selection.end());
  const Eigen::SparseMatrix<double> reduced = select.transpose() * k * select;
  const Eigen::VectorXd right_side = select.transpose() * (f - k * u);
  u += select * sparse_solution(reduced, right_side);
}

} // namespace rubato::test
