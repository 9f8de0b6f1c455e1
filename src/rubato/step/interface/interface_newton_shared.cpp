// SPDX-License-Identifier: LGPL-3.0-or-later
/// What shared multipliers add to the points' linear system.
#include "rubato/linalg/dense_products.hpp"
#include "rubato/step/interface/interface_newton_system.hpp"

#include <algorithm>

namespace rubato::step {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The rows and columns of the shared multipliers.
void InterfaceNewtonSystem::add_shared(Index rows, MatrixXd& matrix) const {
  const Index of_points = matrix.rows();
  const Index shared = shared_.size();
  MatrixXd whole = MatrixXd::Zero(of_points + shared, of_points + shared);
  for (Index j = 0; j < of_points; ++j)
    std::copy_n(&matrix(0, j), of_points, &whole(0, j));
  for (Index j = 0; j < shared; ++j)
    std::copy_n(&shared_.by_unknown()(0, j), shared, &whole(of_points, of_points + j));
  Index first = 0;
  for (const auto& point : points()) {
    const auto& r = point.response;
    const MatrixXd moved = moved_by(surface_, point.rows, rows);
    for (Index row = 0; row < rows; ++row)
      shared_.add_seen(-force_weight_, &moved(0, row), &whole(of_points, first + row));
    for (const auto& share : point.shares)
      for (int a = 0; a < r.multipliers(); ++a) {
        const Index column = of_points + shared_.unknown_of(share.first + a);
        for (Index row = 0; row < r.components; ++row)
          whole(first + row, column) -= share.shape * r.by_multiplier(row, a);
      }
    first += rows;
  }
  matrix.swap(whole);
}

/// What the shared multipliers leave of their equations and of the points'. `d`: one an active dof.
void InterfaceNewtonSystem::add_shared(const Change& change, const VectorXd& d, Change& left) const {
  if (shared_.size() == 0)
    return;
  left.shared = shared_.right() - linalg::product(shared_.by_unknown(), change.shared);
  shared_.add_seen(-1, d.data(), left.shared.data());
  for (const auto& point : points()) {
    const auto& r = point.response;
    for (const auto& share : point.shares)
      for (int a = 0; a < r.multipliers(); ++a) {
        const double by = share.shape * change.shared[shared_.unknown_of(share.first + a)];
        for (Index row = 0; row < r.components; ++row)
          left.force[point.first + row] += by * r.by_multiplier(row, a);
      }
  }
}

} // namespace rubato::step
